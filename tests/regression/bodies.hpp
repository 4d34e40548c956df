// Small meshes, decks made of parts, and runs that a test can inspect at each step.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "advice/advice.hpp"
#include "base/parallel/communicator.hpp"
#include "deck/deck.hpp"
#include "io/exodus/exodus.hpp"
#include "setup/setup.hpp"
#include "unit/temporary_folder.hpp"

namespace strut::regression {

// Hexahedra of edge `spacing`: those of an nx × ny × nz lattice at the origin whose center is `inside`. They are the
// block "bar", but for the `plate_layers` at the top, which are the block "plate".
// Node sets: "foot" at z = 0, "top" at the other end.
struct Lattice {
  int nx = 4, ny = 4, nz = 6;
  double spacing = 1e-3;  // m
  int plate_layers = 0;
  std::function<bool(double, double)> inside = [](double, double) { return true; };  // of x, y, m

  io::Mesh mesh() const;

 private:
  int node(int i, int j, int k) const { return (k * (ny + 1) + j) * (nx + 1) + i; }

  std::vector<int> level(int k) const;

  // The nodes of the elements of these layers.
  std::vector<int> layers(int begin, int end) const;
};

// <Parameter> and <ParameterList>.
std::string key(const std::string& name, const std::string& value);
std::string section(const std::string& name, const std::string& content);

// The conditions that most tests need.
std::string along(const std::string& name, const std::string& type, const std::string& set, const std::string& axis,
                  const std::string& value);
std::string plane(const std::string& name, const std::string& type, const std::string& set, const std::string& point,
                  const std::string& normal);

// Copper; elastic without a yield stress.
std::string copper(const std::string& plasticity = "");

// The parts of a deck; what is empty is left out.
struct Parts {
  std::string mesh_type = "Exodus", mesh_file = "bar.g", points, degenerate;
  std::string node_sets;
  std::string materials = copper();
  std::string blocks =
      section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "2.01e-3"));
  std::string contact, conditions;
  std::string times = key("Final Time", "5e-6");
  std::string verlet = key("Safety Factor", "0.8");
  std::string output, history, watch, damage;

  std::string text() const;
};

// Two bodies of copper, "block_1" and "block_2" of points.txt (cubes() below); the second one flies toward the first.
Parts thrown_block(const std::string& contact);

// `text` with the first `old` replaced; throws if `old` is missing, because the test is then wrong.
std::string changed(std::string text, const std::string& old, const std::string& replacement);

// A folder for a deck, its mesh and its results.
class RunFolder {
 public:
  explicit RunFolder(const Lattice& lattice = {});

  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

  std::filesystem::path write(const std::string& name, const std::string& text) const;

  const Communicator world;

 private:
  TemporaryFolder folder_;
};

// Points of a text mesh: cubes of edge `spacing` that fill nx × ny × nz cells from `corner` (m), in block `block`.
std::string cubes(int block, const Vector& corner, int nx, int ny, int nz, double spacing);

// One model for the given interactions: pairs of blocks "block_1 block_2". `law`: its key Contact Model and those that
// belong to it.
std::string contact_by(const std::string& law, const std::vector<std::pair<std::string, std::string>>& interactions,
                       const std::string& radius, const std::string& friction = "0");

// By the short-range penalty.
std::string contact_of(const std::vector<std::pair<std::string, std::string>>& interactions, const std::string& radius,
                       const std::string& penalty, const std::string& friction = "0");

// A history as columns by name; throws where a line has not as many numbers as the header has names.
using Table = std::map<std::string, std::vector<double>>;
Table read_history(const std::filesystem::path& path);

Advice told_at_the_start(const deck::Deck& deck, const Communicator& world);

// A run that the test advances. go() calls `look` with the ledger at every step, the first and the last included.
class Simulation {
 public:
  Simulation(const RunFolder& folder, const Parts& parts);
  ~Simulation();

  // The ledger at the final time.
  Ledger go(const std::function<void(const Ledger&)>& look = [](const Ledger&) {});

  const Communicator& world() const { return scene.body.domain.communicator; }
  Body& body() { return scene.body; }
  Vector reference(int i) const { return scene.body.domain.reference(i); }
  bool in_set(int i, const std::string& name) const;
  // Over all ranks.
  double mass() const;
  double volume() const;

  deck::Deck deck;
  Scene scene;
  Advice advice;
  CentralDifference solver;
};

}  // namespace strut::regression

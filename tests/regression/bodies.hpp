// Small meshes, decks made of parts, and runs that a test can inspect at each step.
#pragma once

#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "advice/advice.hpp"
#include "base/errors.hpp"
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

  io::Mesh mesh() const {
    io::Mesh mesh;
    for (int k = 0; k <= nz; ++k) {
      for (int j = 0; j <= ny; ++j) {
        for (int i = 0; i <= nx; ++i) mesh.nodes.push_back(spacing * Vector(i, j, k));
      }
    }
    mesh.blocks.push_back({"bar", "HEX8", layers(0, nz - plate_layers), {}});
    if (plate_layers > 0) mesh.blocks.push_back({"plate", "HEX8", layers(nz - plate_layers, nz), {}});
    mesh.node_sets = {{"foot", level(0)}, {"top", level(nz)}};
    return mesh;
  }

 private:
  int node(int i, int j, int k) const { return (k * (ny + 1) + j) * (nx + 1) + i; }

  std::vector<int> level(int k) const {
    std::vector<int> nodes;
    for (int n = node(0, 0, k); n < node(0, 0, k + 1); ++n) nodes.push_back(n);
    return nodes;
  }

  // The nodes of the elements of these layers.
  std::vector<int> layers(int begin, int end) const {
    std::vector<int> nodes;
    for (int k = begin; k < end; ++k) {
      for (int j = 0; j < ny; ++j) {
        for (int i = 0; i < nx; ++i) {
          if (!inside((i + 0.5) * spacing, (j + 0.5) * spacing)) continue;
          for (const int level : {k, k + 1}) {
            for (const int corner :
                 {node(i, j, level), node(i + 1, j, level), node(i + 1, j + 1, level), node(i, j + 1, level)}) {
              nodes.push_back(corner);
            }
          }
        }
      }
    }
    return nodes;
  }
};

// <Parameter> and <ParameterList>.
inline std::string key(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"string\" value=\"" + value + "\"/>\n";
}
inline std::string section(const std::string& name, const std::string& content) {
  return "<ParameterList name=\"" + name + "\">\n" + content + "</ParameterList>\n";
}

// The conditions that most tests need.
inline std::string along(const std::string& name, const std::string& type, const std::string& set,
                         const std::string& axis, const std::string& value) {
  return section(name, key("Type", type) + key("Node Set", set) + key("Coordinate", axis) + key("Value", value));
}
inline std::string plane(const std::string& name, const std::string& type, const std::string& set,
                         const std::string& point, const std::string& normal) {
  return section(name, key("Type", type) + key("Node Set", set) + key("Point", point) + key("Normal", normal));
}

// Copper; elastic without a yield stress.
inline std::string copper(const std::string& plasticity = "") {
  const std::string model = plasticity.empty() ? "Elastic Correspondence" : "Elastic Plastic Correspondence";
  return section("copper", key("Material Model", model) + key("Density", "8930") + key("Young's Modulus", "117e9") +
                               key("Poisson's Ratio", "0.35") + plasticity);
}

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

  std::string text() const {
    const auto optional = [](const std::string& name, const std::string& content) {
      return content.empty() ? "" : section(name, content);
    };
    const auto optional_key = [](const std::string& name, const std::string& value) {
      return value.empty() ? "" : key(name, value);
    };
    return "<ParameterList>\n" +
           section("Discretization", key("Type", mesh_type) + key("Input Mesh File", mesh_file) +
                                         optional_key("Points", points) +
                                         optional_key("Degenerate Points", degenerate)) +
           optional("Node Sets", node_sets) + section("Materials", materials) + section("Blocks", blocks) +
           optional("Contact", contact) + optional("Boundary Conditions", conditions) +
           section("Solver", times + section("Verlet", verlet)) + optional("Output", output) +
           optional("History", history) + optional("Watch", watch) + optional("Damage Models", damage) +
           "</ParameterList>\n";
  }
};

// Two bodies of copper, "block_1" and "block_2" of points.txt (cubes() below); the second one flies toward the first.
inline Parts thrown_block(const std::string& contact) {
  Parts parts;
  parts.mesh_type = "Text File", parts.mesh_file = "points.txt";
  parts.blocks.clear();
  for (const std::string name : {"block_1", "block_2"}) {
    parts.blocks += section(name, key("Block Names", name) + key("Material", "copper") + key("Horizon", "2.01e-3") +
                                      key("Separate Body", "true"));
  }
  parts.contact = contact;
  parts.conditions = along("flight", "Initial Velocity", "block_2", "z", "-100");
  parts.times = key("Final Time", "4e-5");
  return parts;
}

// `text` with the first `old` replaced; throws if `old` is missing, because the test is then wrong.
inline std::string changed(std::string text, const std::string& old, const std::string& replacement) {
  const std::size_t at = text.find(old);
  if (at == std::string::npos) throw std::logic_error("the deck under test does not hold: " + old);
  return text.replace(at, old.size(), replacement);
}

// A folder for a deck, its mesh and its results.
class RunFolder {
 public:
  explicit RunFolder(const Lattice& lattice = {}) : folder_(world) {
    run_on_root(world, [&] { io::write_mesh(folder_ / "bar.g", lattice.mesh()); });
  }

  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    run_on_root(world, [&] { std::ofstream(folder_ / name, std::ios::binary) << text; });
    return folder_ / name;
  }

  const Communicator world;

 private:
  TemporaryFolder folder_;
};

// Points of a text mesh: cubes of edge `spacing` that fill nx × ny × nz cells from `corner` (m), in block `block`.
inline std::string cubes(int block, const Vector& corner, int nx, int ny, int nz, double spacing) {
  std::ostringstream text;
  text.precision(17);
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const Vector X = corner + spacing * Vector(i + 0.5, j + 0.5, k + 0.5);
        text << X[0] << " " << X[1] << " " << X[2] << " " << block << " " << spacing * spacing * spacing << "\n";
      }
    }
  }
  return text.str();
}

// One model for the given interactions: pairs of blocks "block_1 block_2". `law`: its key Contact Model and those that
// belong to it.
inline std::string contact_by(const std::string& law,
                              const std::vector<std::pair<std::string, std::string>>& interactions,
                              const std::string& radius, const std::string& friction = "0") {
  std::string all;
  for (const auto& [first, second] : interactions) {
    all += section(first + second, key("First Block", first) + key("Second Block", second) + key("Contact Model", "m"));
  }
  const std::string model = law + key("Contact Radius", radius) + key("Friction Coefficient", friction);
  return section("Models", section("m", model)) + section("Interactions", all);
}

// By the short-range penalty.
inline std::string contact_of(const std::vector<std::pair<std::string, std::string>>& interactions,
                              const std::string& radius, const std::string& penalty,
                              const std::string& friction = "0") {
  return contact_by(key("Contact Model", "Short Range Force") + key("Spring Constant", penalty), interactions, radius,
                    friction);
}

// A history as columns by name; throws where a line has not as many numbers as the header has names.
using Table = std::map<std::string, std::vector<double>>;
inline Table read_history(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line, word;
  if (!std::getline(file, line) || !line.starts_with("# strut ") || !std::getline(file, line))
    throw Error(path.string() + ": no header");
  std::vector<std::string> names;
  for (std::istringstream header(line); std::getline(header, word, ',');) names.push_back(word);
  Table table;
  while (std::getline(file, line)) {
    std::istringstream row(line);
    for (const std::string& name : names) {
      if (!std::getline(row, word, ',')) throw Error(path.string() + ": a short line: " + line);
      table[name].push_back(std::stod(word));
    }
    if (std::getline(row, word, ',')) throw Error(path.string() + ": a long line: " + line);
  }
  return table;
}

inline Advice told_at_the_start(const deck::Deck& deck, const Communicator& world) {
  return advice(deck, set_up(deck, world));
}

// A run that the test advances. go() calls `look` with the ledger at every step, the first and the last included.
class Simulation {
 public:
  Simulation(const RunFolder& folder, const Parts& parts)
      : deck(deck::read(folder.write("deck.xml", parts.text()), folder.world)),
        scene(set_up(deck, folder.world)),
        advice(strut::advice(deck, scene)),
        solver(scene.body, scene.conditions, std::move(scene.contact), scene.control, deck.solver.initial_time,
               std::move(scene.fracture)) {}

  // The ledger at the final time.
  Ledger go(const std::function<void(const Ledger&)>& look = [](const Ledger&) {}) {
    for (;;) {
      solver.advance_velocity(deck.solver.final_time);
      const Ledger now = solver.ledger();
      look(now);
      if (solver.time() >= deck.solver.final_time) return now;
      solver.advance_position(true);
    }
  }

  const Communicator& world() const { return scene.body.domain.communicator; }
  Body& body() { return scene.body; }
  Vector reference(int i) const { return scene.body.domain.reference(i); }
  bool in_set(int i, const std::string& name) const {
    const PointCloud& cloud = scene.body.domain.cloud;
    for (std::size_t k = 0; k < cloud.set_names.size(); ++k) {
      if (cloud.set_names[k] == name) return (cloud.sets[i] >> k & 1) != 0;
    }
    throw std::logic_error("no set " + name);
  }
  // Over all ranks.
  double mass() const {
    double sum = 0;
    for (int i = 0; i < scene.body.owned(); ++i) sum += scene.body.mass(i);
    return scene.body.domain.communicator.sum(sum);
  }
  double volume() const {
    double sum = 0;
    for (int i = 0; i < scene.body.owned(); ++i) sum += scene.body.domain.volume(i);
    return scene.body.domain.communicator.sum(sum);
  }

  deck::Deck deck;
  Scene scene;
  Advice advice;
  CentralDifference solver;
};

}  // namespace strut::regression

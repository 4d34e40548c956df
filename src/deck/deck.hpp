// A deck as plain structs: what the rest of the program sees of an input file. Strings end here.
// SI units throughout. Every default and meaning stands in the schema (deck/schema.cpp) and on the page made from it.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/math/function.hpp"
#include "base/math/tensors.hpp"
#include "contact/laws/laws.hpp"
#include "materials/laws.hpp"

namespace strut {
class Communicator;
}

namespace strut::deck {

enum class MeshType { exodus, text, grid };
enum class Points { elements, nodes };
enum class Influence { one, linear_decay, cubic_decay };  // 1; 1 − r; 1 − 3r² + 2r³, with r = |ξ|/δ
enum class DegeneratePoints { error, drop };
enum class StabilizationType { none, silling, mean_gradient };
enum class Formulation { correspondence, ordinary, quadratic };

// Equal cells, with a point at the centre of each, x fastest.
struct Grid {
  Vector origin = Vector::Zero(), length = Vector::Ones();  // m
  std::array<int, 3> points = {1, 1, 1};
};

struct Discretization {
  MeshType type = MeshType::exodus;
  std::filesystem::path mesh;        // as it can be opened: relative to the deck's folder in the deck
  Grid grid;                         // in the place of a mesh
  Points points = Points::elements;  // where they are; nodes: of Exodus meshes only
  Influence influence = Influence::one;
  DegeneratePoints degenerate = DegeneratePoints::error;
};

// A node set made by the deck: the points whose reference position makes `where` non-zero, or those with the numbers.
struct NodeSet {
  std::string name;
  Function where;
  std::optional<std::vector<int>> numbers = {};  // of elements or points, from 1, rising, each once
  std::filesystem::path file = {};               // that they were read from, if any
};

struct Material {
  std::string name;
  double density = 0;  // kg/m³
  Formulation formulation = Formulation::correspondence;
  materials::AnyLaw law;  // ordinary: Elastic
  // By correspondence.
  StabilizationType stabilization = StabilizationType::silling;
  double linear_viscosity = 0, quadratic_viscosity = 0;
  double stabilization_coefficient = 0;  // in units of (λ + 2μ)/(tr K/3), dimensionless
};

struct Block {
  std::string name;                      // of the section
  std::vector<std::string> block_names;  // of the mesh; "all" stands for every block
  int material = 0;                      // index into Deck::materials
  // Exactly one of them:
  std::optional<double> horizon;         // m
  std::optional<double> horizon_factor;  // in local spacings of each point
  bool separate_body = false;            // bonded to nothing outside of this section
  std::optional<bool> across_voids;      // whether bonds reach across voids
};

// Which pairs of blocks an interaction that names none is about.
enum class Partners { any, others, itself };

// Short-range contact between two blocks of the mesh, or within one.
struct Interaction {
  std::string name;                       // of the section
  std::string first_block, second_block;  // both empty: all blocks, with these partners
  Partners partners = Partners::any;
  int model = 0;  // index into Deck::contact_models
};

struct ContactModel {
  std::string name;
  contact::Law law;
  double friction = 0;  // Coulomb's coefficient
};

enum class ConditionType {
  initial_velocity,
  prescribed_displacement,
  prescribed_velocity,
  body_force,      // N per m³ of reference volume
  symmetry_plane,  // the points of the set keep their distance to the plane through them with this normal
  rigid_plane,     // tools: points of the set stay outside
  rigid_cylinder,
  rigid_box,
  open_end  // waves leave through the layer of points as if the body went on behind it
};

struct Condition {
  std::string name;
  ConditionType type = ConditionType::initial_velocity;
  std::string node_set;             // of mesh or deck, a block's name, or "all"
  int component = 0;                // 0 x, 1 y, 2 z; unused for planes and tools
  Function value;                   // m/s, m, m/s, N/m³; unused for planes and tools
  Vector point = Vector::Zero();    // m, on a plane or an axis
  Vector normal = Vector::UnitX();  // of any length but zero
  // Of tools:
  Vector axis = Vector::UnitX();                          // of any length but zero
  double radius = 0;                                      // m
  Vector lower = Vector::Zero(), upper = Vector::Ones();  // corners, m
  double friction = 0;                                    // Coulomb's coefficient
  std::array<std::optional<Function>, 3> travel;          // along x, y, z, of t only, m
};

// Loads without inertia.
struct QuasiStatic {
  bool with_tangent = true;  // Newton; else dynamic relaxation
  int load_steps = 10;
  double tolerance = 1e-6;
  int most_iterations = 20;
};

struct Solver {
  double initial_time = 0, final_time = 0;  // s
  bool verbose = false;                     // each iteration of an equilibrium is told
  std::optional<QuasiStatic> quasi_static;  // else explicit steps:
  std::optional<double> fixed_dt;           // s; else from the critical time step
  double safety_factor = 0.8;
  bool subcycling = true;
};

struct Output {
  bool enabled = false;
  std::filesystem::path file;          // relative to the working folder in the deck, ".e" appended if it has no suffix
  std::optional<int> frequency;        // every so many steps
  std::optional<double> interval;      // or every so many seconds of the simulation
  std::vector<std::string> variables;  // checked against the table of observables by simulation
};

struct History {
  bool enabled = false;
  std::filesystem::path file;
  std::optional<int> frequency;
  std::optional<double> interval;
  std::vector<std::string> variables;  // e.g. "Max_Displacement": checked by simulation
};

// What a run leaves so that it can go on.
struct Restart {
  bool enabled = true;
  bool asked_for = false;          // the deck has the section: the file stays when the run is over
  std::filesystem::path file;      // relative to the working folder; the deck's name with the suffix .restart
  std::optional<int> frequency;    // every so many steps
  std::optional<double> interval;  // or every so many seconds of the simulation
  double minutes = 30;             // and every so many of the clock on the wall
};

// What ends a run that has gone wrong.
struct Watch {
  bool stops = true;            // else it is told once
  bool stops_inverted = true;   // else points that are turned inside out go on as masses
  double balance_error = 0.5;   // of the largest energy
  double smallest_step = 1e-3;  // of the first step
  double penetration = 0.95;    // of the distance at which points touch
};

struct Deck {
  std::filesystem::path file;
  std::string text;  // as it was read
  Discretization discretization;
  std::vector<NodeSet> node_sets;
  std::vector<Material> materials;
  std::vector<Block> blocks;
  std::vector<ContactModel> contact_models;
  std::vector<Interaction> interactions;
  std::vector<Condition> conditions;
  Solver solver;
  Output output;
  History history;
  Restart restart;
  Watch watch;
  std::vector<std::string> notes;  // what was accepted but has no effect, or another than in another program
};

// Collective. Reads and checks `file`; throws one Error on all ranks that lists every problem, each with its path
// (Blocks > foam > Horizon), the value, what was expected with its unit, and the nearest valid name.
Deck read(const std::filesystem::path& file, const Communicator& communicator);

// The reference page of all keys (Markdown), generated from the schema.
std::string reference_page();

}  // namespace strut::deck

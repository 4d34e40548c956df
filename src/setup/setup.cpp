#include "setup/setup.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "base/errors.hpp"
#include "base/timing.hpp"
#include "deck/problems.hpp"
#include "deck/sections/several_sections.hpp"
#include "mechanics/formulation/formulation.hpp"
#include "mechanics/make_body.hpp"
#include "setup/blocks.hpp"
#include "setup/conditions.hpp"
#include "setup/contact.hpp"
#include "setup/families.hpp"
#include "setup/mass_scaling.hpp"
#include "setup/mesh.hpp"
#include "setup/mirrors.hpp"
#include "setup/periods.hpp"
#include "topology/bounding_box.hpp"
#include "topology/neighbors/stencils.hpp"
#include "topology/partition.hpp"
#include "topology/pieces.hpp"

namespace strut {

namespace {

std::optional<QuasiStaticControl> quasi_static_of(const deck::Solver& solver) {
  if (!solver.quasi_static) return std::nullopt;
  const auto& [with_tangent, load_steps, tolerance, most_iterations] = *solver.quasi_static;
  return QuasiStaticControl{with_tangent, load_steps, {tolerance, most_iterations}};
}

StepControl control_of(const deck::Deck& deck) {
  const deck::Solver& solver = deck.solver;
  return {solver.fixed_dt.value_or(0), solver.safety_factor, solver.subcycling, !deck.watch.stops_inverted};
}

// Approximate cost of a step of a point in each block, ns (tests/bench): its bonds and its update.
std::vector<double> step_costs(const deck::Deck& deck, const PointCloud& cloud, std::vector<double> costs) {
  constexpr double update = 80, state = 150;
  for (std::size_t b = 0; b < costs.size(); ++b) {
    const deck::Block& section = *section_of(deck, cloud.block_names[b]);
    const auto has_state = []<class L>(const L&) { return materials::state_size<L> > 0; };
    const bool flows = std::visit(has_state, deck.materials[section.material].law);
    costs[b] += update + (flows ? state : 0);
    if (is_quadratic(deck.materials[section.material])) costs[b] *= cost_of_quadratic;
  }
  return costs;
}

// The box of the points of each block over all ranks.
std::vector<Eigen::AlignedBox3d> boxes_of_blocks(const PointCloud& cloud, const Communicator& communicator) {
  std::vector<Eigen::AlignedBox3d> boxes(cloud.block_names.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) boxes[cloud.blocks[i]].extend(cloud.positions[i]);
  for (Eigen::AlignedBox3d& box : boxes) box = common_box(box, communicator);
  return boxes;
}

// The axis along which two bodies lie one after the other, if there is one: they will meet along it.
std::optional<int> axis_between(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b) {
  constexpr double hardly = 0.1;  // fraction of the smaller length that may overlap
  if (a.isEmpty() || b.isEmpty()) return std::nullopt;
  const Vector common = a.max().cwiseMin(b.max()) - a.min().cwiseMax(b.min());
  int axis = 0;
  return common.minCoeff(&axis) <= hardly * std::min(a.sizes()[axis], b.sizes()[axis]) ? std::optional(axis)
                                                                                       : std::nullopt;
}

// Collective. A cut between two bodies that meet would give all of the contact to one rank; a cut along their direction
// of approach divides it, so lengths along that direction count half. A cut across the pencils of a lattice leaves
// parts of pencils, each with the work of a whole one, on both ranks (an eighth of a step for 46³ points); a cut
// between planes makes both ranks compute some sums (2 %).
Vector lengths_for_cuts(const std::vector<contact::Interaction>& interactions, const std::vector<BlockBonds>& bonds,
                        bool by_stencils, const PointCloud& cloud, const Communicator& communicator) {
  const Vector alone = by_stencils ? Vector(0.7, 1, 0.95) : Vector(1, 1, 1);
  if (interactions.empty()) return alone;
  Vector lengths = alone;
  const std::vector<Eigen::AlignedBox3d> boxes = boxes_of_blocks(cloud, communicator);
  for (const auto& [first, second, model] : interactions) {
    if (bonds[first].body == bonds[second].body) continue;
    if (const auto axis = axis_between(boxes[first], boxes[second])) lengths[*axis] = 0.5 * alone[*axis];
  }
  return lengths;
}

// Collective. The cost of each block's points, and the axes along which cuts are cheap. `spacings`: mean spacing of
// each block, m.
PartitionWeights partition_weights(const deck::Deck& deck, const PointCloud& cloud, const std::vector<double>& spacings,
                                   const Communicator& communicator) {
  const std::vector<BlockBonds> bonds = block_bonds(deck, cloud);
  const BondCosts costs = bond_costs(cloud, bonds, spacings, communicator);
  return {step_costs(deck, cloud, costs.of_block),
          lengths_for_cuts(interactions_of(deck, cloud), bonds, costs.by_stencils, cloud, communicator)};
}

// Builds the scene from the partitioned cloud.
Scene assembled(const deck::Deck& deck, PointCloud cloud, PartitionWeights weights, const Communicator& communicator) {
  Dropped dropped;
  std::vector<BlockMaterial> materials = block_materials(deck, cloud);
  const Mirrors found = mirrors(deck, cloud, communicator);
  const std::vector<Period> all_periods = periods(deck, cloud, found.planes, communicator);
  Domain domain =
      domain_without_degenerate_points(deck, std::move(cloud), found.planes, all_periods, communicator, dropped);
  if (dropped.points > 0) find_probes_again(deck.node_sets, domain);
  soften_cracks(deck, domain, materials);
  Scene scene{make_body(std::move(domain), deck.discretization.influence, materials),
              {},
              {},
              {},
              control_of(deck),
              quasi_static_of(deck.solver),
              std::move(weights),
              0,
              0,
              0,
              dropped,
              {},
              found.warnings};
  scene.warnings += open_sides(deck, scene.body.domain);
  scene.fracture = fracture_of(scene.body, deck.solver.initial_time);
  add_conditions(deck, deck.solver.initial_time, scene, communicator);
  return scene;
}

void add_contact(const deck::Deck& deck, Scene& scene) {
  scene.contact = contact::Contact(interactions_of(deck, scene.body), scene.body.domain);
}

// The same body for the steps of the second solver, without conditions.
deck::Deck next_of(const deck::Deck& deck, contact::Contact contact, std::optional<Fracture> fracture, Scene& scene) {
  deck::Deck next = deck;
  next.solver = *deck.next_solver;
  next.next_solver.reset();
  next.start_from.reset();  // it is the equilibria that began there
  deck::take_default_interval(next.solver.duration(), next.output);
  deck::take_default_interval(next.solver.duration(), next.history);
  next.solver.rebalance = std::numeric_limits<double>::infinity();  // another partition begins with a body at rest
  if (!next.solver.keeps_velocities) std::ranges::fill(scene.body.velocity, Vector::Zero());
  scene.body.previous_velocity = *scene.body.velocity;
  scene.conditions = {};
  scene.body.heated.clear();
  scene.tools.clear();
  scene.warnings.clear();
  scene.quasi_static.reset();
  scene.control = control_of(next);
  scene.contact = std::move(contact);
  scene.fracture = std::move(fracture);
  return next;
}

}  // namespace

void keep_expansion(bool has_expanded, Body& body) {
  if (has_expanded && body.expansion.empty()) body.expansion.use(body.owned());
}

MigrationState migration_state_of(const Scene& scene, PointCloud cloud) {
  const bool has_expanded = scene.body.domain.communicator.any(!scene.body.expansion.empty());
  return {std::move(cloud), scene.weights, scene.dropped,           scene.points, scene.bonds,
          scene.pieces,     scene.tools,   scene.highest_frequency, has_expanded};
}

Scene set_up_again(const deck::Deck& deck, MigrationState migrated, const Communicator& communicator) {
  Scene scene = assembled(deck, std::move(migrated.cloud), std::move(migrated.weights), communicator);
  scene.points = migrated.points, scene.bonds = migrated.bonds, scene.pieces = migrated.pieces,
  scene.dropped = migrated.dropped;
  for (std::size_t t = 0; t < scene.tools.size(); ++t) *scene.tools[t].touched = *migrated.tools[t].touched;
  scene.highest_frequency = migrated.highest_frequency;
  scale_masses(scene.highest_frequency, scene.body);
  keep_expansion(migrated.has_expanded, scene.body);
  add_contact(deck, scene);
  return scene;
}

deck::Deck set_up_next(const deck::Deck& deck, const Conditions& held, contact::Contact contact,
                       std::optional<Fracture> fracture, Scene& scene) {
  const deck::Deck next = next_of(deck, std::move(contact), std::move(fracture), scene);
  add_conditions(next, deck.solver.initial_time, scene, scene.body.domain.communicator);
  keep_reaches(held, scene.conditions);
  return next;
}

PointCloud mesh_of(const deck::Deck& deck, const Communicator& communicator, deck::Problems& problems,
                   const io::Mesh* in_memory) {
  const auto is_of_mesh = [](const std::string& line) {
    return line.starts_with("Discretization") && !line.starts_with("Discretization > Bond Filters");
  };
  if (std::any_of(problems.lines().begin(), problems.lines().end(), is_of_mesh)) return {};
  PointCloud cloud;
  FacesOnPlanes apart;
  try {
    cloud = read_mesh(deck, communicator, in_memory, apart);
  } catch (const Error& error) {
    if (problems.empty()) throw;
    problems.add(error.what());
    return {};
  }
  check_names(cloud, communicator, problems);
  const std::vector<double> spacings = mean_spacings(cloud, communicator);
  check_blocks(deck, cloud, spacings, problems);
  check_horizons(deck, cloud, spacings, problems);
  check_faces(deck, cloud, communicator, in_memory, problems);
  check_places(deck, cloud, communicator, problems);
  add_node_sets(deck.node_sets, cloud, communicator, problems);
  check_conditions(deck, cloud, communicator, problems);
  check_interactions(deck, cloud, problems);
  if (communicator.any(!problems.empty())) return cloud;
  add_faces_without_images(deck, apart, communicator, cloud);
  take_off_cuts(deck, communicator, cloud);
  return cloud;
}

Scene set_up(const deck::Deck& deck, const Communicator& communicator) {
  deck::Problems problems;
  PointCloud cloud = mesh_of(deck, communicator, problems);
  raise_together(communicator, problems.text(deck.file.string()));
  return set_up(deck, std::move(cloud), communicator);
}

Scene set_up(const deck::Deck& deck, PointCloud cloud, const Communicator& communicator) {
  const std::vector<double> spacing = mean_spacings(cloud, communicator), taken = std::move(cloud.taken_volumes);
  PartitionWeights by;
  {
    const Timed timed(phase("Partition"));
    by = partition_weights(deck, cloud, spacing, communicator);
    cloud = partitioned(cloud, communicator, by);
  }
  Scene scene = assembled(deck, std::move(cloud), std::move(by), communicator);
  scene.points = communicator.sum(static_cast<std::int64_t>(scene.body.owned()));
  scene.bonds = communicator.sum(static_cast<std::int64_t>(scene.body.domain.families.bonds()));
  scene.pieces = numbered_pieces(scene.body.domain).second;
  add_contact(deck, scene);
  for (const std::string& note : deck.notes) scene.warnings += note + "\n";
  scene.warnings += places_of_probes(deck, scene.body.domain);
  scene.highest_frequency = scale_masses(deck, scene.body, scene.warnings);
  scene.warnings += mass_of_shared_nodes(scene.body, taken) + conditions_at_shared_nodes(deck, scene.body, taken);
  return scene;
}

}  // namespace strut

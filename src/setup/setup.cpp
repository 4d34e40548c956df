#include "setup/setup.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "base/errors.hpp"
#include "base/timing.hpp"
#include "setup/undeclared_contact.hpp"
#include "deck/problems.hpp"
#include "io/exodus/exodus.hpp"
#include "io/grid/grid.hpp"
#include "mechanics/formulation/quadratic_fit.hpp"
#include "mechanics/thin_members.hpp"
#include "points/bounding_box.hpp"
#include "points/partition.hpp"

namespace strut {

namespace {

bool is_quadratic(const deck::Material& material) { return material.formulation == deck::Formulation::quadratic; }

// Whether anything needs to know what the points are cells of.
bool needs_cells(const deck::Deck& deck) {
  return std::any_of(deck.materials.begin(), deck.materials.end(), is_quadratic) ||
         std::any_of(deck.blocks.begin(), deck.blocks.end(),
                     [](const deck::Block& block) { return !block.across_voids.value_or(true); });
}

PointCloud read_mesh(const deck::Deck& deck, const Communicator& communicator) {
  const Timed timed(phase("Mesh in"));
  const deck::Discretization& discretization = deck.discretization;
  const deck::Grid& grid = discretization.grid;
  const bool with_cells = needs_cells(deck);
  if (discretization.type == deck::MeshType::grid) {
    return io::make_grid(grid.origin, grid.length, grid.points, communicator, with_cells);
  }
  if (discretization.type == deck::MeshType::text) return io::read_text(discretization.mesh, communicator);
  const bool nodes = discretization.points == deck::Points::nodes;
  return io::read_exodus(discretization.mesh, communicator, nodes ? PointsAt::nodes : PointsAt::elements, with_cells);
}

// The points with the numbers; how many.
std::size_t mark_numbers(const std::vector<int>& numbers, std::uint64_t bit, PointCloud& cloud) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!std::binary_search(numbers.begin(), numbers.end(), cloud.element_ids[i])) continue;
    cloud.sets[i] |= bit;
    ++found;
  }
  return found;
}

// The value at X; throws Error where the arithmetic has no result (the root of a negative number, a division by zero).
double finite(const Function& function, const Vector& X, double t) {
  const double value = function(X[0], X[1], X[2], t);
  if (std::isfinite(value)) return value;
  std::ostringstream text;
  text << "'" << function.text() << "' is " << value << " at (" << X[0] << ", " << X[1] << ", " << X[2]
       << ") m, t = " << t << " s; expected a number everywhere";
  throw Error(text.str());
}

void mark(const deck::NodeSet& set, std::uint64_t bit, PointCloud& cloud) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vector& X = cloud.positions[i];
    const double value = finite(set.where, X, 0);
    if (value != 0) cloud.sets[i] |= bit;
  }
}

// Collective. Every number of a set is that of a point.
void add_numbered_set(const deck::NodeSet& set, std::uint64_t bit, PointCloud& cloud, const Communicator& communicator,
                      deck::Problems& problems) {
  const std::vector<int>& numbers = *set.numbers;
  const auto found = communicator.sum(static_cast<std::int64_t>(mark_numbers(numbers, bit, cloud)));
  const auto points = communicator.sum(static_cast<std::int64_t>(cloud.size()));
  if (found == static_cast<std::int64_t>(numbers.size())) return;
  problems.add("Boundary Conditions > " + set.name, "names " + std::to_string(numbers.size()) +
                                                        " points, up to number " + std::to_string(numbers.back()) +
                                                        ", of which the mesh has " + std::to_string(found) +
                                                        "; it has " + std::to_string(points) + " points");
}

// Collective. The node sets that the deck makes, added to those of the mesh.
void add_node_sets(const std::vector<deck::NodeSet>& sets, PointCloud& cloud, const Communicator& communicator,
                   deck::Problems& problems) {
  for (const deck::NodeSet& set : sets) {
    const std::string path = "Node Sets > " + set.name;
    if (cloud.set_names.size() >= 64) return problems.add(path, "mesh and deck have more than 64 node sets");
    const std::uint64_t bit = std::uint64_t{1} << cloud.set_names.size();
    cloud.set_names.push_back(set.name);
    if (set.numbers) {
      add_numbered_set(set, bit, cloud, communicator, problems);
      continue;
    }
    try {
      mark(set, bit, cloud);
    } catch (const Error& error) {
      problems.add(path, error.what());
    }
  }
}

// The Blocks section that names a block of the mesh; "all" and "default" are for those that no section names.
const deck::Block* section_of(const deck::Deck& deck, const std::string& block) {
  const deck::Block* general = nullptr;
  for (const deck::Block& section : deck.blocks) {
    for (const std::string& name : section.block_names) {
      if (name == block) return &section;
      if (name == "all" || name == "default") general = &section;
    }
  }
  return general;
}

void check_blocks(const deck::Deck& deck, const PointCloud& cloud, deck::Problems& problems) {
  for (const deck::Block& section : deck.blocks) {
    for (const std::string& name : section.block_names) {
      const auto& valid = cloud.block_names;
      if (name == "all" || name == "default" || std::find(valid.begin(), valid.end(), name) != valid.end()) continue;
      problems.add("Blocks > " + section.name + " > Block Names",
                   "the mesh has no block '" + name + "'" + did_you_mean(name, valid) + "; it has " + joined(valid));
    }
  }
  for (const std::string& name : cloud.block_names) {
    if (section_of(deck, name)) continue;
    problems.add("Blocks", "block '" + name + "' of the mesh has no material: name it in a section's Block Names");
  }
}

Formulation formulation_of(deck::Formulation formulation) {
  switch (formulation) {
    case deck::Formulation::ordinary:
      return Formulation::ordinary;
    case deck::Formulation::quadratic:
      return Formulation::quadratic;
    default:
      return Formulation::correspondence;
  }
}

std::vector<BlockMaterial> block_materials(const deck::Deck& deck, const PointCloud& cloud) {
  std::vector<BlockMaterial> materials;
  for (const std::string& name : cloud.block_names) {
    const deck::Material& material = deck.materials[section_of(deck, name)->material];
    const auto coefficient = [&material](deck::StabilizationType type) {
      return material.stabilization == type ? material.stabilization_coefficient : 0.0;
    };
    const bool ordinary = material.formulation == deck::Formulation::ordinary;
    materials.push_back({material.density,
                         material.law,
                         coefficient(deck::StabilizationType::silling),
                         formulation_of(material.formulation),
                         ordinary ? 0.0 : coefficient(deck::StabilizationType::mean_gradient),
                         {material.linear_viscosity, material.quadratic_viscosity}});
  }
  return materials;
}

// Sections that are bodies of their own are numbered by their place, from 1; all others are body 0.
std::vector<BlockBonds> block_bonds(const deck::Deck& deck, const PointCloud& cloud) {
  std::vector<BlockBonds> bonds;
  for (const std::string& name : cloud.block_names) {
    const deck::Block* section = section_of(deck, name);
    const int place = static_cast<int>(section - deck.blocks.data());
    const int body = section->separate_body ? place + 1 : 0;
    bonds.push_back(section->horizon_factor ? BlockBonds::per_spacing(*section->horizon_factor, body)
                                            : BlockBonds(*section->horizon, body));
    const deck::Material& material = deck.materials[section->material];
    const bool by_touch = is_quadratic(material) && cloud.joined;
    const bool is_alike = deck.discretization.influence == deck::Influence::one;  // others fade with the distance
    bonds.back().touching = by_touch && is_alike && !section->across_voids.value_or(false);
    bonds.back().through_material = !section->across_voids.value_or(!(by_touch && !is_alike));
    const bool any = bonds.back().touching || bonds.back().through_material;
    if (any || material.formulation != deck::Formulation::correspondence) bonds.back().families = FamilyKind::lists;
  }
  return bonds;
}

// The mean spacing of each block's points over all ranks, m; 0 where it has none.
std::vector<double> mean_spacings(const PointCloud& cloud, const Communicator& communicator) {
  std::vector<double> sums(2 * cloud.block_names.size(), 0);  // spacings and number of points of each block
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    sums[2 * cloud.blocks[i]] += cloud.spacings[i];
    sums[2 * cloud.blocks[i] + 1] += 1;
  }
  communicator.sum(sums);
  std::vector<double> result;
  for (std::size_t b = 0; b < sums.size(); b += 2) result.push_back(sums[b] / std::max(1.0, sums[b + 1]));
  return result;
}

// A horizon in m that is smaller than the spacing, or a hundred times as large, is a slip of units.
void check_horizons(const deck::Deck& deck, const PointCloud& cloud, const std::vector<double>& spacings,
                    deck::Problems& problems) {
  for (std::size_t b = 0; b < cloud.block_names.size(); ++b) {
    const deck::Block* section = section_of(deck, cloud.block_names[b]);
    if (!section || !section->horizon || spacings[b] == 0) continue;  // check_blocks tells of blocks without a section
    if (*section->horizon > spacings[b] && *section->horizon < 20 * spacings[b]) continue;
    std::ostringstream text;
    text << *section->horizon << " m does not fit the points of block " << cloud.block_names[b]
         << ", whose mean spacing is " << spacings[b]
         << " m: expected between 1 and 20 spacings, usually 2 to 4 (is the mesh in m?)";
    problems.add("Blocks > " + section->name + " > Horizon", text.str());
  }
}

// What a step of a point of each block takes, in ns, roughly (tests/bench): its bonds and its update.
std::vector<double> step_costs(const deck::Deck& deck, const PointCloud& cloud, std::vector<double> costs) {
  constexpr double update = 80, state = 150;
  for (std::size_t b = 0; b < costs.size(); ++b) {
    const deck::Block& section = *section_of(deck, cloud.block_names[b]);
    const auto has_state = []<class L>(const L&) { return materials::state_size<L> > 0; };
    const bool flows = std::visit(has_state, deck.materials[section.material].law);
    costs[b] += update + (flows ? state : 0);
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

// The axis along which two bodies lie one after the other, if there is one: they will meet on this way.
std::optional<int> way_between(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b) {
  constexpr double hardly = 0.1;  // of the smaller one's length
  if (a.isEmpty() || b.isEmpty()) return std::nullopt;
  const Vector common = a.max().cwiseMin(b.max()) - a.min().cwiseMax(b.min());
  int axis = 0;
  return common.minCoeff(&axis) <= hardly * std::min(a.sizes()[axis], b.sizes()[axis]) ? std::optional(axis)
                                                                                       : std::nullopt;
}

// Collective. A cut between two bodies that meet would leave all of the contact to one rank, and a cut along their way
// shares it: a length along the way counts half. A cut across the pencils of a lattice leaves parts of them, with the
// work of whole ones, to both ranks (an eighth of a step of 46³ points), one between planes twice the sums of some (2
// %).
Vector lengths_for_cuts(const std::vector<contact::Interaction>& interactions, const std::vector<BlockBonds>& bonds,
                        bool by_stencils, const PointCloud& cloud, const Communicator& communicator) {
  const Vector alone = by_stencils ? Vector(0.7, 1, 0.95) : Vector(1, 1, 1);
  if (interactions.empty()) return alone;
  Vector lengths = alone;
  const std::vector<Eigen::AlignedBox3d> boxes = boxes_of_blocks(cloud, communicator);
  for (const auto& [first, second, model] : interactions) {
    if (bonds[first].body == bonds[second].body) continue;
    if (const auto axis = way_between(boxes[first], boxes[second])) lengths[*axis] = 0.5 * alone[*axis];
  }
  return lengths;
}

// Every interaction names blocks of the mesh.
void check_interactions(const deck::Deck& deck, const PointCloud& cloud, deck::Problems& problems) {
  const std::vector<std::string>& valid = cloud.block_names;
  for (const deck::Interaction& one : deck.interactions) {
    for (const auto& [key, name] : {std::pair("First Block", one.first_block), {"Second Block", one.second_block}}) {
      if (name.empty() || std::find(valid.begin(), valid.end(), name) != valid.end()) continue;
      problems.add("Contact > Interactions > " + one.name + " > " + key,
                   "the mesh has no block '" + name + "'" + did_you_mean(name, valid) + "; it has " + joined(valid));
    }
  }
}

// The points of this rank in a node set, a block, or all; none where there is no such set.
std::vector<int> points_of(const PointCloud& cloud, const std::string& set) {
  const auto position = [&set](const std::vector<std::string>& names) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), set) - names.begin());
  };
  const std::size_t bit = position(cloud.set_names), block = position(cloud.block_names);
  std::vector<int> points;
  for (int i = 0; i < static_cast<int>(cloud.size()); ++i) {
    const bool in = set == "all" || (bit < cloud.set_names.size() ? (cloud.sets[i] >> bit & 1) != 0
                                                                  : cloud.blocks[i] == static_cast<int>(block));
    if (in) points.push_back(i);
  }
  return points;
}

// Collective. Every condition names a set that holds a point of some rank.
void check_conditions(const deck::Deck& deck, const PointCloud& cloud, const Communicator& communicator,
                      deck::Problems& problems) {
  std::vector<std::string> valid{"all"};
  valid.insert(valid.end(), cloud.set_names.begin(), cloud.set_names.end());
  valid.insert(valid.end(), cloud.block_names.begin(), cloud.block_names.end());
  std::vector<double> counts;
  for (const deck::Condition& condition : deck.conditions) {
    counts.push_back(static_cast<double>(points_of(cloud, condition.node_set).size()));
  }
  communicator.sum(counts);
  for (std::size_t c = 0; c < counts.size(); ++c) {
    const std::string& set = deck.conditions[c].node_set;
    const std::string path = "Boundary Conditions > " + deck.conditions[c].name + " > Node Set";
    if (std::find(valid.begin(), valid.end(), set) == valid.end()) {
      problems.add(path, "there is no node set or block '" + set + "'" + did_you_mean(set, valid) + "; there are " +
                             joined(valid));
    } else if (counts[c] == 0) {
      problems.add(path, "'" + set + "' holds no point");
    }
  }
}

// Owned points whose family cannot carry a shape tensor; `text` tells of the first.
std::vector<int> degenerate_points(const deck::Deck& deck, const Domain& domain, std::string& text) {
  std::vector<int> found;
  std::vector<char> by_cells;  // of blocks
  for (const std::string& name : domain.cloud.block_names) {
    by_cells.push_back(is_quadratic(deck.materials[section_of(deck, name)->material]));
  }
  for (int i = 0; i < domain.owned; ++i) {
    const LatticeFamilies* stencil = domain.families.lattice(i);
    if (stencil && stencil->spans_space(i)) continue;  // without a sum over the family
    const char* reason = degeneracy(domain.families.size(i), family_spread(domain, i));
    if (!reason && by_cells[domain.cloud.blocks[i]] && !spans_cell(domain, i)) reason = "they hardly span space";
    if (!reason) continue;
    found.push_back(i);
    if (found.size() > 1) continue;
    const Vector X = domain.reference(i);
    std::ostringstream line;
    line << word(domain.cloud.at) << " " << domain.cloud.element_ids[i] << " of block "
         << domain.cloud.block_names[domain.cloud.blocks[i]] << " at (" << X[0] << ", " << X[1] << ", " << X[2]
         << ") m has " << domain.families.size(i) << " neighbors: " << reason;
    text = line.str();
  }
  return found;
}

PointCloud without(const PointCloud& cloud, const std::vector<int>& dropped) {
  std::vector<int> kept;
  for (int i = 0; i < static_cast<int>(cloud.size()); ++i) {
    if (!std::binary_search(dropped.begin(), dropped.end(), i)) kept.push_back(i);
  }
  return reordered(cloud, kept);
}

// Families of the partitioned cloud, less the points that the deck lets go. Dropping one may expose others.
Domain healthy_domain(const deck::Deck& deck, PointCloud cloud, const Communicator& communicator,
                      std::int64_t& dropped) {
  const Timed timed(phase("Families"));
  const std::vector<BlockBonds> bonds = block_bonds(deck, cloud);
  for (;;) {
    Domain domain = make_domain(std::move(cloud), bonds, communicator);
    std::string text;
    const std::vector<int> degenerate = degenerate_points(deck, domain, text);
    const std::int64_t count = communicator.sum(static_cast<std::int64_t>(degenerate.size()));
    if (count == 0) return domain;
    if (deck.discretization.degenerate == deck::DegeneratePoints::error) {
      if (!text.empty()) {
        text = "Discretization > Degenerate Points: " + std::to_string(count) +
               " points have too few neighbors for a shape tensor; " + text +
               ". Enlarge the horizon, mend the mesh, or say \"Drop\" to leave such points out";
      }
      raise_together(communicator, text);
    }
    dropped += count;
    cloud = without(whole_cloud(domain), degenerate);
    if (communicator.sum(static_cast<std::int64_t>(cloud.size())) == 0) {
      raise_together(communicator, "Discretization > Degenerate Points: no point is left after dropping");
    }
  }
}

void set_initial_velocity(const deck::Condition& condition, const std::vector<int>& points, double t, Body& body) {
  for (const int i : points) {
    body.velocity[i][condition.component] = finite(condition.value, body.domain.reference(i), t);
  }
}

Shape shape_of(const deck::Condition& condition) {
  switch (condition.type) {
    case deck::ConditionType::rigid_cylinder:
      return Cylinder{condition.point, condition.axis.normalized(), condition.radius};
    case deck::ConditionType::rigid_box:
      return Box{condition.lower, condition.upper};
    default:
      return HalfSpace{condition.point, condition.normal.normalized()};
  }
}

// `place`: of the condition in the deck.
void add_condition(const deck::Condition& condition, int place, double t, Scene& scene) {
  std::vector<int> points = points_of(scene.body.domain.cloud, condition.node_set);
  for (const int i : points) finite(condition.value, scene.body.domain.reference(i), t);
  Conditions& all = scene.conditions;
  const Vector normal = condition.normal.normalized();
  switch (condition.type) {
    case deck::ConditionType::initial_velocity:
      return set_initial_velocity(condition, points, t, scene.body);
    case deck::ConditionType::prescribed_displacement:
    case deck::ConditionType::prescribed_velocity: {
      const bool is_velocity = condition.type == deck::ConditionType::prescribed_velocity;
      all.motions.push_back({std::move(points), condition.component, condition.value, is_velocity, place});
      return;
    }
    case deck::ConditionType::body_force:
      all.body_forces.push_back({std::move(points), condition.component, condition.value});
      return;
    case deck::ConditionType::symmetry_plane:
      all.symmetry_planes.push_back({std::move(points), normal, place});
      return;
    case deck::ConditionType::rigid_plane:
    case deck::ConditionType::rigid_cylinder:
    case deck::ConditionType::rigid_box:
      all.tools.push_back({std::move(points), shape_of(condition), condition.travel, condition.friction, place});
      return;
    case deck::ConditionType::open_end:
      all.open_ends.push_back(open_end(points, normal, scene.body));
  }
}

void add_conditions(const deck::Deck& deck, Scene& scene, const Communicator& communicator) {
  deck::Problems problems;
  if (scene.dropped > 0) check_conditions(deck, scene.body.domain.cloud, communicator, problems);  // once more
  for (int place = 0; place < static_cast<int>(deck.conditions.size()); ++place) {
    const deck::Condition& condition = deck.conditions[place];
    try {
      add_condition(condition, place, deck.solver.initial_time, scene);
    } catch (const Error& error) {
      problems.add("Boundary Conditions > " + condition.name + " > Value", error.what());
    }
  }
  raise_together(communicator, problems.text(deck.file.string()));
}

// Interactions of blocks: the named ones, then every other pair where one names none.
std::vector<contact::Interaction> interactions_of(const deck::Deck& deck, const PointCloud& cloud) {
  const auto model = [&](const deck::Interaction& one) {
    const deck::ContactModel& model = deck.contact_models[one.model];
    return contact::Model{model.radius, model.penalty, model.friction};
  };
  const auto block = [&](const std::string& name) {
    return static_cast<int>(std::find(cloud.block_names.begin(), cloud.block_names.end(), name) -
                            cloud.block_names.begin());
  };
  std::map<std::pair<int, int>, contact::Model> models;  // the first entry of a pair holds
  for (const deck::Interaction& one : deck.interactions) {
    if (!one.first_block.empty())
      models.emplace(std::minmax({block(one.first_block), block(one.second_block)}), model(one));
  }
  const int blocks = static_cast<int>(cloud.block_names.size());
  for (const deck::Interaction& one : deck.interactions) {
    for (int a = 0; one.first_block.empty() && a < blocks; ++a) {
      for (int b = a; b < blocks; ++b) {
        const bool meant = one.partners == deck::Partners::any || (a == b) == (one.partners == deck::Partners::itself);
        if (meant) models.emplace(std::pair(a, b), model(one));
      }
    }
  }
  std::vector<contact::Interaction> interactions;
  for (const auto& [pair, model] : models) interactions.push_back({pair.first, pair.second, model});
  return interactions;
}

// Collective.
Cuts cuts(const deck::Deck& deck, const PointCloud& cloud, const std::vector<double>& spacings,
          const Communicator& communicator) {
  const std::vector<BlockBonds> bonds = block_bonds(deck, cloud);
  const BondCosts costs = bond_costs(cloud, bonds, spacings, communicator);
  return {step_costs(deck, cloud, costs.of_block),
          lengths_for_cuts(interactions_of(deck, cloud), bonds, costs.by_stencils, cloud, communicator)};
}

// Collective. A line for each block whose members are so thin that they lose a tenth of their bending stiffness.
std::string thin_members(const Body& body) {
  constexpr double worth_saying = 0.9;
  std::ostringstream text;
  text.precision(2);
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    const MaterialBlock& block = body.blocks[b];
    const double thickness = thickness_of(body.domain, static_cast<int>(b));
    const double spacing = body.domain.blocks[b].spacing;
    const double horizon = spacing > 0 ? body.domain.blocks[b].largest / spacing : 0;
    const Formulation formulation = block.material.formulation;
    const double kept = bending_stiffness_kept(formulation, horizon, thickness);
    if (kept >= worth_saying) continue;
    text << "block '" << block.name << "': members are " << thickness
         << " spacings thick (4 volume/surface); so thin they keep about " << 100 * kept
         << " % of their bending stiffness";
    if (formulation == Formulation::correspondence) {
      text << ", by Formulation 'Quadratic Correspondence' some "
           << 100 * bending_stiffness_kept(Formulation::quadratic, horizon, thickness) << " %";
    }
    text << "\n";
  }
  return text.str();
}

std::optional<QuasiStaticControl> quasi_static_of(const deck::Solver& solver) {
  if (!solver.quasi_static) return std::nullopt;
  const auto& [with_tangent, load_steps, tolerance, most_iterations] = *solver.quasi_static;
  return QuasiStaticControl{with_tangent, load_steps, {tolerance, most_iterations}};
}

Influence influence_of(deck::Influence influence) {
  switch (influence) {
    case deck::Influence::one:
      return Influence::one;
    case deck::Influence::linear_decay:
      return Influence::linear_decay;
    default:
      return Influence::cubic_decay;
  }
}

}  // namespace

Scene set_up(const deck::Deck& deck, const Communicator& communicator) {
  PointCloud cloud = read_mesh(deck, communicator);
  deck::Problems problems;
  check_blocks(deck, cloud, problems);
  const std::vector<double> spacing = mean_spacings(cloud, communicator);
  check_horizons(deck, cloud, spacing, problems);
  add_node_sets(deck.node_sets, cloud, communicator, problems);
  check_conditions(deck, cloud, communicator, problems);
  check_interactions(deck, cloud, problems);
  raise_together(communicator, problems.text(deck.file.string()));
  {
    const Timed timed(phase("Partition"));
    cloud = partitioned(cloud, communicator, cuts(deck, cloud, spacing, communicator));
  }
  std::int64_t dropped = 0;
  const std::vector<BlockMaterial> materials = block_materials(deck, cloud);
  Domain domain = healthy_domain(deck, std::move(cloud), communicator, dropped);
  Scene scene{
      make_body(std::move(domain), influence_of(deck.discretization.influence), materials),
      {},
      {},
      {deck.solver.fixed_dt.value_or(0), deck.solver.safety_factor, deck.solver.subcycling, !deck.watch.stops_inverted},
      quasi_static_of(deck.solver),
      0,
      0,
      dropped};
  scene.points = communicator.sum(static_cast<std::int64_t>(scene.body.owned()));
  scene.bonds = communicator.sum(static_cast<std::int64_t>(scene.body.domain.families.bonds()));
  add_conditions(deck, scene, communicator);
  const std::vector<contact::Interaction> interactions = interactions_of(deck, scene.body.domain.cloud);
  scene.contact = contact::Contact(interactions, scene.body.domain);
  for (const std::string& note : deck.notes) scene.warnings += note + "\n";
  scene.warnings += thin_members(scene.body);
  scene.warnings += undeclared_contacts(scene, interactions, deck.solver.initial_time,
                                     deck.solver.final_time - deck.solver.initial_time);
  return scene;
}

}  // namespace strut

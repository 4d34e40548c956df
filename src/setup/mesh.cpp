#include "setup/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <sstream>

#include "base/errors.hpp"
#include "base/math/function.hpp"
#include "base/parallel/communicator.hpp"
#include "base/parallel/gather_scatter.hpp"
#include "base/text.hpp"
#include "base/timing.hpp"
#include "io/exodus/exodus.hpp"
#include "io/exodus/unmatched_faces.hpp"
#include "io/grid/grid.hpp"
#include "setup/blocks.hpp"
#include "setup/mirrors.hpp"
#include "setup/periods.hpp"
#include "topology/coincident.hpp"

namespace strut {

namespace {

// The mesh in memory; without points where this rank has none.
const io::Mesh& mesh_here(const io::Mesh* in_memory) {
  static const io::Mesh none;
  return in_memory ? *in_memory : none;
}

const std::string mesh_key = "Discretization > Input Mesh File";  // in messages, also for a mesh in memory

// True if surface contact or layers of a profile need the faces of cells; points at nodes lie on them.
bool meets_faces(const deck::Deck& deck) {
  const auto is_of_surfaces = [](const deck::ContactModel& one) {
    return std::holds_alternative<contact::SurfaceLaw>(one.model.law);
  };
  return deck.discretization.points == deck::Points::elements &&
         (!deck.history.profiles.empty() ||
          std::any_of(deck.contact_models.begin(), deck.contact_models.end(), is_of_surfaces));
}

// True if tools, non-reflecting ends or cracks need the edges of cells, which are no cubes everywhere.
bool needs_edges(const deck::Deck& deck) {
  const auto is_for_edges = [](const deck::Condition& one) {
    return std::holds_alternative<RigidTool>(one.kind) || std::holds_alternative<NonReflectingEnd>(one.kind);
  };
  return !deck.damage_models.empty() || std::any_of(deck.conditions.begin(), deck.conditions.end(), is_for_edges);
}

// True if anything needs the shapes of cells.
bool needs_cells(const deck::Deck& deck) {
  return std::any_of(deck.materials.begin(), deck.materials.end(), is_quadratic) || meets_faces(deck) ||
         needs_edges(deck) || std::any_of(deck.blocks.begin(), deck.blocks.end(), [](const deck::Block& block) {
           return !block.across_voids.value_or(true);
         });
}

// Collective. Marks the points with these numbers; returns how many of the numbers were found. A mesh may have one of
// them twice.
std::int64_t mark_numbers(const std::vector<std::int64_t>& numbers, std::uint64_t bit, PointCloud& cloud,
                          const Communicator& communicator) {
  std::vector<double> found(numbers.size(), 0);  // 1: it was
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto place = std::lower_bound(numbers.begin(), numbers.end(), cloud.element_ids[i]);
    if (place == numbers.end() || *place != cloud.element_ids[i]) continue;
    cloud.sets[i] |= bit;
    found[place - numbers.begin()] = 1;
  }
  communicator.max(found);
  return std::count(found.begin(), found.end(), 1.0);
}

// Collective. Marks the point whose position(i) is nearest to `place`; if several are, the first of the mesh.
template <class Position>
void mark_nearest(const Vector& place, std::uint64_t bit, const Position& position, PointCloud& cloud,
                  const Communicator& communicator) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const auto distance = [&](std::size_t i) { return (position(i) - place).squaredNorm(); };
  double nearest = none, first = none;
  for (std::size_t i = 0; i < cloud.size(); ++i) nearest = std::min(nearest, distance(i));
  nearest = communicator.min(nearest) * (1 + 1e-9);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (distance(i) <= nearest) first = std::min(first, static_cast<double>(cloud.ids[i]));
  }
  first = communicator.min(first);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (static_cast<double>(cloud.ids[i]) == first) cloud.sets[i] |= bit;
  }
}

void mark(const deck::NodeSet& set, std::uint64_t bit, PointCloud& cloud) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vector& X = cloud.positions[i];
    const double value = finite_value(set.where, X, 0);
    if (value != 0) cloud.sets[i] |= bit;
  }
}

std::string path_of(const deck::NodeSet& set) {
  const char* const section = set.numbers ? "Boundary Conditions" : set.nearest ? "History > Probes" : "Node Sets";
  return std::string(section) + " > " + set.name;
}

// Reports a set that the mesh or the deck has already, because the name would be ambiguous.
bool is_taken(const deck::NodeSet& set, const PointCloud& cloud, std::size_t sets_of_mesh, deck::Problems& problems) {
  const auto place = [&set](const std::vector<std::string>& names) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), set.name) - names.begin());
  };
  const std::size_t same = place(cloud.set_names);
  const std::string expected = "' already; expected another name";
  if (same < cloud.set_names.size()) {
    problems.add(path_of(set), (same < sets_of_mesh ? "the mesh has a node set '" : "the deck has a node set '") +
                                   set.name + expected);
    return true;
  }
  if (place(cloud.block_names) < cloud.block_names.size())
    problems.add(path_of(set), "the mesh has a block '" + set.name + expected);
  return false;
}

// Collective. Checks that every number of a set belongs to a point.
void add_numbered_set(const deck::NodeSet& set, std::uint64_t bit, PointCloud& cloud, const Communicator& communicator,
                      deck::Problems& problems) {
  const std::vector<std::int64_t>& numbers = *set.numbers;
  const std::int64_t found = mark_numbers(numbers, bit, cloud, communicator);
  const auto points = communicator.sum(static_cast<std::int64_t>(cloud.size()));
  if (found == static_cast<std::int64_t>(numbers.size())) return;
  problems.add(path_of(set), "names " + std::to_string(numbers.size()) + " points, up to number " +
                                 std::to_string(numbers.back()) + ", of which the mesh has " + std::to_string(found) +
                                 "; it has " + std::to_string(points) + " points");
}

// Collective. The first point, in the order of the file, whose position is not resolved to a hundredth of its cell's
// edge; "" if there is none.
std::string unresolved_place(const PointCloud& cloud, const Communicator& communicator) {
  constexpr double least = 0.01, none = std::numeric_limits<double>::infinity();
  const auto round_off = [&](std::size_t i) {
    return std::numeric_limits<double>::epsilon() * cloud.positions[i].cwiseAbs().maxCoeff();
  };
  double first = none;
  std::string text;
  for (std::size_t i = 0; i < cloud.size() && first == none; ++i) {
    const double volume = cloud.volumes[i], edge = std::cbrt(volume);
    if (std::isnormal(volume) && round_off(i) < least * edge) continue;
    first = static_cast<double>(cloud.ids[i]);
    text = text_of(word(cloud.at), " ", cloud.element_ids[i], " of block '", cloud.block_names[cloud.blocks[i]],
                   "' at (", cloud.positions[i].transpose(), ") m has a volume of ", volume, " m³: an edge of ", edge,
                   " m, where numbers are ", round_off(i),
                   " m apart; expected places and volumes in m and m³ that numbers tell apart");
  }
  const double of_all = communicator.min(first);
  if (of_all == none) return "";
  if (of_all != first) text.clear();
  const std::vector<char> gathered = gather(communicator, std::span<const char>(text));
  text.assign(gathered.begin(), gathered.end());
  communicator.broadcast(text);
  return text;
}

}  // namespace

PointCloud read_mesh(const deck::Deck& deck, const Communicator& communicator, const io::Mesh* in_memory,
                     FacesOnPlanes& apart) {
  const Timed timed(phase("Mesh in"));
  const deck::Discretization& discretization = deck.discretization;
  const deck::Grid& grid = discretization.grid;
  std::vector<Mirror> planes = symmetry_planes(deck);
  const std::vector<Mirror> sides = sides_of_periods(deck);
  planes.insert(planes.end(), sides.begin(), sides.end());
  const bool with_cells =
      needs_cells(deck) || (!planes.empty() && deck.discretization.points == deck::Points::elements);
  if (discretization.type == deck::MeshType::grid) {
    std::optional<std::array<int, 3>> box;
    const deck::Block* block = section_of(deck, "block_1");
    if (grid.boxes && block) box = box_reach(grid, *block);
    return io::make_grid(grid.origin, grid.length, grid.points, communicator, with_cells, planes, box, &apart);
  }
  if (discretization.type == deck::MeshType::text) return io::read_text(discretization.mesh, communicator);
  const PointsAt at = discretization.points == deck::Points::nodes ? PointsAt::nodes : PointsAt::elements;
  if (discretization.type == deck::MeshType::memory)
    return io::points_of(mesh_here(in_memory), communicator, at, with_cells, planes, &apart);
  return io::read_exodus(discretization.mesh, communicator, at, with_cells, planes, &apart);
}

void check_names(const PointCloud& cloud, const Communicator& communicator, deck::Problems& problems) {
  for (std::size_t k = 0; k < cloud.set_names.size(); ++k) {
    if (cloud.set_names[k] != "all") continue;
    const auto in = [k](std::uint64_t sets) { return (sets >> k & 1) != 0; };
    const auto inside = communicator.sum(std::int64_t{std::count_if(cloud.sets.begin(), cloud.sets.end(), in)});
    const auto points = communicator.sum(std::ssize(cloud.ids));
    if (inside == points) continue;
    problems.add(mesh_key, "its node set 'all' holds " + std::to_string(inside) + " of " + std::to_string(points) +
                               " points, and in a deck 'all' means all of them; expected another name in the mesh");
  }
  for (const std::string& name : cloud.block_names) {
    if (cloud.block_names.size() == 1 || (name != "all" && name != "default")) continue;
    problems.add(mesh_key, "its block '" + name + "' is one of several, and in a deck '" + name +
                               "' means more than it (Blocks > Block Names); expected another name in the mesh");
  }
}

void check_places(const deck::Deck& deck, const PointCloud& cloud, const Communicator& communicator,
                  deck::Problems& problems) {
  const std::string unresolved = unresolved_place(cloud, communicator);
  const bool is_grid = deck.discretization.type == deck::MeshType::grid;
  if (!unresolved.empty()) return problems.add(is_grid ? "Discretization" : mesh_key, unresolved);
  if (is_grid || (cloud.at == PointsAt::nodes && !problems.empty())) return;
  // Cells never overlap. Nodes may coincide, in bodies that touch and at the faces of a crack, if there is no bond
  // between them.
  std::vector<BlockBonds> bonds;
  if (cloud.at == PointsAt::nodes) bonds = block_bonds(deck, cloud);
  const auto by_elements = [&](int b) { return bonds[b].visible_only || bonds[b].touching; };
  const auto allowed = [&](int a, int b) {
    return !bonds.empty() && (bonds[a].body != bonds[b].body || by_elements(a) || by_elements(b));
  };
  const std::string twins = coincident_points(cloud, communicator, allowed);
  if (!twins.empty()) problems.add(mesh_key, twins);
}

namespace {

std::vector<io::UnmatchedFaces> unmatched_faces(const deck::Deck& deck, const Communicator& communicator,
                                                const io::Mesh* in_memory) {
  const deck::Discretization& discretization = deck.discretization;
  const bool has_fits = std::any_of(deck.materials.begin(), deck.materials.end(), is_quadratic);
  if (!has_fits || discretization.points == deck::Points::nodes) return {};
  if (discretization.type == deck::MeshType::exodus) return io::unmatched_faces(discretization.mesh, communicator);
  if (discretization.type != deck::MeshType::memory) return {};
  return io::unmatched_faces(mesh_here(in_memory), communicator);
}

}  // namespace

// Each of the two would count as free surface in the fit of its cell.
void check_faces(const deck::Deck& deck, const PointCloud& cloud, const Communicator& communicator,
                 const io::Mesh* in_memory, deck::Problems& problems) {
  for (const auto& [block, other, count, element] : unmatched_faces(deck, communicator, in_memory)) {
    const deck::Block *one = section_of(deck, cloud.block_names[block]),
                      *next = section_of(deck, cloud.block_names[other]);
    if (!one || !next || (one != next && (one->separate_body || next->separate_body))) continue;
    const auto has_fits = [&](const deck::Block& section) {
      return section.material < std::ssize(deck.materials) && is_quadratic(deck.materials[section.material]);
    };
    if (!has_fits(*one) && !has_fits(*next)) continue;
    problems.add(mesh_key,
                 text_of(count, " faces of elements of block '", cloud.block_names[block], "', the first of element ",
                         element, ", meet faces with other corners of block '", cloud.block_names[other],
                         "', and Formulation 'Quadratic Correspondence' would take both for free surface "
                         "(bars of such tetrahedra bear a third of their load; at a seam of cubes of two sizes strain "
                         "was found to be 3.4 times the mean); expected a mesh in which neighbors have a face in "
                         "common (squares halved along one diagonal, no hanging nodes)"));
  }
}

void add_node_sets(const std::vector<deck::NodeSet>& sets, PointCloud& cloud, const Communicator& communicator,
                   deck::Problems& problems) {
  const std::size_t sets_of_mesh = cloud.set_names.size();
  for (const deck::NodeSet& set : sets) {
    if (is_taken(set, cloud, sets_of_mesh, problems)) continue;
    if (cloud.set_names.size() >= 64) return problems.add(path_of(set), "mesh and deck have more than 64 node sets");
    const std::uint64_t bit = std::uint64_t{1} << cloud.set_names.size();
    cloud.set_names.push_back(set.name);
    if (set.nearest) {  // asked first: a set of Boundary Conditions has numbers, too, which are then empty
      mark_nearest(
          *set.nearest, bit, [&](std::size_t i) { return cloud.positions[i]; }, cloud, communicator);
      continue;
    }
    if (set.numbers) {
      add_numbered_set(set, bit, cloud, communicator, problems);
      continue;
    }
    try {
      mark(set, bit, cloud);
    } catch (const Error& error) {
      problems.add(path_of(set), error.what());
    }
  }
}

namespace {

std::uint64_t bit_of(const deck::NodeSet& set, const PointCloud& cloud) {
  const auto place = std::find(cloud.set_names.begin(), cloud.set_names.end(), set.name);
  return std::uint64_t{1} << (place - cloud.set_names.begin());
}

}  // namespace

void find_probes_again(const std::vector<deck::NodeSet>& sets, Domain& domain) {
  for (const deck::NodeSet& probe : sets) {
    if (!probe.nearest) continue;
    const std::uint64_t bit = bit_of(probe, domain.cloud);
    const auto holds = [bit](std::uint64_t sets_of_point) { return (sets_of_point & bit) != 0; };
    if (domain.communicator.any(std::ranges::any_of(domain.cloud.sets, holds))) continue;
    const auto position = [&domain](std::size_t i) { return domain.reference(static_cast<int>(i)); };
    mark_nearest(*probe.nearest, bit, position, domain.cloud, domain.communicator);
  }
}

std::string places_of_probes(const deck::Deck& deck, const Domain& domain) {
  std::string lines;
  const PointCloud& cloud = domain.cloud;
  for (const deck::NodeSet& probe : deck.node_sets) {
    if (!probe.nearest) continue;
    const std::uint64_t bit = bit_of(probe, cloud);
    std::ostringstream mine;
    for (int i = 0; i < domain.owned; ++i) {
      if ((cloud.sets[i] & bit) == 0) continue;
      const Vector X = domain.reference(i);
      const double away = (X - *probe.nearest).norm();
      mine << (away > cloud.spacings[i] ? "WARNING: " : "") << "the probe '" << probe.name << "' is " << word(cloud.at)
           << " " << cloud.element_ids[i] << " of block '" << cloud.block_names[cloud.blocks[i]] << "' at ("
           << X.transpose() << ") m, " << away << " m from its Point\n";
    }
    std::vector<char> line = gather(domain.communicator, std::span<const char>(mine.str()));
    domain.communicator.broadcast(line);
    lines.append(line.begin(), line.end());
  }
  return lines;
}

}  // namespace strut

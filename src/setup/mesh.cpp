#include "setup/mesh.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"
#include "base/timing.hpp"
#include "io/exodus/exodus.hpp"
#include "io/grid/grid.hpp"
#include "setup/blocks.hpp"
#include "setup/finite_value.hpp"
#include "setup/mirrors.hpp"

namespace strut {

namespace {

// Whether anything meets the faces of cells: points at nodes lie on them.
bool meets_faces(const deck::Deck& deck) {
  const auto is_tool = [](const deck::Condition& one) { return std::holds_alternative<RigidTool>(one.kind); };
  const auto is_of_surfaces = [](const deck::ContactModel& one) {
    return std::holds_alternative<contact::SurfaceLaw>(one.model.law);
  };
  return deck.discretization.points == deck::Points::elements &&
         (std::any_of(deck.conditions.begin(), deck.conditions.end(), is_tool) ||
          std::any_of(deck.contact_models.begin(), deck.contact_models.end(), is_of_surfaces));
}

// Whether anything needs to know what the points are cells of.
bool needs_cells(const deck::Deck& deck) {
  return std::any_of(deck.materials.begin(), deck.materials.end(), is_quadratic) || meets_faces(deck) ||
         std::any_of(deck.blocks.begin(), deck.blocks.end(),
                     [](const deck::Block& block) { return !block.across_voids.value_or(true); });
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

void mark(const deck::NodeSet& set, std::uint64_t bit, PointCloud& cloud) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vector& X = cloud.positions[i];
    const double value = finite_value(set.where, X, 0);
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

}  // namespace

PointCloud read_mesh(const deck::Deck& deck, const Communicator& communicator) {
  const Timed timed(phase("Mesh in"));
  const deck::Discretization& discretization = deck.discretization;
  const deck::Grid& grid = discretization.grid;
  const std::vector<Mirror> planes = symmetry_planes(deck);
  const bool with_cells =
      needs_cells(deck) || (!planes.empty() && deck.discretization.points == deck::Points::elements);
  if (discretization.type == deck::MeshType::grid) {
    return io::make_grid(grid.origin, grid.length, grid.points, communicator, with_cells, planes);
  }
  if (discretization.type == deck::MeshType::text) return io::read_text(discretization.mesh, communicator);
  const bool nodes = discretization.points == deck::Points::nodes;
  return io::read_exodus(discretization.mesh, communicator, nodes ? PointsAt::nodes : PointsAt::elements, with_cells,
                         planes);
}

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

}  // namespace strut

#include "setup/partition_weights.hpp"

#include <algorithm>
#include <optional>

#include "mechanics/formulation/formulation.hpp"
#include "setup/blocks.hpp"
#include "setup/contact.hpp"
#include "topology/bounding_box.hpp"
#include "topology/domain.hpp"
#include "topology/neighbors/stencils.hpp"

namespace strut {

namespace {

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

}  // namespace

PartitionWeights partition_weights(const deck::Deck& deck, const PointCloud& cloud, const std::vector<double>& spacings,
                                   const Communicator& communicator) {
  const std::vector<BlockBonds> bonds = block_bonds(deck, cloud);
  const BondCosts costs = bond_costs(cloud, bonds, spacings, communicator);
  return {step_costs(deck, cloud, costs.of_block),
          lengths_for_cuts(interactions_of(deck, cloud), bonds, costs.by_stencils, cloud, communicator)};
}

}  // namespace strut

#include "setup/periods.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <variant>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "conditions/prototype.hpp"
#include "setup/blocks.hpp"
#include "topology/bounding_box.hpp"

namespace strut {

namespace {

std::string path_of(const deck::Deck& deck, int number) {
  return "Boundary Conditions > " + deck.conditions[number].name;
}

// Calls visit(sides, index in the deck).
template <class Visit>
void for_each(const deck::Deck& deck, const Visit& visit) {
  for (int c = 0; c < static_cast<int>(deck.conditions.size()); ++c) {
    if (const auto* sides = std::get_if<PeriodicSides>(&deck.conditions[c].kind)) visit(*sides, c);
  }
}

// Problems of walls across an axis along which all bodies go on forever.
void check_walls(const deck::Deck& deck, const PeriodicSides& sides, const std::string& path,
                 deck::Problems& problems) {
  constexpr double round_off = 1e-9;
  for (const deck::Condition& condition : deck.conditions) {
    const auto* tool = std::get_if<RigidTool>(&condition.kind);
    const auto* wall = tool ? std::get_if<HalfSpace>(&tool->shape) : nullptr;
    if (!wall || std::abs(wall->normal[sides.axis]) < round_off) continue;
    problems.add("Boundary Conditions > " + condition.name + " > Normal",
                 std::string("has a component along ") + "xyz"[sides.axis] + ", along which bodies go on through " +
                     path + ": they would be on both sides of this wall; expected 0 for it");
  }
}

// The reason why the points do not fit between the sides; empty if they do. `edge`: of the smallest cell, `horizon`:
// the largest, m.
std::string objection(const PeriodicSides& sides, const Eigen::AlignedBox3d& box, double edge, double horizon) {
  constexpr double least = 0.01;      // of a cell between a point and the image of another one
  constexpr double most_periods = 5;  // in a horizon
  const double length = sides.upper - sides.lower, first = box.min()[sides.axis], last = box.max()[sides.axis];
  std::ostringstream text;
  if (first < sides.lower - least * edge || last > sides.upper + least * edge) {
    text << "points lie from " << first << " to " << last << " m, not all between the sides at " << sides.lower
         << " and " << sides.upper << " m; expected sides at the ends of the mesh";
  } else if (length - (last - first) < least * edge) {
    text << "points lie on both sides, where they coincide with images of each other; expected points on one";
  } else if (horizon > most_periods * length) {
    text << "the horizon of " << horizon << " m holds more than 5 periods of " << length << " m";
  }
  return text.str();
}

}  // namespace

std::vector<Mirror> sides_of_periods(const deck::Deck& deck) {
  std::vector<Mirror> planes;
  for_each(deck, [&](const PeriodicSides& sides, int number) {
    const Vector along = Vector::Unit(sides.axis);
    const double period = sides.upper - sides.lower;
    planes.push_back(
        {.on = sides.lower * along, .normal = along, .number = number, .bit = sides.axis, .period = period});
    planes.push_back(
        {.on = sides.upper * along, .normal = -along, .number = number, .bit = sides.axis, .period = period});
  });
  return planes;
}

std::vector<Period> periods(const deck::Deck& deck, const PointCloud& cloud, const std::vector<Mirror>& mirrors,
                            const Communicator& communicator) {
  std::vector<Period> all;
  deck::Problems problems;
  double most[] = {-HUGE_VAL, 0};  // the smallest spacing, negative; the largest horizon
  const std::vector<BlockBonds> bonds = block_bonds(deck, cloud);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    most[0] = std::max(most[0], -cloud.spacings[i]);
    most[1] = std::max(most[1], bonds[cloud.blocks[i]].horizon_at(cloud.spacings[i]));
  }
  communicator.max(most);
  const Eigen::AlignedBox3d box = common_box(box_around(cloud.positions), communicator);
  for_each(deck, [&](const PeriodicSides& sides, int number) {
    const std::string path = path_of(deck, number);
    const double t = deck.solver.initial_time, first = sides.stretch.evaluate(0, 0, 0, t);
    if (cloud.at == PointsAt::nodes) {
      problems.add(path +
                   ": nodes on a side would coincide with images of those on the other; expected Discretization > "
                   "Points \"Elements\"");
    }
    if (deck.discretization.grid.boxes) {
      problems.add(path +
                   ": families that are boxes of cells end with the grid; expected Discretization > "
                   "NeighborhoodType \"Spherical\"");
    }
    check_walls(deck, sides, path, problems);
    if (!mirrors.empty()) problems.add(path + ": bodies that go on behind symmetry planes have no periodic sides, too");
    if (!deck.start_from && std::abs(first - 1) > 1e-12) {  // else compared with the checkpoint
      problems.add(path + " > Stretch: '" + sides.stretch.text() +
                   "' is not 1 at the initial time; bodies start as the mesh "
                   "has them");
    }
    for (const Period& other : all) {
      if (other.axis == sides.axis) problems.add(path + ": " + path_of(deck, other.number) + " has the same axis");
    }
    if (!deck.interactions.empty() && !sides.stretch.is_constant()) {
      problems.add(path + " > Stretch: contact does not know sides that move; expected 1, or no Contact");
    }
    if (!deck.interactions.empty() && sides.upper - sides.lower < 3 * (1 - 1e-9) * most[1]) {
      std::ostringstream expected;
      expected.precision(10);  // within the round-off above
      expected << 3 * most[1];
      problems.add(path + ": contact needs a period of 3 horizons or more; expected " + expected.str() + " m");
    }
    const std::string text = objection(sides, box, -most[0], most[1]);
    if (!text.empty()) problems.add(path + ": " + text);
    all.push_back({sides.axis, sides.upper - sides.lower, number, sides.stretch});
  });
  raise_together(communicator, problems.text(deck.file.string()));
  return all;
}

namespace {

// Elements at sides of a period: their number, and how many have no neighbor behind the side.
struct AtSides {
  double count = 0, alone = 0;
};

// Points without nodes: how many bonds cross the sides; how many points have one neighbor straight behind the upper
// side and one straight before them; for how many of these the two distances differ more than the volumes do.
struct Columns {
  double crossing = 0, count = 0, off = 0;
  double gap = 0, layer = 0;  // m, both distances where they differ most
};

Columns columns_at(const Domain& domain, const std::vector<Vector>& shifts, int axis) {
  constexpr double straight = 1e-2, most = 0.05;
  Columns found;
  for (int i = 0; i < domain.owned; ++i) {
    double gap = HUGE_VAL, layer = HUGE_VAL, behind = 0, before = 0;  // m and m³
    domain.families.for_each(i, [&](int j) {
      const Vector xi = domain.reference(j) - domain.reference(i);
      found.crossing += shifts[j][axis] != 0 ? 1 : 0;
      if (xi.norm() - std::abs(xi[axis]) > straight * straight * xi.norm()) return;
      if (shifts[j][axis] > 0 && xi[axis] < gap) gap = xi[axis], behind = domain.volume(j);
      if (shifts[j][axis] == 0 && xi[axis] < 0 && -xi[axis] < layer) layer = -xi[axis], before = domain.volume(j);
    });
    if (!std::isfinite(gap + layer)) continue;
    const double expected = layer * (domain.volume(i) + behind) / (domain.volume(i) + before);
    ++found.count, found.off += std::abs(gap - expected) > most * expected ? 1 : 0;
    if (std::abs(gap - layer) > std::abs(found.gap - found.layer)) found.gap = gap, found.layer = layer;
  }
  return found;
}

// Collective. Sides that do not continue a mesh without nodes.
std::string gaps(const std::string& path, const Domain& domain, const std::vector<Vector>& shifts, int axis) {
  Columns found = columns_at(domain, shifts, axis);
  const Communicator& ranks = domain.communicator;
  const double apart = std::abs(found.gap - found.layer);
  const bool is_here = ranks.first_rank(apart == ranks.max(apart)) == ranks.rank();
  double most[] = {is_here ? found.gap : 0, is_here ? found.layer : 0},
         sums[] = {found.crossing, found.count, found.off};
  ranks.max(most), ranks.sum(sums);
  if (sums[0] == 0) return "WARNING: " + path + ": no bond crosses its sides; expected sides at the ends of the mesh\n";
  if (!(sums[2] > 0.5 * sums[1])) return "";
  return text_of("WARNING: ", path, ": ", sums[2],
                 " points are not as far from the neighbor behind the side as from the one inside (", most[0], " and ",
                 most[1], " m where these differ most); expected Upper − Lower as large as the mesh with its cells\n");
}

// Collective. `is_cut`: from an image, by a crack along a side: the mesh goes on there.
AtSides at_side(const deck::Deck& deck, const Domain& domain, const Period& period, bool is_upper,
                const std::vector<Vector>& shifts, const std::vector<bool>& is_cut) {
  const int bit = first_plane_bit + period.axis + (is_upper ? 0 : lower_side);
  const double outward = is_upper ? 1 : -1;
  const auto is_on_side = [bit](std::int64_t node) { return (node >> bit & 1) != 0; };
  double counts[] = {0, 0};
  for (int i = 0; i < domain.owned && !domain.cloud.shared_nodes.empty(); ++i) {
    if (std::ranges::none_of(domain.cloud.shared_nodes[i], is_on_side)) continue;
    bool meets = false;
    domain.families.for_each(i, [&](int j) { meets = meets || outward * shifts[j][period.axis] > 0; });
    ++counts[0], counts[1] += meets || is_cut[i] ? 0 : 1;
  }
  domain.communicator.sum(counts);
  if (counts[0] == 0) {
    throw Error(path_of(deck, period.number) + ": no element has a node on the " + (is_upper ? "upper" : "lower") +
                " side, which cuts elements or lies beyond the mesh; expected sides at the faces of the mesh");
  }
  return {counts[0], counts[1]};
}

// Collective. Sides that do not continue a mesh with nodes.
std::string ends_at_sides(const deck::Deck& deck, const Domain& domain, const Period& period,
                          const std::vector<Vector>& shifts, const std::vector<bool>& is_cut) {
  const AtSides upper = at_side(deck, domain, period, true, shifts, is_cut);
  const AtSides lower = at_side(deck, domain, period, false, shifts, is_cut);
  const double count = upper.count + lower.count, alone = upper.alone + lower.alone;
  if (alone == 0) return "";
  return text_of("WARNING: ", path_of(deck, period.number), ": ", alone, " of ", count,
                 " elements at a side have no neighbor behind it, and end there; expected a mesh whose faces at both "
                 "sides are alike\n");
}

}  // namespace

std::string open_sides(const deck::Deck& deck, const Domain& domain) {
  if (domain.periods.empty()) return "";
  const std::vector<Vector> shifts = shifts_by_periods(domain);
  std::vector<bool> is_cut(domain.owned, false);
  for (const auto& [i, other] : domain.separated) {
    if (Images::image(other) > 0) is_cut[i] = true;
  }
  const auto has_nodes = [](const std::vector<std::int64_t>& nodes) { return !nodes.empty(); };
  const bool with_nodes = domain.communicator.any(domain.cloud.at == PointsAt::elements &&
                                                  std::ranges::any_of(domain.cloud.shared_nodes, has_nodes));
  std::string warnings;
  for (const Period& period : domain.periods) {
    warnings += with_nodes ? ends_at_sides(deck, domain, period, shifts, is_cut)
                           : gaps(path_of(deck, period.number), domain, shifts, period.axis);
  }
  return warnings;
}

std::vector<Vector> shifts_by_periods(const Domain& domain) {
  std::vector<Vector> shifts(domain.sites.size(), Vector::Zero());
  for (const ImagePoint& image : domain.halo.images()) shifts[image.ghost] = image.by.period;
  return shifts;
}

void join_images(const std::vector<Period>& periods, Shape& shape) {
  constexpr double far = 1e6;  // periods
  constexpr double round_off = 1e-9;
  Box* box = std::get_if<Box>(&shape);
  for (const Period& period : periods) {
    if (!box || box->upper[period.axis] - box->lower[period.axis] < period.length * (1 - round_off)) continue;
    box->lower[period.axis] -= far * period.length;
    box->upper[period.axis] += far * period.length;
  }
}

}  // namespace strut

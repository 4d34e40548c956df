#include <cmath>
#include <cstdint>
#include <iomanip>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "advice/checks.hpp"
#include "base/errors.hpp"
#include "base/text.hpp"

namespace strut {

namespace {

constexpr int sides = 6;  // lower and upper along each axis

// Collective. Marks for each side which owned points are the nearest to a plane or box that faces them, or whose motion
// along the axis a condition prescribes, the latter also in `moved` for each axis.
void mark_held(const Situation& situation, std::vector<std::uint8_t>& held, std::vector<std::uint8_t>& moved) {
  constexpr double across = 0.999;  // component of the normal along an axis
  situation.scene.conditions.visit([&](const PrescribedMotion& one) {
    for (const int i : one.points) {
      for (const int axis : one.components) moved[i] |= 1 << axis, held[i] |= 3 << (2 * axis);
    }
  });
  situation.scene.conditions.visit([&](const RigidTool& tool) {
    if (std::holds_alternative<Cylinder>(tool.shape)) return;
    const Domain& domain = situation.scene.body.domain;
    const auto at = [&](int i) { return surface(tool.shape, domain.reference(i)); };
    double nearest = std::numeric_limits<double>::infinity();
    for (const int i : tool.points) nearest = std::min(nearest, at(i).gap);
    nearest = domain.communicator.min(nearest);
    for (const int i : tool.points) {
      const Surface here = at(i);
      if (!(here.gap < nearest + 0.5 * domain.cloud.spacings[i])) continue;
      for (int side = 0; side < sides; ++side) {
        if ((side % 2 == 0 ? 1 : -1) * here.normal[side / 2] >= across) held[i] |= 1 << side;
      }
    }
  });
}

// Collective. The same for points that a load of less than half of the points acts on.
void mark_loaded(const Situation& situation, std::vector<std::uint8_t>& held) {
  const Domain& domain = situation.scene.body.domain;
  situation.scene.conditions.visit([&](const BodyForce& one) {
    if (!(domain.communicator.sum(static_cast<double>(2 * one.points.size()) - domain.owned) < 0)) return;
    for (const int i : one.points) {
      for (const int axis : one.components) held[i] |= 3 << (2 * axis);
    }
  });
}

// The blocks of each body, as a sentence begins with them.
std::map<int, std::string> names_of_bodies(const Domain& domain) {
  std::map<int, std::vector<std::string>> blocks;
  for (std::size_t b = 0; b < domain.blocks.size(); ++b)
    blocks[domain.blocks[b].body].push_back("'" + domain.cloud.block_names[b] + "'");
  std::map<int, std::string> names;
  for (const auto& [body, some] : blocks) names[body] = (some.size() == 1 ? "block " : "blocks ") + joined(some);
  return names;
}

double outwards(const Domain& domain, int i, int side) {
  return (side % 2 == 0 ? -1 : 1) * domain.reference(i)[side / 2];
}

// Collective. For each body how far its points reach beyond the origin toward each side, and then their largest
// spacing, m.
constexpr int extents = sides + 1;
std::vector<double> extents_of_bodies(const Domain& domain) {
  std::vector<double> all(extents * domain.body_count(), std::numeric_limits<double>::lowest());
  for (int i = 0; i < domain.owned; ++i) {
    double* const most = &all[extents * domain.body_of(i)];
    for (int side = 0; side < sides; ++side) most[side] = std::max(most[side], outwards(domain, i, side));
    most[sides] = std::max(most[sides], domain.cloud.spacings[i]);
  }
  domain.communicator.max(all);
  return all;
}

// Collective. For each body how many points of the outer layer at each side nothing holds there, then how many points
// no condition moves along each axis, and then how many of each outer layer no condition moves along each axis.
constexpr int counts = sides + 3 + 3 * sides;
std::vector<double> free_points(const Domain& domain, const std::vector<double>& reaches,
                                const std::vector<std::uint8_t>& held, const std::vector<std::uint8_t>& moved) {
  constexpr double of_layer = 0.25;  // spacings that the points of a layer differ by
  std::vector<double> all(counts * domain.body_count(), 0);
  for (int i = 0; i < domain.owned; ++i) {
    const double* const most = &reaches[extents * domain.body_of(i)];
    double* const free = &all[counts * domain.body_of(i)];
    for (int side = 0; side < sides; ++side) {
      const bool is_outer = outwards(domain, i, side) > most[side] - of_layer * most[sides];
      if (is_outer && ((held[i] >> side) & 1) == 0) ++free[side];
      for (int axis = 0; axis < 3; ++axis)
        free[sides + 3 + 3 * side + axis] += is_outer && ((moved[i] >> axis) & 1) == 0 ? 1 : 0;
    }
    for (int axis = 0; axis < 3; ++axis) free[sides + axis] += ((moved[i] >> axis) & 1) == 0 ? 1 : 0;
  }
  domain.communicator.sum(all);
  return all;
}

// Spacings that each held end of a body gives way more than it should with points at nodes by the mean gradient: the
// outer layers have half cells and families on one side, and a uniform stress is no equilibrium there. 0 for others.
// Measured of elastic cubes between planes, 4 and 8 cells an edge, ν 0 and 0.3, in (1/stiffness − 1) of the layers:
// 0.3 and 0.2 (horizon 1.75 spacings), 2.1 and 1.9 (2.6), 4.4 (3.01); linear decay 0.2 (2.1), 1.3 (2.6), 2.0 (3.01).
// Under a load on the nodes of a face instead of a plane 0.7 and 0.4 (horizon 1.75): twice as much.
double soft_end_of(const Body& body, std::size_t b) {
  const MaterialBlock& block = body.blocks[b];
  if (block.is_ordinary() || block.is_quadratic()) return 0;
  const double horizon = body.domain.blocks[b].largest / body.domain.blocks[b].spacing;
  const double of_one = horizon < 2.4 ? 0.25 : horizon < 2.99 ? 2 : 4.4;
  const double found = body.influence == Influence::one || horizon < 2.4 ? of_one : of_one * 0.5;
  return found / (1 + 2.5 * coefficient_of(block.material.stabilization));
}

// Pads of 8 layers, four times as wide, whose faces were held were found so much too stiff: by quadratic correspondence
// 39, 77 and 87 % at K/G = 10, 100 and 1000, by the mean gradient 37, 72 and 101 %; at nodes -4 to 4 %. Struts of a
// lattice, whose members are far thinner than it is high, give way between them, and their volume need not change.
std::string bonded_pads(const Situation& situation, int of_body, double layers) {
  constexpr double of_height = 1. / 3;  // 4 volume/surface of a block 0.4 times as wide as high
  const Body& body = situation.scene.body;
  double ratio = 0;
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    const double thickness = situation.members[b];  // 0: beyond 100 spacings
    const bool is_solid = thickness == 0 || thickness > of_height * layers;
    if (body.domain.blocks[b].body == of_body && is_solid)
      ratio = std::max(ratio, materials::bulk_over_shear(body.blocks[b].material.law));
  }
  if (ratio < materials::hardly_compressible) return "";
  return text_of(std::setprecision(4), "; at K = ", std::round(ratio),
                 " G far more where both ends cannot slide (pads of 8 layers 40 to 100 %; expected Points \"Nodes\")");
}

double soft_ends_of(const Body& body, int of_body) {
  double softest = 0;
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    if (body.domain.blocks[b].body == of_body && body.domain.blocks[b].spacing > 0)
      softest = std::max(softest, soft_end_of(body, b));
  }
  return softest;
}

// The bending stiffness that a body, `layers` long along an axis, has too much where its ends are held, or moved in any
// direction: half a spacing at each does not bend. 0 if it is less than three times as long as it is thick, or wider
// than long. Motions of all points, as of plane strain, move no end. `counted`: of the body, free_points().
double stiffer_in_bending(const double* counted, const double* most, int axis, double layers) {
  double thinnest = layers, longest = layers;
  for (int c = 0; c < 3; ++c) {
    const double here = 1 + (most[2 * c] + most[2 * c + 1]) / most[sides];
    thinnest = std::min(thinnest, here), longest = std::max(longest, here);
  }
  if (layers < 3 * thinnest || layers < 0.9 * longest) return 0;
  int ends = 0;
  for (const int side : {2 * axis, 2 * axis + 1}) {
    bool is_end = counted[side] == 0;
    for (int c = 0; c < 3; ++c) is_end |= counted[sides + c] > 0 && counted[sides + 3 + 3 * side + c] == 0;
    ends += is_end ? 1 : 0;
  }
  return std::pow(layers / (layers - 0.5 * ends), 3) - 1;
}

}  // namespace

// Measured between two planes or boxes, 4, 8, 10 and 20 layers: +67, +26, +20 and +9 %; at nodes by quadratic
// correspondence -1 to -0.1 %.
std::string unstrained_ends(const Situation& situation) {
  constexpr double worth_saying = 0.05, worth_saying_bent = 0.1;
  const Domain& domain = situation.scene.body.domain;
  const bool at_nodes = domain.cloud.at == PointsAt::nodes;
  std::vector<std::uint8_t> held(domain.owned, 0), moved(domain.owned, 0);
  mark_held(situation, held, moved);
  std::vector<std::uint8_t> loaded = held;
  if (at_nodes) mark_loaded(situation, loaded);
  if (!domain.communicator.any(std::ranges::any_of(loaded, [](std::uint8_t one) { return one != 0; }))) return "";
  const std::vector<double> all_most = extents_of_bodies(domain), all_free = free_points(domain, all_most, held, moved);
  const std::vector<double> all_unloaded = free_points(domain, all_most, loaded, moved);
  std::string text;
  for (const auto& [body, names] : names_of_bodies(domain)) {
    const double *most = &all_most[extents * body], *free = &all_free[counts * body],
                 *unloaded = &all_unloaded[counts * body];
    const auto ends_in = [](const double* counted, int axis) {
      return (counted[2 * axis] == 0 ? 1 : 0) + (counted[2 * axis + 1] == 0 ? 1 : 0);
    };
    for (int axis = 0; axis < 3; ++axis) {
      const int without_load = ends_in(free, axis), ends = ends_in(unloaded, axis);
      const double layers = (at_nodes ? 0 : 1) + (most[2 * axis] + most[2 * axis + 1]) / most[sides];
      const double soft = at_nodes ? (2 * ends - without_load) * soft_ends_of(situation.scene.body, body) : 0;
      const double error = at_nodes ? soft / (layers + soft) : ends / layers;
      const double bent = at_nodes ? 0 : stiffer_in_bending(free, most, axis, layers);
      if (free[sides + axis] == 0 || (error < worth_saying && bent < worth_saying_bent) || ends == 0) continue;
      const char along = "xyz"[axis];
      text += text_of(std::setprecision(2), names, ": about ", std::round(layers), " layers along ", along,
                      ", held or pressed at ", ends == 1 ? "one end" : "both ends", ": ");
      if (at_nodes)
        text += text_of(std::setprecision(2), "the outer nodes have half cells and families on one side: expect about ",
                        100 * error, " % too little stiffness along ", along,
                        ", of foams also too little force until all layers flow; a longer horizon is worse, "
                        "Formulation 'Quadratic Correspondence' has 1 %, of foams 3 %\n");
      else
        text += text_of(
            std::setprecision(2), "points are in the middles of cells, and half a spacing at ",
            ends == 1 ? "this" : "each", " end does not strain: expect ", 100 * error, " % too much stiffness along ",
            along, bent >= worth_saying_bent ? text_of(std::setprecision(2), ", ", 100 * bent, " % in bending") : "",
            ", and ", 50 * ends / (layers - 0.5 * ends),
            " % too much force and strain in flow (by Formulation 'Quadratic Correspondence' none with "
            "Points \"Nodes\"; none by a Symmetry Plane)",
            ends == 2 && bent == 0 ? bonded_pads(situation, body, layers) : "", "\n");
    }
  }
  return text;
}

}  // namespace strut

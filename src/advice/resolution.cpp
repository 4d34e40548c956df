#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "advice/checks.hpp"
#include "advice/lattice_axes.hpp"
#include "base/errors.hpp"
#include "base/text.hpp"
#include "mechanics/expected_error.hpp"
#include "mechanics/steepness.hpp"
#include "mechanics/thin_members.hpp"

namespace strut {

namespace {

// The warning for ordinary points.
std::string stiffness_of_thin(Influence influence, double horizon, double thickness) {
  constexpr double worth_saying = 0.1;
  const double found = tension_stiffness_found(influence, horizon, thickness);
  if (std::abs(found - 1) < worth_saying) return "";
  return text_of(
      std::setprecision(2), "bars so thick were found ", 100 * std::abs(found - 1), " % too ",
      found > 1 ? "stiff" : "soft",
      " in tension by the material model 'Elastic' (along the axes of a lattice); of cubes 'Elastic Correspondence' "
      "keeps Young's modulus");
}

// The warning for correspondence. Bow by heat was measured on free plates and on bimetals.
std::string bending_of_thin(Influence influence, double horizon, double thickness, bool heated) {
  constexpr double worth_saying = 0.9;
  const auto kept = [&](double n) { return 100 * bending_stiffness_kept(influence, horizon, n); };
  if (kept(thickness) >= 100 * worth_saying) return "";
  return text_of(std::setprecision(2), "so thin they keep about ", kept(thickness),
                 " % of their bending stiffness (plates ", kept(0.5 * thickness), " %)",
                 heated ? ", and bow by heat too much (plates of 4 layers by 40 %, of 8 by 8 %)" : "",
                 "; by Formulation 'Quadratic Correspondence' expect ", expected_error_text(thickness, ""));
}

double bulk_over_shear(const materials::AnyLaw& law) {
  const materials::Moduli moduli = materials::moduli_of(law);
  return moduli.bulk / moduli.shear;
}
constexpr double hardly_compressible = 10;  // K/G

// The bending stiffness that quadratic cells, each of which must keep its volume, have too much. Measured on elastic
// bars against finite elements, less that at K/G = 3: with 4 cells 0.04, 0.13, 0.30 and 0.6 at K/G = 10, 100, 1000 and
// 5000; at 1000 with 2, 3 and 8 cells 1.2, 0.6 and 0.08.
double locking(const materials::AnyLaw& law, double thickness) {
  const double ratio = bulk_over_shear(law);
  return ratio < hardly_compressible || !(thickness > 0) ? 0 : 0.15 * std::sqrt(ratio) / (thickness * thickness);
}

// The warning for quadratic correspondence.
std::string resolution_of_thin(const materials::AnyLaw& law, double thickness, bool whole) {
  constexpr double worth_saying = 0.05;
  const double locks = locking(law, thickness);
  if (!(thickness > 0) || std::max(expected_error(thickness).stiffness, locks) < worth_saying) return "";
  const bool flows =
      std::visit([]<class L>(const L&) { return materials::tells_flow<L> && !materials::opens_cracks<L>; }, law);
  return "of struts expect " + expected_error_text(thickness, flows ? "in the plateau" : "", whole) +
         text_of(std::setprecision(2), ", of plates ±", 100 * expected_error(0.5 * thickness).stiffness, " %") +
         (locks < worth_saying
              ? ""
              : text_of(std::setprecision(4), ", and in bending about ", std::round(100 * locks),
                        " % more, as the law hardly changes its volume (K = ", std::round(bulk_over_shear(law)),
                        " G)")) +
         "; tools/study --converge spacing measures it (docs/resolution.md)";
}

std::string thin_members_text(const MaterialBlock& block, Influence influence, double horizon, double thickness,
                              bool whole, bool cubic, bool heated) {
  switch (block.material.formulation) {
    case Formulation::ordinary:  // measured on cubes; uneven_dilatation() tells of others
      return cubic ? stiffness_of_thin(influence, horizon, thickness) : "";
    case Formulation::correspondence:
      return bending_of_thin(influence, horizon, thickness, heated);
    case Formulation::quadratic:
      return resolution_of_thin(block.material.law, thickness, whole);
  }
  return "";
}

// Collective. True for each block whose points are elements of equal volume, as voxels are.
std::vector<bool> of_whole_cells(const Domain& domain) {
  constexpr double alike = 1e-6;  // relative difference of volumes in files of single precision
  const std::size_t blocks = domain.blocks.size();
  std::vector<double> volumes(2 * blocks, -std::numeric_limits<double>::max());  // the largest; minus the smallest
  for (int i = 0; i < domain.owned; ++i) {
    double *largest = &volumes[domain.cloud.blocks[i]], *least = largest + blocks;
    *largest = std::max(*largest, domain.volume(i)), *least = std::max(*least, -domain.volume(i));
  }
  domain.communicator.max(volumes);
  std::vector<bool> whole;
  for (std::size_t b = 0; b < blocks; ++b)
    whole.push_back(domain.cloud.at == PointsAt::elements && -volumes[blocks + b] > (1 - alike) * volumes[b]);
  return whole;
}

}  // namespace

std::string thin_members(const Situation& situation) {
  const Body& body = situation.scene.body;
  const std::vector<bool> whole = of_whole_cells(body.domain);
  return lines_of_blocks(situation, [&](const MaterialBlock& block, std::size_t b) -> std::string {
    const double spacing = body.domain.blocks[b].spacing, thickness = situation.members[b];
    const double horizon = spacing > 0 ? body.domain.blocks[b].largest / spacing : 0;
    const std::string found =
        thin_members_text(block, body.influence, horizon, thickness, whole[b], situation.unevenness[b] < uneven_from,
                          block.material.thermal_expansion != 0);
    if (found.empty()) return "";
    return text_of(std::setprecision(2), "block '", block.name, "': members are ", thickness,
                   " spacings thick, plates and sheets ", 0.5 * thickness, " (4 and 2 volume/surface); ", found, "\n");
  });
}

// Measured on layers in series, 2 to 8 cells each, at ν = 0: of each layer 0.19, 0.42 and 0.54 cells of the softer one
// did not strain beside layers 3, 10 and 100 times as stiff.
std::string unlike_layers(const Situation& situation) {
  constexpr double worth_saying = 2;
  const Body& body = situation.scene.body;
  const Domain& domain = body.domain;
  std::vector<int> blocks(domain.cloud.blocks.begin(), domain.cloud.blocks.end());
  blocks.resize(domain.owned + domain.ghosts, -1);
  domain.halo.exchange(blocks);
  const auto stiffness_of = [&](int b) { return materials::moduli_of(body.blocks[b].material.law).longitudinal(); };
  std::vector<double> stiffest(body.blocks.size(), 0);  // of those that a block is bonded to
  for (int i = 0; i < domain.owned; ++i) {
    const int here = blocks[i];
    domain.families.for_each(i, [&](int j) {
      if (blocks[j] != here && body.blocks[here].is_quadratic() && body.blocks[blocks[j]].is_quadratic())
        stiffest[here] = std::max(stiffest[here], stiffness_of(blocks[j]));
    });
  }
  domain.communicator.max(stiffest);
  return lines_of_blocks(situation, [&](const MaterialBlock& block, std::size_t b) -> std::string {
    const double ratio = stiffest[b] / stiffness_of(static_cast<int>(b));
    if (ratio < worth_saying) return "";
    const double lost = 0.55 * std::pow((ratio - 1) / (ratio + 1), 1.5);
    return text_of(
        std::setprecision(2), "block '", block.name, "': bonded to a block ", std::setprecision(4), std::round(ratio),
        std::setprecision(2),
        " times as stiff; quadratic cells at such a face hardly strain: a layer between two, 4 cells thick, is ",
        100 * lost / (4 - lost), " % too stiff across it, one of 2 cells ", 100 * lost / (2 - lost), " %\n");
  });
}

namespace {

constexpr int sides = 6;  // lower and upper along each axis

// Collective. Marks for each side which owned points are the nearest to a plane tool that faces them, or whose motion
// along the axis a condition prescribes, the latter also in `moved` for each axis.
void mark_held(const Situation& situation, std::vector<std::uint8_t>& held, std::vector<std::uint8_t>& moved) {
  constexpr double across = 0.999;  // component of a plane's normal along an axis
  situation.scene.conditions.visit([&](const PrescribedMotion& one) {
    for (const int i : one.points) {
      for (const int axis : one.components) moved[i] |= 1 << axis, held[i] |= 3 << (2 * axis);
    }
  });
  situation.scene.conditions.visit([&](const RigidTool& tool) {
    const auto* plane = std::get_if<HalfSpace>(&tool.shape);
    if (!plane) return;
    const Domain& domain = situation.scene.body.domain;
    const auto depth = [&](int i) { return -plane->normal.dot(domain.reference(i)); };
    double deepest = std::numeric_limits<double>::lowest();
    for (const int i : tool.points) deepest = std::max(deepest, depth(i));
    deepest = domain.communicator.max(deepest);
    for (int side = 0; side < sides; ++side) {
      if ((side % 2 == 0 ? 1 : -1) * plane->normal[side / 2] < across) continue;
      for (const int i : tool.points) {
        if (depth(i) > deepest - 0.5 * domain.cloud.spacings[i]) held[i] |= 1 << side;
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
// 42, 95 and 170 % at K/G = 10, 100 and 1000, by the mean gradient 37, 72 and 101 %; at nodes -4 to 4 %.
std::string bonded_pads(const Body& body, int of_body) {
  double ratio = 0;
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    if (body.domain.blocks[b].body == of_body) ratio = std::max(ratio, bulk_over_shear(body.blocks[b].material.law));
  }
  if (ratio < hardly_compressible) return "";
  return text_of(std::setprecision(4), "; at K = ", std::round(ratio),
                 " G far more where both ends cannot slide (pads of 8 layers 40 to 170 %; expected Points \"Nodes\")");
}

double soft_ends_of(const Body& body, int of_body) {
  double softest = 0;
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    if (body.domain.blocks[b].body == of_body && body.domain.blocks[b].spacing > 0)
      softest = std::max(softest, soft_end_of(body, b));
  }
  return softest;
}

}  // namespace

namespace {

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

// Measured between two planes, 4, 8, 10 and 20 layers: +67, +26, +20 and +9 %; at nodes by quadratic correspondence -1
// to -0.1 %.
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
            ends == 2 && bent == 0 ? bonded_pads(situation.scene.body, body) : "", "\n");
    }
  }
  return text;
}

// Concerns points by correspondence only: ordinary points have no F, and the fits of quadratic cells have a penalty.
std::string flat_families(const Situation& situation) {
  constexpr double very_flat = 20;  // `flatness`: a tenth of a spacing thick; two layers have 1.3
  const Body& body = situation.scene.body;
  const auto is_flat = [&](const MaterialBlock& block, int i) {
    if (block.is_ordinary() || block.is_quadratic()) return false;
    const LatticeFamilies* stencil = body.domain.families.lattice(i);
    if ((stencil && stencil->spans_space(i)) || body.has_lost_bonds(i))
      return false;  // broken ones are not of the mesh
    return flatness(body.domain, i) > very_flat;
  };
  return lines_of_points(situation, is_flat, [](const MaterialBlock& block, const FoundPoints& found, double) {
    return text_of("WARNING: block '", block.name, "': the neighbors of ", found.count, " points, one of them at ",
                   place_text(found.one),
                   ", nearly lie in one plane: the strain across it is noise of the mesh, and the steps of the run, or "
                   "the substeps of these points, are several times shorter (substeps may feed vibrations: Solver > "
                   "Verlet > Subcycling false); expected two layers of points or more, also on each side of a crack "
                   "(Discretization > Bond Filters)\n");
  });
}

namespace {

// The variables of the deck that need F.
std::set<std::string> asked_of_gradients(const deck::Deck& deck) {
  constexpr const char* words[] = {"Stress",          "Pressure", "Deformation_Gradient", "Jacobian", "Stretch_Tensor",
                                   "Rotation_Tensor", "Residual"};
  std::set<std::string> asked;
  for (const auto* names : {&deck.output.variables, &deck.history.variables}) {
    for (const std::string& name : *names) {
      const auto is_in = [&name](const char* word) { return name.find(word) != std::string::npos; };
      if (std::ranges::any_of(words, is_in)) asked.insert(name);
    }
  }
  return asked;
}

}  // namespace

// Such points bear load by their bonds, and their dilatation is right.
std::string unknown_gradients(const Situation& situation) {
  const Body& body = situation.scene.body;
  const std::set<std::string> asked = asked_of_gradients(situation.deck);
  if (asked.empty()) return "";
  const auto is_flat = [&](const MaterialBlock& block, int i) {
    return block.is_ordinary() && body.domain.families.size(i) > 0 && !(trace(body.shape_inverse[i]) > 0);
  };
  return lines_of_points(situation, is_flat, [&](const MaterialBlock& block, const FoundPoints& found, double) {
    return text_of("WARNING: block '", block.name, "': the neighbors of ", found.count, " points, one of them at ",
                   place_text(found.one),
                   ", lie in one plane, which leaves F unknown: there it is shown as the identity and stress as 0, "
                   "though the points bear load (",
                   joined({asked.begin(), asked.end()}),
                   "); expected two layers of points or more, or variables such as Dilatation and reactions\n");
  });
}

namespace {

// The families of centers of tetrahedra have no symmetry. Cells by quadratic correspondence need none: their fits
// balance a uniform stress.
bool is_center_of_tetrahedron(const MaterialBlock& block, const PointCloud& cloud, int i) {
  constexpr std::size_t corners = 4;
  return !block.is_ordinary() && !block.is_quadratic() && cloud.at == PointsAt::elements &&
         !cloud.shared_nodes.empty() && cloud.shared_nodes[i].size() == corners;
}

std::string centers_of_tetrahedra(const Situation& situation) {
  if (situation.deck.discretization.type == deck::MeshType::grid) return "";  // shared nodes may be those of boxes
  const auto is_one = [&](const MaterialBlock& block, int i) {
    return is_center_of_tetrahedron(block, situation.scene.body.domain.cloud, i);
  };
  return lines_of_points(situation, is_one, [](const MaterialBlock& block, const FoundPoints& found, double) {
    return text_of("WARNING: block '", block.name, "': ", found.count,
                   " points are at centers of tetrahedra, where a uniform stress is no equilibrium of the mean "
                   "gradient (bars of tetrahedra were found up to 25 % too soft in tension); expected Formulation "
                   "'Quadratic Correspondence', Points \"Nodes\", or hexahedra\n");
  });
}

// The largest ratio of the horizons of an owned point and of others that it is bonded to, if these are of another size;
// else 0.
double ratio_of_horizons(const Domain& domain, int i) {
  constexpr double of_blocks = 1.1, in_a_block = 1.6;  // a fitted cone has 1.5 between neighbors
  const BlockHorizons& own = domain.blocks[domain.cloud.blocks[i]];
  const double here = domain.horizon(i);
  double ratio = 0;
  domain.families.for_each(i, [&](int j) {
    const double there = domain.horizon(j), other = std::max(there / here, here / there);
    const bool is_of_another = there > of_blocks * own.largest || of_blocks * there < own.smallest;
    if (is_of_another || other > in_a_block) ratio = std::max(ratio, other);
  });
  return ratio;
}

}  // namespace

// Not of cells by quadratic correspondence, whose fits balance a uniform stress whatever the families around.
std::string unequal_horizons(const Situation& situation) {
  const auto ratio = [&](const MaterialBlock& block, int i) {
    return block.is_quadratic() ? 0 : ratio_of_horizons(situation.scene.body.domain, i);
  };
  const auto line = [](const MaterialBlock& block, const FoundPoints& found, double most) {
    return text_of(std::setprecision(3), "WARNING: block '", block.name, "': ", found.count, " points, one of them at ",
                   place_text(found.one), ", are bonded to points with other horizons, by a factor of up to ", most,
                   ": a uniform stress is no equilibrium there (strains were found to be up to 20 % off at 1.15, "
                   "60 % at 1.7 and 90 % at 2); expected one horizon and spacing (Blocks > Horizon), or bodies "
                   "that meet in contact (Separate Body)\n");
  };
  return centers_of_tetrahedra(situation) + lines_of_points(situation, ratio, line);
}

namespace {

// By how much the neighbors of a point are off a lattice: the largest distance of one's mirror image at the point from
// the neighbor next to it, over the least distance of a neighbor. On a lattice it is 0; where a surface takes the
// image's place, the next one is a spacing away.
double off_lattice(const Domain& domain, int i) {
  constexpr double missing = 0.9;
  std::vector<Vector> neighbors;
  double nearest = std::numeric_limits<double>::infinity(), most = 0;
  domain.families.for_each(i, [&](int j) {
    neighbors.push_back(domain.reference(j) - domain.reference(i));
    nearest = std::min(nearest, neighbors.back().norm());
  });
  for (const Vector& one : neighbors) {
    double off = std::numeric_limits<double>::infinity();
    for (const Vector& other : neighbors) off = std::min(off, (one + other).squaredNorm());
    off = std::sqrt(off) / nearest;
    if (off < missing) most = std::max(most, off);
  }
  return most;
}

}  // namespace

// Points that centers_of_tetrahedra() or unequal_horizons() tell of have their own reason.
std::string points_off_lattices(const Situation& situation) {
  constexpr double worth_saying = 0.05;  // stress a few percent off
  constexpr std::size_t enough = 2000;
  const Domain& domain = situation.scene.body.domain;
  const auto measure = [&](const MaterialBlock& block, int i) -> double {
    if (block.is_quadratic() || is_center_of_tetrahedron(block, domain.cloud, i) || domain.families.lattice(i))
      return 0;
    const double off = off_lattice(domain, i);
    return off > worth_saying && ratio_of_horizons(domain, i) == 0 ? off : 0;
  };
  const auto line = [](const MaterialBlock& block, const FoundPoints& found, double most) {
    return text_of(
        std::setprecision(2), "WARNING: block '", block.name, "': around ", found.count,
        " points or more, one of them at ", place_text(found.one), ", neighbors are off a lattice by up to ", most,
        " spacings, as beside cells of another size: a uniform stress is no equilibrium there (",
        block.is_ordinary()
            ? "stress was found to be up to 10 % off, strains up to 50 %"
            : "in elastic equilibria stress was found to be 10 % off at 0.1, 20 to 80 % from 0.2 on, and displacements "
              "alternate between neighbors; in Taylor bars plastic strain was 5 % off",
        "); expected cells of one size in a lattice, or Formulation 'Quadratic Correspondence'\n");
  };
  return lines_of_points(situation, measure, line, enough);
}

std::string narrow_surfaces_of_nodes(const Situation& situation) {
  constexpr double narrow = 8;  // spacings
  const Body& body = situation.scene.body;
  if (body.domain.cloud.at != PointsAt::nodes) return "";
  std::vector<std::string> names;
  for (const int b : blocks_that_meet_by<contact::SurfaceLaw>(situation)) {
    if (situation.members[b] > 0 && situation.members[b] <= narrow) names.push_back(body.blocks[b].name);
  }
  if (names.empty()) return "";
  return "WARNING: " + joined(names) +
         ": with points at nodes contact by surfaces is weak near edges: blocks 4 spacings wide were found to bear 0.1 "
         "of the pressure of wide faces, 8 spacings wide 0.4; expected Points \"Elements\"\n";
}

}  // namespace strut

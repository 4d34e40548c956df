#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
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

// The bending stiffness that quadratic cells have too much if each integration point must keep its volume. Measured on
// elastic bars against finite elements, less that at K/G = 3: with 4 cells 0.04, 0.13, 0.30 and 0.6 at K/G = 10, 100,
// 1000 and 5000; at 1000 with 2, 3 and 8 cells 1.2, 0.6 and 0.08.
double locking(const materials::AnyLaw& law, double thickness) {
  const double ratio = materials::bulk_over_shear(law);
  const bool locks = ratio >= materials::hardly_compressible && !materials::shares_volume(law) && thickness > 0;
  return locks ? 0.15 * std::sqrt(ratio) / (thickness * thickness) : 0;
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
         (locks < worth_saying ? ""
                               : text_of(std::setprecision(4), ", and in bending about ", std::round(100 * locks),
                                         " % more, as the law hardly changes its volume (K = ",
                                         std::round(materials::bulk_over_shear(law)), " G)")) +
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
  const std::vector<int> blocks = blocks_of(domain);
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

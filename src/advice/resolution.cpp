#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "advice/checks.hpp"
#include "advice/lattice_axes.hpp"
#include "base/errors.hpp"
#include "base/text.hpp"
#include "mechanics/expected_error.hpp"
#include "mechanics/steepness.hpp"
#include "mechanics/thin_members.hpp"
#include "setup/found_points.hpp"

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

// The warning for correspondence.
std::string bending_of_thin(double horizon, double thickness) {
  constexpr double worth_saying = 0.9;
  const double kept = bending_stiffness_kept(horizon, thickness);
  if (kept >= worth_saying) return "";
  return text_of(std::setprecision(2), "so thin they keep about ", 100 * kept,
                 " % of their bending stiffness; by Formulation 'Quadratic Correspondence' expect ",
                 expected_error_text(thickness, ""));
}

// The warning for quadratic correspondence.
std::string resolution_of_thin(const materials::AnyLaw& law, double thickness, bool whole) {
  constexpr double worth_saying = 0.05;
  if (!(thickness > 0) || expected_error(thickness).stiffness < worth_saying) return "";
  const bool flows =
      std::visit([]<class L>(const L&) { return materials::tells_flow<L> && !materials::opens_cracks<L>; }, law);
  return "of struts expect " + expected_error_text(thickness, flows ? "in the plateau" : "", whole) +
         "; tools/study --converge spacing measures it (docs/resolution.md)";
}

std::string thin_members_text(const MaterialBlock& block, Influence influence, double horizon, double thickness,
                              bool whole, bool cubic) {
  switch (block.material.formulation) {
    case Formulation::ordinary:  // measured on cubes; uneven_dilatation() tells of others
      return cubic ? stiffness_of_thin(influence, horizon, thickness) : "";
    case Formulation::correspondence:
      return bending_of_thin(horizon, thickness);
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
  const std::vector<double>& all = situation.members;
  const std::vector<bool> whole = of_whole_cells(body.domain);
  std::ostringstream text;
  text.precision(2);
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    const double spacing = body.domain.blocks[b].spacing;
    const double horizon = spacing > 0 ? body.domain.blocks[b].largest / spacing : 0;
    const std::string found = thin_members_text(body.blocks[b], body.influence, horizon, all[b], whole[b],
                                                situation.unevenness[b] < uneven_from);
    if (found.empty()) continue;
    text << "block '" << body.blocks[b].name << "': members are " << all[b] << " spacings thick (4 volume/surface); "
         << found << "\n";
  }
  return text.str();
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

}  // namespace

// Measured between two planes, 4, 8, 10 and 20 layers: +67, +26, +20 and +9 %; at nodes -1 to -0.1 %.
std::string unstrained_ends(const Situation& situation) {
  constexpr double worth_saying = 0.05, of_layer = 0.25;  // spacings that the points of a layer differ by
  const Domain& domain = situation.scene.body.domain;
  if (domain.cloud.at == PointsAt::nodes) return "";
  std::vector<std::uint8_t> held(domain.owned, 0), moved(domain.owned, 0);
  mark_held(situation, held, moved);
  std::map<int, std::string> names;  // of the blocks of each body
  for (std::size_t b = 0; b < domain.blocks.size(); ++b) {
    std::string& name = names[domain.blocks[b].body];
    name += (name.empty() ? "'" : ", '") + domain.cloud.block_names[b] + "'";
  }
  if (!domain.communicator.any(std::ranges::any_of(held, [](std::uint8_t one) { return one != 0; }))) return "";
  // Of each body: of the sides, outwards, and the spacing; points of the outer layers that nothing holds, and points
  // that are not moved along each axis.
  constexpr int extents = sides + 1, counts = sides + 3;
  std::vector<double> all_most(extents * domain.body_count(), std::numeric_limits<double>::lowest());
  std::vector<double> all_free(counts * domain.body_count(), 0);
  const auto outwards = [&](int i, int side) { return (side % 2 == 0 ? -1 : 1) * domain.reference(i)[side / 2]; };
  for (int i = 0; i < domain.owned; ++i) {
    double* const most = &all_most[extents * domain.body_of(i)];
    for (int side = 0; side < sides; ++side) most[side] = std::max(most[side], outwards(i, side));
    most[sides] = std::max(most[sides], domain.cloud.spacings[i]);
  }
  domain.communicator.max(all_most);
  for (int i = 0; i < domain.owned; ++i) {
    const double* const most = &all_most[extents * domain.body_of(i)];
    double* const free = &all_free[counts * domain.body_of(i)];
    for (int side = 0; side < sides; ++side) {
      if (outwards(i, side) > most[side] - of_layer * most[sides] && ((held[i] >> side) & 1) == 0) ++free[side];
      if (side % 2 == 0 && ((moved[i] >> (side / 2)) & 1) == 0) ++free[sides + side / 2];
    }
  }
  domain.communicator.sum(all_free);
  std::ostringstream text;
  text.precision(2);
  for (const auto& [body, name] : names) {
    const double *most = &all_most[extents * body], *free = &all_free[counts * body];
    for (int axis = 0; axis < 3; ++axis) {
      const int ends = (free[2 * axis] == 0 ? 1 : 0) + (free[2 * axis + 1] == 0 ? 1 : 0);
      const double layers = 1 + (most[2 * axis] + most[2 * axis + 1]) / most[sides];
      if (free[sides + axis] == 0 || ends < worth_saying * layers) continue;
      text << (name.find(',') == std::string::npos ? "block " : "blocks ") << name << ": about " << std::round(layers)
           << " layers along "
           << "xyz"[axis] << ", held or pressed at " << (ends == 1 ? "one end" : "both ends")
           << ": points are in the middles of cells, and half a spacing at " << (ends == 1 ? "this end" : "each end")
           << " does not strain: expect " << 100 * ends / layers << " % too much stiffness along "
           << "xyz"[axis] << " (none with Points \"Nodes\", or by a Symmetry Plane)\n";
    }
  }
  return text.str();
}

// Concerns points by correspondence only: ordinary points have no F, and the fits of quadratic cells have a penalty.
std::string flat_families(const Situation& situation) {
  const Body& body = situation.scene.body;
  constexpr double very_flat = 20;  // `flatness`: a tenth of a spacing thick; two layers have 1.3
  std::vector<std::vector<int>> flat(body.blocks.size());
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    for (const int i : body.blocks[b].points) {
      if (body.blocks[b].is_ordinary() || body.blocks[b].is_quadratic()) break;
      const LatticeFamilies* stencil = body.domain.families.lattice(i);
      if ((stencil && stencil->spans_space(i)) || body.has_lost_bonds(i)) continue;  // broken ones are not of the mesh
      if (flatness(body.domain, i) > very_flat) flat[b].push_back(i);
    }
  }
  const std::vector<FoundPoints> found = found_points(body, flat);
  std::ostringstream text;
  for (std::size_t b = 0; b < found.size(); ++b) {
    if (found[b].count == 0) continue;
    text << "WARNING: block '" << body.blocks[b].name << "': the neighbors of " << found[b].count
         << " points, one of them at " << place_text(found[b].one)
         << ", nearly lie in one plane: the strain across it is noise of the mesh, and the steps of the run, or the "
         << "substeps of these points, are several times shorter (substeps may feed vibrations: Solver > Verlet > "
         << "Subcycling false); expected two layers of points or more, also on each side of a crack (Discretization > "
         << "Bond Filters)\n";
  }
  return text.str();
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
  std::vector<std::vector<int>> flat(body.blocks.size());
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    if (!body.blocks[b].is_ordinary()) continue;
    for (const int i : body.blocks[b].points) {
      if (body.domain.families.size(i) > 0 && !(trace(body.shape_inverse[i]) > 0)) flat[b].push_back(i);
    }
  }
  const std::vector<FoundPoints> found = found_points(body, flat);
  std::string text;
  for (std::size_t b = 0; b < found.size(); ++b) {
    if (found[b].count == 0) continue;
    text += text_of("WARNING: block '", body.blocks[b].name, "': the neighbors of ", found[b].count,
                    " points, one of them at ", place_text(found[b].one),
                    ", lie in one plane, which leaves F unknown: there it is shown as the identity and stress as 0, "
                    "though the points bear load (",
                    joined({asked.begin(), asked.end()}),
                    "); expected two layers of points or more, or variables such as Dilatation and reactions\n");
  }
  return text;
}

namespace {

// The families of their centers have no symmetry. Cells by quadratic correspondence need none: their fits balance a
// uniform stress.
std::string centers_of_tetrahedra(const Situation& situation) {
  constexpr std::size_t corners = 4;
  if (situation.deck.discretization.type == deck::MeshType::grid) return "";  // shared nodes may be those of boxes
  const Body& body = situation.scene.body;
  const PointCloud& cloud = body.domain.cloud;
  std::vector<std::vector<int>> of_tetrahedra(body.blocks.size());
  for (std::size_t b = 0; b < body.blocks.size() && cloud.at == PointsAt::elements; ++b) {
    if (body.blocks[b].is_ordinary() || body.blocks[b].is_quadratic() || cloud.shared_nodes.empty()) continue;
    for (const int i : body.blocks[b].points) {
      if (cloud.shared_nodes[i].size() == corners) of_tetrahedra[b].push_back(i);
    }
  }
  const std::vector<FoundPoints> found = found_points(body, of_tetrahedra);
  std::string text;
  for (std::size_t b = 0; b < found.size(); ++b) {
    if (found[b].count == 0) continue;
    text += text_of("WARNING: block '", body.blocks[b].name, "': ", found[b].count,
                    " points are at centers of tetrahedra, where a uniform stress is no equilibrium of the mean "
                    "gradient (bars of tetrahedra were found up to 25 % too soft in tension); expected Formulation "
                    "'Quadratic Correspondence', Points \"Nodes\", or hexahedra\n");
  }
  return text;
}

}  // namespace

// Not of cells by quadratic correspondence, whose fits balance a uniform stress whatever the families around.
std::string unequal_horizons(const Situation& situation) {
  constexpr double of_blocks = 1.1, in_a_block = 1.6;  // a fitted cone has 1.5 between neighbors
  const Body& body = situation.scene.body;
  const Domain& domain = body.domain;
  std::vector<std::vector<int>> beside(body.blocks.size());
  std::vector<double> most(body.blocks.size(), 0);
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    if (body.blocks[b].is_quadratic()) continue;
    for (const int i : body.blocks[b].points) {
      double ratio = 0;
      domain.families.for_each(i, [&](int j) {
        const double there = domain.horizon(j), here = domain.horizon(i);
        const BlockHorizons& own = domain.blocks[b];
        const bool is_of_another = there > of_blocks * own.largest || of_blocks * there < own.smallest;
        const double other = std::max(there / here, here / there);
        if (is_of_another || other > in_a_block) ratio = std::max(ratio, other);
      });
      if (ratio > 0) beside[b].push_back(i);
      most[b] = std::max(most[b], ratio);
    }
  }
  domain.communicator.max(most);
  const std::vector<FoundPoints> found = found_points(body, beside);
  std::ostringstream text;
  text.precision(3);
  for (std::size_t b = 0; b < found.size(); ++b) {
    if (found[b].count == 0) continue;
    text << "WARNING: block '" << body.blocks[b].name << "': " << found[b].count << " points, one of them at "
         << place_text(found[b].one) << ", are bonded to points with other horizons, by a factor of up to " << most[b]
         << ": a uniform stress is no equilibrium there (strains were found to be up to 20 % off at 1.15, "
            "60 % at 1.7 and 90 % at 2); expected one horizon and spacing (Blocks > Horizon), or bodies "
            "that meet in contact (Separate Body)\n";
  }
  return centers_of_tetrahedra(situation) + text.str();
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

std::string points_off_lattices(const Situation& situation) {
  constexpr double worth_saying = 0.05;                            // stress a few percent off
  constexpr std::size_t enough = 2000, corners_of_tetrahedra = 4;  // points of a block and rank
  const Body& body = situation.scene.body;
  const Domain& domain = body.domain;
  const auto& nodes = domain.cloud.shared_nodes;
  std::vector<std::vector<int>> off(body.blocks.size());
  std::vector<double> most(body.blocks.size(), 0);
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    if (body.blocks[b].is_quadratic()) continue;
    const auto& points = body.blocks[b].points;
    for (std::size_t k = 0; k < points.size(); k += 1 + points.size() / enough) {
      const int i = points[k];
      const bool is_told = !body.blocks[b].is_ordinary() && domain.cloud.at == PointsAt::elements && !nodes.empty() &&
                           nodes[i].size() == corners_of_tetrahedra;  // centers_of_tetrahedra()
      if (is_told || domain.families.lattice(i)) continue;
      const double found = off_lattice(domain, i);
      if (found > worth_saying) off[b].push_back(i);
      most[b] = std::max(most[b], found);
    }
  }
  domain.communicator.max(most);
  const std::vector<FoundPoints> found = found_points(body, off);
  std::string text;
  for (std::size_t b = 0; b < found.size(); ++b) {
    if (found[b].count == 0) continue;
    text += text_of(
        std::setprecision(2), "WARNING: block '", body.blocks[b].name, "': around ", found[b].count,
        " points or more, one of them at ", place_text(found[b].one), ", neighbors are off a lattice by up to ",
        most[b], " spacings, as beside cells of another size: a uniform stress is no equilibrium there (",
        body.blocks[b].is_ordinary()
            ? "stress was found to be up to 10 % off, strains up to 50 %"
            : "in elastic equilibria stress was found to be 10 % off at 0.1, 20 to 80 % from 0.2 on, and displacements "
              "alternate between neighbors; in Taylor bars plastic strain was 5 % off",
        "); expected cells of one size in a lattice, or Formulation 'Quadratic Correspondence'\n");
  }
  return text;
}

std::string narrow_surfaces_of_nodes(const Situation& situation) {
  constexpr double narrow = 8;  // spacings
  const Body& body = situation.scene.body;
  if (body.domain.cloud.at != PointsAt::nodes) return "";
  std::set<int> blocks;
  for (const auto& [first, second, model] : situation.interactions) {
    if (std::holds_alternative<contact::SurfaceLaw>(model.law)) blocks.insert({first, second});
  }
  if (blocks.empty()) return "";
  const std::vector<double>& all = situation.members;
  std::string names;
  for (const int b : blocks) {
    if (all[b] > 0 && all[b] <= narrow) names += (names.empty() ? "" : ", ") + body.blocks[b].name;
  }
  if (names.empty()) return "";
  return "WARNING: " + names +
         ": with points at nodes contact by surfaces is weak near edges: blocks 4 spacings wide were found to bear 0.1 "
         "of the pressure of wide faces, 8 spacings wide 0.4; expected Points \"Elements\"\n";
}

}  // namespace strut

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <set>

#include "advice/checks.hpp"
#include "advice/lattice_axes.hpp"
#include "base/text.hpp"
#include "topology/cell_edges.hpp"

namespace strut {

namespace {

// ---- Dilatation of ordinary solids ---------------------------------------------------------------------------------

// True if less than a layer is missing on both sides along a direction. The next layer is that of the nearest neighbor
// in a cone around it; without any, as across a single row or layer, surfaces are near.
bool reaches_horizon(const Domain& domain, int i, const Vector& direction) {
  constexpr double narrow = 0.8;  // the cosine
  double ahead = 0, behind = 0, layer = std::numeric_limits<double>::infinity();
  domain.families.for_each(i, [&](int j) {
    const Vector xi = domain.reference(j) - domain.reference(i);
    const double along = direction.dot(xi);
    ahead = std::max(ahead, along), behind = std::max(behind, -along);
    if (std::abs(along) > narrow * xi.norm()) layer = std::min(layer, std::abs(along));
  });
  constexpr double round_off = 1e-3;  // of a layer, for coordinates in single precision
  return std::isfinite(layer) && std::min(ahead, behind) > domain.horizon(i) - (1 - round_off) * layer;
}

// True if a neighbor has less than a whole cell, as nodes at a surface have.
bool has_parts_of_cells(const Domain& domain, int i) {
  bool found = false;
  domain.families.for_each(i, [&](int j) { found |= domain.volume(j) < 0.75 * domain.volume(i); });
  return found;
}

// 3 K/tr K of an ordinary point, K = Σ ω V ξ⊗ξ: by how much its dilatation (3/m) Σ ω V |ξ| e counts strain along each
// direction. Zero where bonds are broken, or where a surface is near: along the axes of space, of K, or of the lattice,
// which a body's turn leaves square to its faces.
Tensor counts_of_strain(const Body& body, int i) {
  const Tensor inverse = to_tensor(body.shape_inverse[i]);
  if (body.has_lost_bonds(i) || !(inverse.trace() > 0) || has_parts_of_cells(body.domain, i)) return Tensor::Zero();
  const Tensor K = inverse.inverse();
  const Tensor axes = Eigen::SelfAdjointEigenSolver<Tensor>(K).eigenvectors();
  const Tensor of_lattice = lattice_axes(body.domain, i);
  for (int c = 0; c < 3; ++c) {
    for (const Vector& direction : {Vector(Vector::Unit(c)), Vector(axes.col(c)), Vector(of_lattice.col(c))}) {
      if (!reaches_horizon(body.domain, i, direction)) return Tensor::Zero();
    }
  }
  return 3 / K.trace() * K;
}

// For blocks whose points are all near surfaces, as in struts: their counts of strain would show surfaces, too.
std::string uneven_members_warning(const MaterialBlock& block, double uneven) {
  if (!block.is_ordinary() || uneven < uneven_from) return "";
  return text_of(std::setprecision(2), "WARNING: block '", block.name,
                 "': its points are not on a cubic lattice (cells oblong or oblique by a factor of ", uneven,
                 "), so the dilatation of the material model 'Elastic' counts strain along some directions more than "
                 "along others (bars of 4 × 4 points were found 1.1 to 2.3 times as stiff as their material); expected "
                 "cubes, or 'Elastic Correspondence' by Formulation 'Quadratic Correspondence'\n");
}

}  // namespace

std::string uneven_dilatation(const Situation& situation) {
  constexpr double worth_saying = 0.02;
  constexpr std::size_t enough = 2000;  // points of a block and rank
  const Body& body = situation.scene.body;
  std::vector<Tensor> sums(body.blocks.size(), Tensor::Zero());
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    if (!body.blocks[b].is_ordinary()) continue;
    const auto& points = body.blocks[b].points;
    for (std::size_t k = 0; k < points.size(); k += 1 + points.size() / enough) {
      sums[b] += counts_of_strain(body, points[k]);
    }
  }
  return lines_of_blocks(situation, [&](const MaterialBlock& block, std::size_t b) -> std::string {
    Tensor& sum = sums[b];
    body.domain.communicator.sum(std::span<double>(sum.data(), 9));
    if (!(sum.trace() > 0)) return uneven_members_warning(block, situation.unevenness[b]);
    for (const Mirror& mirror : body.domain.mirrors) {  // the images count, too
      if (mirror.body != body.domain.blocks[b].body) continue;
      const Tensor turn = Reflection::by(mirror).turn;
      sum = (0.5 * (sum + turn * sum * turn.transpose())).eval();
    }
    const Vector counts = Eigen::SelfAdjointEigenSolver<Tensor>(3 / sum.trace() * sum).eigenvalues();
    if (std::max(counts[2] - 1, 1 - counts[0]) < worth_saying) return "";
    return text_of(std::setprecision(3), "WARNING: block '", block.name,
                   "': its points are not on a cubic lattice, so the dilatation of the material model 'Elastic' counts "
                   "strain along one direction ",
                   counts[0], " times and along another ", counts[2],
                   " times, and stress and wave speeds are off by as much or more; expected cubes, or 'Elastic "
                   "Correspondence' by Formulation 'Quadratic Correspondence'\n");
  });
}

namespace {

// ---- Surfaces and cracks -------------------------------------------------------------------------------------------

// Means over the cells of a block with known edges, m; 0 without any. Over whole cells where there are some.
struct MeanEdges {
  double shortest = 0, spacing = 0, longest = 0;
};

std::vector<MeanEdges> mean_edges(const Domain& domain) {
  const std::size_t blocks = domain.blocks.size();
  std::vector<double> sums(8 * blocks);  // of whole cells, then of parts
  for (int i = 0; i < domain.owned; ++i) {
    if (!has_known_edges(domain, i)) continue;
    const CellEdges edges = edges_of_cell(domain, i);
    double* of_block = &sums[4 * (domain.cloud.blocks[i] + (has_whole_cell(domain, i) ? 0 : blocks))];
    of_block[0] += edges.shortest, of_block[1] += domain.cloud.spacings[i], of_block[2] += edges.longest, ++of_block[3];
  }
  domain.communicator.sum(sums);
  std::vector<MeanEdges> means;
  for (std::size_t b = 0; b < blocks; ++b) {
    const double* of_block = &sums[4 * (sums[4 * b + 3] > 0 ? b : b + blocks)];
    const double count = std::max(1.0, of_block[3]);
    means.push_back({of_block[0] / count, of_block[1] / count, of_block[2] / count});
  }
  return means;
}

bool has_fracture_energy(const MaterialBlock& block) {
  const auto& damage = block.material.damage;
  return damage && (damage->fracture_energy > 0 || (damage->ductility && damage->ductility->fracture_energy > 0));
}

// A warning for each block whose cracks or contact have the constants of its largest cells, but whose cells differ.
std::string unequal_cells_warning(const Situation& situation, const std::set<int>& touching) {
  constexpr double worth_saying = 1.25;
  const Body& body = situation.scene.body;
  const std::set<int> by_points = blocks_that_meet_by<contact::PairLaw>(situation);
  return lines_of_blocks(situation, [&](const MaterialBlock& block, int b) -> std::string {
    double least = HUGE_VAL;
    for (const int i : block.points) least = std::min(least, body.domain.cloud.spacings[i]);
    least = body.domain.communicator.min(least);
    const double largest = body.domain.blocks[b].spacing;
    if (!(largest > worth_saying * least)) return "";
    std::string off;
    if (has_fracture_energy(block))
      off +=
          ", and its cracks the constants of the largest: between cells half as large a crack takes half of the "
          "Fracture Energy, by Bond Energy a tenth";
    if (touching.contains(b))
      off +=
          ", and its contact by surfaces the constants of the largest: cells half as large were found to meet 0.08 "
          "of their edge early, in contact that is up to a third softer";
    if (by_points.contains(b))
      off += text_of(std::setprecision(3), ", and its contact one Contact Radius: the faces of some meet ",
                     largest - least, " m earlier than those of others");
    if (off.empty()) return "";
    return text_of(std::setprecision(3), "WARNING: block '", block.name, "': its cells have edges of ", least, " to ",
                   largest, " m", off, "; expected cells of one size, or a block for each\n");
  });
}

}  // namespace

std::string oblong_cells(const Situation& situation) {
  constexpr double worth_saying = 1.3;
  const std::vector<MeanEdges> all = mean_edges(situation.scene.body.domain);
  const std::set<int> touching = blocks_that_meet_by<contact::SurfaceLaw>(situation);
  const auto line = [&](const MaterialBlock& block, int b) -> std::string {
    const auto& [shortest, spacing, longest] = all[b];
    const bool touches = touching.contains(b), breaks = has_fracture_energy(block);
    if (!(touches || breaks) || !(longest > worth_saying * shortest)) return "";
    std::string off;
    if (touches) {
      off = text_of(std::setprecision(2), ": contact by surfaces begins up to ",
                    std::max(spacing - shortest, longest - spacing), " m early or late");
    }
    if (breaks) {
      off += std::string(touches ? ", and" : ":") +
             " cracks take more or less than the Fracture Energy (0.4 to 1.4 of it was found at ratios of 2 and 3)";
    }
    return text_of(std::setprecision(2), "WARNING: block '", block.name,
                   "': its cells are no cubes (the longest edge is ", longest / shortest, " times the shortest)", off,
                   "; expected cubes\n");
  };
  return lines_of_blocks(situation, line) + unequal_cells_warning(situation, touching);
}

}  // namespace strut

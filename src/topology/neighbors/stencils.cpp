#include "topology/neighbors/stencils.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strut {

Stencils stencils_of(const std::vector<LatticeFrame>& frames, const std::vector<Vector>& positions,
                     const std::vector<int>& bodies, int owned) {
  Stencils stencils{{}, std::vector<int>(positions.size(), -1)};
  for (const LatticeFrame& frame : frames) {
    std::vector<int> members;
    for (int i = 0; i < static_cast<int>(positions.size()); ++i) {
      if (bodies[i] != frame.body) continue;
      members.push_back(i);
      stencils.of[i] = static_cast<int>(stencils.lattices.size());
    }
    stencils.lattices.emplace_back(frame, positions, std::move(members), owned);
  }
  return stencils;
}

namespace {

// Time of a step for the bonds of a point, ns, measured with tests/bench. A list costs less than in proportion to the
// number of neighbors, because a cluster has one list for all of its points. `pencils`: pencils of the lattice per
// point.
double cost_of_list(double neighbors) { return 80 + 3.2 * std::pow(neighbors, 0.84); }
double cost_of_stencil(double rows, double pencils) { return 35 + (280 + 8 * rows) * pencils; }

// True if sums by a lattice's stencil take less time than by lists. Decided by sums over the points of all ranks, so
// that the result is the same for any number of ranks. A run of n points fills (n + 7)/8 pencils on average; families
// are counted for every 64th point.
bool is_faster(const LatticeFamilies& lattice, const CandidatePool& pool, int owned, const Communicator& communicator) {
  double counts[4] = {0, 0, 0, 0};  // points, runs, samples, their neighbors
  for (int i = 0; i < owned; ++i) {
    if (lattice.cell(i) < 0) continue;
    counts[0] += 1;
    counts[1] += lattice.begins_run(i) ? 1 : 0;
    if (pool.ids[i] % 64 != 0) continue;
    counts[2] += 1;
    counts[3] += static_cast<double>(lattice.family_size(i));
  }
  communicator.sum(counts);
  const double pencils = (1 + 7 * counts[1] / counts[0]) / 8;
  return cost_of_stencil(static_cast<double>(lattice.rows().size()), pencils) <=
         cost_of_list(counts[3] / std::max(1.0, counts[2]));
}

}  // namespace

BondCosts bond_costs(const PointCloud& cloud, const std::vector<BlockBonds>& bonds, const std::vector<double>& spacings,
                     const Communicator& communicator) {
  constexpr double pencils = 1.0 / 6;  // pencils per point: between a full block's eighth and a foam's fifth
  const std::vector<LatticeFrame> frames = lattice_frames(cloud, horizons_of(cloud, bonds), bonds, communicator);
  BondCosts costs;
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const double reach = spacings[b] > 0 ? bonds[b].horizon_at(spacings[b]) / spacings[b] : 0;
    const double list = cost_of_list(4.0 / 3 * std::numbers::pi * std::pow(reach, 3));
    const double stencil = cost_of_stencil(std::numbers::pi * reach * reach, pencils);
    const auto here = [&](const LatticeFrame& frame) { return frame.body == bonds[b].body; };
    const bool by_stencil = stencil < list && std::any_of(frames.begin(), frames.end(), here);
    costs.of_block.push_back(by_stencil ? stencil : list);
    costs.by_stencils = costs.by_stencils || by_stencil;
  }
  return costs;
}

std::vector<LatticeFrame> chosen_frames(const std::vector<LatticeFrame>& found, const Stencils& stencils,
                                        const CandidatePool& pool, int owned, const Communicator& communicator) {
  std::vector<LatticeFrame> chosen;
  for (std::size_t l = 0; l < found.size(); ++l) {
    if (found[l].wanted || is_faster(stencils.lattices[l], pool, owned, communicator)) chosen.push_back(found[l]);
  }
  return chosen;
}

std::vector<LatticeFrame> frames_with_images(const std::vector<LatticeFrame>& found, const CandidatePool& pool,
                                             int owned, const Mirrored& mirrored, const Communicator& communicator) {
  std::vector<LatticeFrame> frames;
  for (LatticeFrame frame : found) {
    bool fits = true;
    if (!mirrored.images.of_body(frame.body).empty()) {
      frame.make_room();
      for (std::size_t j = owned; j < pool.ids.size(); ++j) {
        if (pool.bodies[j] == frame.body && Images::image(pool.ids[j]) > 0) fits = fits && frame.has(pool.positions[j]);
      }
      for (const Mirror& mirror : mirrored.mirrors) {
        if (mirror.body != frame.body) continue;
        for (int i = 0; i < owned; ++i) {
          fits = fits && (pool.bodies[i] != frame.body ||
                          std::abs(mirror.distance(pool.positions[i])) > 0.25 * frame.spacing.minCoeff());
        }
      }
    }
    if (!communicator.any(!fits)) frames.push_back(frame);
  }
  return frames;
}

}  // namespace strut

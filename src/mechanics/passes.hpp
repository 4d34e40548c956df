// Inside mechanics: passes over the points of a body that overlap with the exchange of what they read of ghosts.
#pragma once

#include <algorithm>

#include "base/timing.hpp"
#include "mechanics/kernels/lane_groups.hpp"
#include "mechanics/reflected.hpp"
#include "topology/parallel_for.hpp"

namespace strut {

// Runs work(part) for the points that need no ghost while an exchange is under way, then for the others.
template <class Start, class Finish, class Work>
void between(const Start& start, const Finish& finish, const Work& work) {
  static Teuchos::Time& waiting = phase("Halo exchange");
  {
    const Timed timed(waiting);
    start();
  }
  work(Part::interior);
  {
    const Timed timed(waiting);
    finish();
  }
  work(Part::boundary);
}

template <class State, class Work>
void behind_exchange(const Halo& halo, std::vector<State>& states, const Work& work) {
  between([&] { halo.start(states); }, [&] { halo.finish(states); }, work);
}

template <auto reflected, class Work>
void behind_exchange_of(const Halo& halo, std::vector<Site>& places, const Work& work) {
  between([&] { halo.start_positions(places); }, [&] { halo.finish_positions<reflected>(places); }, work);
}

// The bodies of a pass: forces need only the deforming ones, a tangent needs all.
enum class Bodies { all, deforming };

inline bool is_active(const MaterialBlock& block, Bodies bodies) {
  return bodies == Bodies::all || !block.in_rigid_motion;
}

// Calls work(block, groups of its points) for a part of the points. A sweep over a lattice needs the ghosts and
// computes the sums of all its points, so all points on lattices belong to the boundary part; those that have lost
// bonds come last. sweep(sums, take) computes the sums over one lattice and passes them to `take`, chunk by chunk.
template <class AnyBody, class Sweep, class Work>
void over_blocks(AnyBody& body, Bodies bodies, Part part, const Sweep& sweep, const Work& work) {
  for (auto& block : body.blocks) {
    if (block.lattice < 0 && is_active(block, bodies)) work(block, LaneGroups(body, block, part));
  }
  if (part == Part::interior) return;
  for (std::size_t l = 0; l < body.lattice_sums.size(); ++l) {
    const auto is_on_it = [&](const MaterialBlock& b) {
      return b.lattice == static_cast<int>(l) && is_active(b, bodies);
    };
    if (std::none_of(body.blocks.begin(), body.blocks.end(), is_on_it)) continue;
    sweep(*body.lattice_sums[l], [&](const LatticeSums::Chunk& chunk) {
      for (auto& block : body.blocks) {
        if (is_on_it(block)) work(block, LaneGroups(block, chunk));
      }
    });
    for (auto& block : body.blocks) {
      if (is_on_it(block) && !block.off_stencil.places.empty()) work(block, LaneGroups(block, block.off_stencil));
    }
  }
}

// Calls work(group, ω) for each group.
template <class Work>
void over_groups(const Body& body, const LaneGroups& groups, const Work& work) {
  bonds::with_influence(body.influence, [&](auto weight) {
    for_each_point(0, groups.count(), [&, weight](int g) { work(groups[g], weight); });
  });
}

}  // namespace strut

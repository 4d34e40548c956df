// The broken bonds in checkpoints: one bit per original bond of a point, in the order of the ids of the far ends,
// packed into doubles.
#include <algorithm>
#include <cmath>

#include "fracture/broken_family.hpp"
#include "fracture/fracture.hpp"
#include "mechanics/expansion.hpp"
#include "mechanics/off_stencil.hpp"
#include "mechanics/reflected.hpp"
#include "mechanics/steepness.hpp"

namespace strut {

namespace {

constexpr int bits_a_word = 48;

// Calls visit(index in the order of ids, id) over the original family.
template <class Visit>
void over_whole_family(const Domain& domain, int i, const Visit& visit) {
  std::vector<std::int64_t> ids;
  for (const int j : domain.families.broken[i]) ids.push_back(domain.id(j));
  domain.families.for_each(i, [&](int j) { ids.push_back(domain.id(j)); });
  std::sort(ids.begin(), ids.end());
  for (std::size_t n = 0; n < ids.size(); ++n) visit(static_cast<int>(n), ids[n]);
}

int words_of(const Domain& domain) {
  std::size_t most = 0;
  for (int i = 0; i < domain.owned; ++i) {
    most = std::max(most, domain.families.size(i) + domain.families.broken[i].size());
  }
  return (static_cast<int>(domain.communicator.max(static_cast<double>(most))) + bits_a_word - 1) / bits_a_word;
}

}  // namespace

void Fracture::serialize(Archive& archive, Body& body) {
  Domain& domain = body.domain;
  const int words = words_of(domain);
  std::vector<double> bits(static_cast<std::size_t>(words) * domain.owned, 0);
  for (int i = 0; i < domain.owned; ++i) {
    if (domain.families.broken[i].empty()) continue;
    std::vector<std::int64_t> broken;
    for (const int j : domain.families.broken[i]) broken.push_back(domain.id(j));
    std::sort(broken.begin(), broken.end());
    over_whole_family(domain, i, [&](int n, std::int64_t id) {
      if (std::binary_search(broken.begin(), broken.end(), id)) {
        bits[static_cast<std::size_t>(i) * words + n / bits_a_word] += std::ldexp(1.0, n % bits_a_word);
      }
    });
  }
  archive.field("broken_bonds", words, [&](std::size_t i, int c) -> double& { return bits[i * words + c]; });
  // A break in the next step needs the states at its start.
  const auto states = [&](const char* name, auto& of_points, bool exist) {
    using State = std::remove_cvref_t<decltype(of_points[0])>;
    if (!exist) return;
    archive.field(name, sizeof(State) / sizeof(double),
                  [&](std::size_t i, int c) -> double& { return reinterpret_cast<double*>(&of_points[i])[c]; });
  };
  // Decided by the blocks of the scene, also on a rank without points.
  const auto any = [&](Formulation formulation) {
    return std::ranges::any_of(body.blocks, [&](const auto& b) { return b.material.formulation == formulation; });
  };
  states("tensor_state", body.force_states.tensors, any(Formulation::correspondence));
  states("scalar_state", body.force_states.scalars, any(Formulation::ordinary));
  states("gradient_state", body.force_states.gradients, body.has_springs(ResidualKind::both_gradients));
  states("quadratic_state", body.force_states.quadratics, any(Formulation::quadratic));
  if (archive.loading()) restore(body, bits, words);
}

namespace {

// The next step needs the failed points, and the force states and expansion of ordinary points, before it exchanges
// them.
void exchange_states(Body& body) {
  ForceStates& states = body.force_states;
  const Domain& domain = body.domain;
  if (!states.scalars.empty()) domain.halo.exchange(states.scalars);
  if (!states.gradients.empty()) domain.halo.exchange(states.gradients);
  if (!body.expansion.empty()) exchange_expansion(body);
  std::vector<double> failed(domain.sites.size(), 0);
  for (int i = 0; i < domain.owned; ++i) failed[i] = states.has_failed(i);
  domain.halo.exchange(failed);
  for (std::size_t i = domain.owned; i < failed.size(); ++i) {
    if (!states.tensors.empty()) states.tensors[i].failed() = failed[i];
    if (!states.quadratics.empty()) states.quadratics[i].failed = failed[i];
  }
}

}  // namespace

void Fracture::restore(Body& body, const std::vector<double>& bits, int words) {
  ClusterLists& lists = body.domain.families.lists;
  const auto is_gone = [&](int i, int n) {
    const auto word = static_cast<std::uint64_t>(bits[static_cast<std::size_t>(i) * words + n / bits_a_word]);
    return (word >> (n % bits_a_word) & 1) != 0;
  };
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    MaterialBlock& block = body.blocks[b];
    const std::size_t breakable = body.may_break(b) ? block.points.size() : 0;
    for (std::size_t k = 0; k < breakable; ++k) {
      const int i = block.points[k], c = lists.holding(i), lane = i - lists[c].points[0];
      const Cluster cluster = lists[c];  // neighbors in the order of their ids
      int place = 0, gone = 0;
      for (std::size_t n = 0; n < cluster.near.size(); ++n) {
        if (!(cluster.mask[n] >> lane & 1) || !is_gone(i, place++)) continue;
        lists.cut(c, n, static_cast<std::uint8_t>(1u << lane));
        body.domain.families.broken[i].push_back(cluster.near[n]);
        ++gone;
      }
      lists.drop_cut(c);
      if (gone > 0 && block.lattice >= 0) body.domain.families.off_stencil[i] = 1;
      if (gone > 0 && body.released[i] == 0) refit(body, block, static_cast<int>(k), most_steepness_[i]);
      if (body.released[i] > 0) release(body, block, static_cast<int>(k));
    }
    set_off_stencil(body.domain, block);
  }
  look_at_all(body);
  exchange_states(body);
}

}  // namespace strut

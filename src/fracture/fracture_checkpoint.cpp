// The broken bonds in checkpoints. For each original bond of a point, in the order of the ids of the far ends: its
// number among the breaks of the point, from 1 on, or 0 if it holds, packed into doubles. Contact knows by these
// numbers which breaks its last search has seen.
#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>

#include "fracture/broken_family.hpp"
#include "fracture/fracture.hpp"
#include "mechanics/expansion.hpp"
#include "mechanics/make_body.hpp"
#include "mechanics/reflected.hpp"
#include "mechanics/steepness.hpp"

namespace strut {

namespace {

// Rows of `most` numbers from 0 to `most`, several in a double.
class PackedRows {
 public:
  PackedRows(std::size_t most, std::size_t rows)
      : bits_(std::max<std::size_t>(1, std::bit_width(most))), words_((most + in_word() - 1) / in_word()) {
    values_.assign(rows * words_, 0);
  }

  std::size_t words() const { return words_; }  // of a row
  double& word(std::size_t row, std::size_t c) { return values_[row * words_ + c]; }
  bool any(std::size_t row) const {
    const auto begin = values_.begin() + static_cast<std::ptrdiff_t>(row * words_);
    return std::any_of(begin, begin + static_cast<std::ptrdiff_t>(words_), [](double word) { return word != 0; });
  }

  std::size_t get(std::size_t row, std::size_t n) const {
    const auto word = static_cast<std::uint64_t>(values_[row * words_ + n / in_word()]);
    return word >> shift(n) & ((std::uint64_t{1} << bits_) - 1);
  }
  void set(std::size_t row, std::size_t n, std::size_t number) {  // where it is 0
    values_[row * words_ + n / in_word()] += static_cast<double>(number << shift(n));
  }

 private:
  std::size_t in_word() const { return std::numeric_limits<double>::digits / bits_; }
  std::size_t shift(std::size_t n) const { return n % in_word() * bits_; }

  std::size_t bits_, words_;
  std::vector<double> values_;
};

// Calls visit(index in the order of ids, id) over the original family.
template <class Visit>
void over_whole_family(const Domain& domain, int i, const Visit& visit) {
  std::vector<std::int64_t> ids;
  for (const int j : domain.families.broken[i]) ids.push_back(domain.id(j));
  domain.families.for_each(i, [&](int j) { ids.push_back(domain.id(j)); });
  std::sort(ids.begin(), ids.end());
  for (std::size_t n = 0; n < ids.size(); ++n) visit(static_cast<int>(n), ids[n]);
}

// Cuts the bonds of owned point i that have broken.
void cut_again(Domain& domain, int i, const PackedRows& breaks) {
  ClusterLists& lists = domain.families.lists;
  const int c = lists.holding(i), lane = i - lists[c].points[0];
  const Cluster cluster = lists[c];  // neighbors in the order of their ids
  std::vector<std::pair<std::size_t, int>> broken;
  std::size_t place = 0;
  for (std::size_t n = 0; n < cluster.near.size(); ++n) {
    if (!(cluster.mask[n] >> lane & 1)) continue;
    const std::size_t number = breaks.get(i, place++);
    if (number == 0) continue;
    lists.cut(c, n, static_cast<std::uint8_t>(1u << lane));
    broken.emplace_back(number, cluster.near[n]);
  }
  lists.drop_cut(c);
  std::sort(broken.begin(), broken.end());
  for (const auto& [number, j] : broken) domain.families.broken[i].push_back(j);
}

}  // namespace

void Fracture::serialize(Archive& archive, Body& body) {
  Domain& domain = body.domain;
  if (archive.loading() && broken_bonds(body) > 0)
    throw std::logic_error("broken bonds are restored to whole families, and bonds of this body have broken");
  PackedRows breaks(largest_whole_family(domain), domain.owned);
  for (int i = 0; i < domain.owned; ++i) {
    const std::vector<int>& broken = domain.families.broken[i];
    if (broken.empty()) continue;
    over_whole_family(domain, i, [&](int n, std::int64_t id) {
      const auto found = std::ranges::find(broken, id, [&](int j) { return domain.id(j); });
      if (found != broken.end()) breaks.set(i, n, found - broken.begin() + 1);
    });
  }
  archive.field("breaks", static_cast<int>(breaks.words()),
                [&](std::size_t i, int c) -> double& { return breaks.word(i, c); });
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
  if (!archive.loading()) return;
  for (int i = 0; i < domain.owned; ++i) {
    if (breaks.any(i)) cut_again(domain, i, breaks);
  }
  restore(body);
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

void Fracture::restore(Body& body) {
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    MaterialBlock& block = body.blocks[b];
    const std::size_t breakable = body.may_break(b) ? block.points.size() : 0;
    for (std::size_t k = 0; k < breakable; ++k) {
      const int i = block.points[k];
      const bool gone = body.has_lost_bonds(i);
      // In a run without a Damage Model springs are softer. Where one has been added, whole points get the springs of
      // this run; points that have failed have no springs.
      double& springs = body.points[i].stabilization;
      if (springs > 0 && !gone)
        springs = std::max(springs, whole_springs_[i] * part_of_springs(body, block, static_cast<int>(k)));
      if (gone && block.lattice >= 0) body.domain.families.off_stencil[i] = 1;
      if (gone && body.released[i] == 0) refit(body, block, static_cast<int>(k), most_steepness_[i]);
      if (body.released[i] > 0) release(body, block, static_cast<int>(k));
    }
    set_off_stencil(body.domain, block);
  }
  mark_all_for_check(body);
  exchange_states(body);
}

}  // namespace strut

#include "fracture/fracture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/timing.hpp"
#include "fracture/broken_family.hpp"
#include "fracture/separation.hpp"
#include "fracture/work_balance.hpp"
#include "mechanics/kernels/bonds.hpp"
#include "mechanics/kernels/lane_groups.hpp"
#include "mechanics/make_body.hpp"
#include "mechanics/reflected.hpp"
#include "topology/parallel_for.hpp"

namespace strut {

namespace {

using small::Lanes;

constexpr double never = std::numeric_limits<double>::infinity();

// The check of a cluster and the decision on a bond may round differently: below this margin no bond breaks.
constexpr double round_off = 1e-9;

// Range of a block's points whose stress is updated with a part; on lattices all with the boundary part (over_blocks).
std::pair<int, int> updated_with(const MaterialBlock& block, Part part) {
  if (block.lattice < 0) return range(block, part);
  return {0, part == Part::interior ? 0 : static_cast<int>(block.points.size())};
}

// Range of their clusters: the first, and one past the last. On a lattice it may contain clusters of other blocks.
std::pair<int, int> clusters_of(const Body& body, const MaterialBlock& block, Part part) {
  const auto [begin, end] = updated_with(block, part);
  if (begin == end) return {0, 0};
  const ClusterLists& lists = body.domain.families.lists;
  return {lists.holding(block.points[begin]), lists.holding(block.points[end - 1]) + 1};
}

bool is_of(const Body& body, const MaterialBlock& block, int cluster) {
  return block.lattice < 0 || &body.block_of(body.domain.families.lists[cluster].points[0]) == &block;
}

// Calls work(block, first cluster, one past the last) for the deforming blocks whose bonds may break.
template <class AnyBody, class Work>
void over_breakable(AnyBody& body, Part part, const Work& work) {
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    if (!body.may_break(b) || body.blocks[b].in_rigid_motion) continue;
    const auto [first, last] = clusters_of(body, body.blocks[b], part);
    work(body.blocks[b], first, last);
  }
}

// The energy missing in the balance of a point, J.
double released(const BondWorkBalance& before, const BondWorkBalance& after) {
  return 0.5 * (before.work + after.work) - (after.energy - before.energy);
}

bool fails(const MaterialBlock& block) {
  const auto may_fail = []<class L>(const L&) { return materials::has_changing_moduli<L>; };
  return block.material.damage && std::visit(may_fail, block.material.law);
}

}  // namespace

// Calls visit(n, (|η|/((1 + s)|ξ|))²) for the n-th neighbor of a cluster, for each n, with the lesser s of both ends; 0
// in lanes that are not bonded to it. Two callers may get different last digits (round_off): only bonds_to_cut decides,
// identically on all ranks.
struct Fracture::Stretches {
  const Site* sites;
  const double* limits;

  template <class Visit>
  void over(const Cluster& cluster, const Visit& visit) const {
    const bonds::OfCluster family{cluster};
    const auto y = bonds::own_position(family, sites, &Site::current);
    const Lanes own = family.own<1>([this](int i) { return &limits[i]; })[0];
    std::size_t n = 0;
    bonds::over(family, sites, bonds::One(), [&](int j, const Lanes&, const auto& xi, const auto& present) {
      const auto eta = bonds::apart(sites[j].current, y);
      const Lanes squared = bonds::dot(xi, xi) + (1 - present);
      visit(n++, Lanes(present * bonds::dot(eta, eta) / (own.min(limits[j]) * squared)));
    });
  }
};

void Fracture::set_which(const Body& body) {
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    may_fail_.push_back(fails(body.blocks[b]));
    const auto& damage = body.blocks[b].material.damage;
    by_time_ = by_time_ || (damage && damage->critical_stretch && damage->critical_stretch->depends_on_time());
  }
}

Fracture::Fracture(Body& body, double time) : travel_(body.domain) {
  const Domain& domain = body.domain;
  set_critical_values(body);
  set_crack_lengths(body);
  set_which(body);
  fitted_ = FittedCriterion(body);
  averaged_ = AveragedCriterion(body);
  energies_ = BondEnergies(body);
  for (const MaterialPoint& point : body.points) whole_springs_.push_back(point.stabilization);
  block_of_.assign(domain.sites.size(), 0);
  for (int i = 0; i < domain.owned; ++i) block_of_[i] = domain.cloud.blocks[i];
  body.domain.halo.exchange(block_of_);
  body.domain.families.broken.resize(domain.owned);
  body.damage.use(domain.owned);
  body.fracture_energy.use(domain.owned);
  body.released.use(domain.owned);
  for (int i = 0; i < domain.owned; ++i) whole_volume_.push_back(family_volume(domain, i));
  mark_all_for_check(body);
  set_shortest(body);
  set_most_steepness(body);
  set_limits(body, time);
}

// Marks the clusters of these points, and those that have them in their families, for the next check.
void Fracture::mark_for_check(const Body& body, const std::vector<char>& points) {
  if (points.empty()) return;
  const auto is = [&points](int i) { return points[i] != 0; };
  for (std::size_t c = 0; c < next_checks_.size(); ++c) {
    const Cluster cluster = body.domain.families.lists[static_cast<int>(c)];
    const bool meets = std::any_of(cluster.near.begin(), cluster.near.end(), is) ||
                       std::any_of(cluster.points.begin(), cluster.points.end(), is);
    if (meets) next_checks_[c] = 0;
  }
}

void Fracture::start_step(const Body& body, std::span<const Vector> velocities, double dt, const Vector& stretch) {
  std::vector<double> next_checks = next_checks_;
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    const MaterialBlock& block = body.blocks[b];
    if (!body.may_break(b) || !block.in_rigid_motion)
      continue;  // points on the lattice of another body have no cluster
    for (const Part part : {Part::interior, Part::boundary}) {
      const auto [first, last] = clusters_of(body, block, part);
      for (int c = first; c < last; ++c) next_checks[c] = is_of(body, block, c) ? never : next_checks[c];
    }
  }
  const bool is_reached = travel_.advance(body, velocities, dt, next_checks, stretch);
  const bool any_fails = std::find(may_fail_.begin(), may_fail_.end(), true) != may_fail_.end();
  is_checked_ = is_reached || limits_change(body) || any_fails || energies_.any() ||
                std::ranges::any_of(body.blocks, springs_fade);
  if (is_checked_) keep_start(body);
  if (energies_.any()) energies_.take_expansions(body);
}

void Fracture::start_rest(const Body& body) {
  mark_all_for_check(body);
  keep_start(body);
  is_checked_ = true;
}

double Fracture::largest_stretch(const Body& body) const {
  const Domain& domain = body.domain;
  const auto is_gradual = [&](int i) {  // a bond of a gradual crack holds next to nothing when it breaks
    const auto& damage = body.blocks[block_of_[i]].material.damage;
    return damage && damage->is_gradual;
  };
  double largest = 0;
  for (int i = 0; i < domain.owned; ++i) {
    if (is_gradual(i)) continue;
    domain.families.for_each(i, [&](int j) {
      if (is_gradual(j)) return;
      const double limit = std::sqrt(std::min(limits_[i], limits_[j])) - 1;
      const double length = (domain.current(j) - domain.current(i)).norm();
      largest = std::max(largest, (length / (domain.reference(j) - domain.reference(i)).norm() - 1) / limit);
    });
  }
  return domain.communicator.max(largest);
}

void Fracture::mark_all_for_check(const Body& body) {
  next_checks_.assign(body.domain.families.lists.count(), never);
  for (std::size_t c = 0; c < next_checks_.size(); ++c) {
    const int i = body.domain.families.lists[static_cast<int>(c)].points[0];
    if (body.may_break(body.domain.cloud.blocks[i])) next_checks_[c] = 0;
  }
}

void Fracture::keep_start(const Body& body) {
  start_.resize(body.domain.sites.size());
  for_each_point(0, static_cast<int>(start_.size()), [&](int i) { start_[i] = body.domain.current(i); });
  start_gradients_ = body.force_states.gradients;
}

bool Fracture::holds_energy(const Body& body, const MaterialBlock& block) const {
  return energies_.any_of(static_cast<std::size_t>(&block - body.blocks.data()));
}

// True if a bond of a cluster is at its limit, to round-off; else sets the travel at which the cluster is checked next.
bool Fracture::is_at_limit(const Body& body, const MaterialBlock& block, int cluster) {
  const Cluster points = body.domain.families.lists[cluster];
  Lanes worst = Lanes::Zero(), load = Lanes::Zero(), slack = Lanes::Constant(never);
  Stretches{body.domain.sites.data(), limits_.data()}.over(
      points, [&worst](std::size_t, const Lanes& square) { worst = worst.max(square); });
  if (holds_energy(body, block)) {
    energies_.over(body, points, start_, [&](std::size_t, const Lanes& of_bond, const Lanes& to_go) {
      load = load.max(of_bond), slack = slack.min(to_go);
    });
  }
  const double most = worst.maxCoeff();
  const double by_stretch = shortest_[cluster] * std::max(0.0, 1 - std::sqrt(most));
  const double by_energy = slack.minCoeff() - travel_.last();  // measured from the start of the step
  next_checks_[cluster] = travel_.of(cluster) + std::max(0.0, std::min(by_stretch, by_energy));
  return std::max(most, load.maxCoeff()) > 1 - round_off;
}

void Fracture::break_bonds(Body& body, Part part, double time, double dt) {
  static Teuchos::Time& timer = phase("Fracture");
  const Timed timed(timer);
  if (!is_checked_) return;
  if (limits_change(body) && part == Part::interior) set_limits(body, time);
  const bool any_fails = std::find(may_fail_.begin(), may_fail_.end(), true) != may_fail_.end();
  if (any_fails && part == Part::interior) take_failed(body);
  if (energies_.any() && part == Part::interior) mark_for_check(body, energies_.take_states(body, travel_.last()));
  std::vector<char> at_limit(next_checks_.size(), 0);
  over_breakable(body, part, [&](const MaterialBlock& block, int first, int last) {
    for_each_point(first, last, [&](int c) {
      if (!is_of(body, block, c)) return;
      if (!limits_change(body) && travel_.of(c) < next_checks_[c]) return;
      at_limit[c] = is_at_limit(body, block, c);
    });
  });
  over_breakable(body, part, [&](MaterialBlock& block, int first, int last) {
    const std::size_t before = affected_.size();
    for (int c = first; c < last; ++c) {
      if (at_limit[c] && is_of(body, block, c)) cut(body, block, c, dt);
    }
    if (block.lattice >= 0 && affected_.size() > before) set_off_stencil(body.domain, block);
  });
}

// Sets for each neighbor of a cluster the members whose bonds to it break; returns a bit for each member concerned.
unsigned Fracture::bonds_to_cut(const Body& body, const MaterialBlock& block, const Cluster& cluster,
                                std::vector<std::uint8_t>& gone) const {
  const unsigned there = (1u << cluster.points.size()) - 1;
  unsigned members = 0;
  gone.assign(cluster.near.size(), 0);
  // load: fraction of the value at which the bond breaks
  const auto take = [&](std::size_t n, const Lanes& load) {
    gone[n] |= static_cast<std::uint8_t>(small::lanes_below_zero(Lanes(1 - load)) & there);
    members |= gone[n];
  };
  Stretches{body.domain.sites.data(), limits_.data()}.over(cluster, take);
  if (holds_energy(body, block)) {
    energies_.over(body, cluster, start_, [&take](std::size_t n, const Lanes& load, const Lanes&) { take(n, load); });
  }
  return members;
}

namespace {

// The families of some members of a cluster.
std::vector<std::vector<int>> families_of(const Cluster& cluster, unsigned members) {
  std::vector<std::vector<int>> families(cluster.points.size());
  for (std::size_t n = 0; n < cluster.near.size(); ++n) {
    for (std::size_t l = 0; l < families.size(); ++l) {
      if (members & cluster.mask[n] & (1u << l)) families[l].push_back(cluster.near[n]);
    }
  }
  return families;
}

}  // namespace

void Fracture::cut(Body& body, MaterialBlock& block, int cluster_number, double dt) {
  Domain& domain = body.domain;
  const Cluster cluster = domain.families.lists[cluster_number];
  std::vector<std::uint8_t> gone;
  const unsigned members = bonds_to_cut(body, block, cluster, gone);
  if (members == 0) return;
  count_in_steps(body, block, cluster, gone, dt);
  const auto at = std::lower_bound(block.points.begin(), block.points.end(), cluster.points[0]);
  const int first = static_cast<int>(at - block.points.begin());
  const StepEnd start{body, start_, true, dt};
  affected_.push_back({static_cast<std::size_t>(&block - body.blocks.data()),
                       cluster_number,
                       first,
                       members,
                       balances_of(block, first, cluster, start),
                       {}});
  if (block.has_springs(ResidualKind::both_gradients)) affected_.back().families = families_of(cluster, members);
  for (std::size_t n = 0; n < gone.size(); ++n) {
    if (gone[n] == 0) continue;
    domain.families.lists.cut(cluster_number, n, gone[n]);
    for (std::size_t l = 0; l < cluster.points.size(); ++l) {
      if (!(gone[n] >> l & 1)) continue;
      domain.families.broken[cluster.points[l]].push_back(cluster.near[n]);
    }
  }
  domain.families.lists.drop_cut(cluster_number);
  for (std::size_t l = 0; l < cluster.points.size(); ++l) {
    if (!(members >> l & 1)) continue;
    const int k = first + static_cast<int>(l), i = cluster.points[l];
    if (block.lattice >= 0) domain.families.off_stencil[i] = 1;
    body.damage[i] = 1 - family_volume(domain, i) / whole_volume_[i];
    if (body.released[i] > 0 || refit_in_step(body, block, k, most_steepness_[i], start)) continue;
    release(body, block, k);
    body.released[i] = 1;
  }
}

// The fraction of the springs of block.points[k] that remains with its stress (springs_fade).
double Fracture::part_of_springs(const Body& body, const MaterialBlock& block, int k) {
  if (body.force_states.tensors[block.points[k]].failed() > 0) return 0;
  const auto part = [&block, k]<class L>(const L& law) {
    if constexpr (materials::softens<L>) return law.part_left(block.state_of<L>(k));
    if constexpr (materials::opens_cracks<L>) return 1 - block.state_of<L>(k).damage;
    return 1.0;
  };
  return std::visit(part, block.material.law);
}

// Counts the energy that the springs of a point lose because it softens or fails; that of springs on both ends'
// gradients is counted when ghosts are current (count_springs).
void Fracture::soften_springs(Body& body, Part part) {
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    const MaterialBlock& block = body.blocks[b];
    const bool fade = springs_fade(block) && is_checked_;
    const bool soften = may_fail_[b] && block.has_springs(ResidualKind::own_gradient);
    if (block.in_rigid_motion || !(fade || soften)) continue;
    const auto [begin, end] = updated_with(block, part);
    for (int k = begin; k < end; ++k) {
      const int i = block.points[k];
      const double left = whole_springs_[i] * part_of_springs(body, block, k);
      double& springs = body.points[i].stabilization;
      if (!(left < springs)) continue;
      if (fade) {
        double& of_bonds = body.force_states.gradients[i].stiffness();
        springs = left, of_bonds = std::min(of_bonds, left);
        continue;
      }
      bonds::with_influence(body.influence, [&](auto weight) {
        const bonds::OfPoint family{{i}, body.domain.families};
        const double square = bonds::squared_residual(family, body.domain.sites.data(), body.points.data(), weight);
        body.fracture_energy[i] += 0.5 * (springs - left) * square * body.domain.volume(i);
      });
      springs = left;
    }
  }
}

void Fracture::count(Body& body, const Affected& one) {
  const StepEnd end{body, start_, false};
  const Cluster cluster = body.domain.families.lists[one.cluster];
  const auto after = balances_of(body.blocks[one.block], one.first, cluster, end);
  for (std::size_t l = 0; l < cluster.points.size(); ++l) {
    if (one.members >> l & 1) body.fracture_energy[cluster.points[l]] += released(one.before[l], after[l]);
  }
}

void Fracture::count_dissipation(Body& body, Part part) {
  for (const Affected& one : affected_) {
    if (one.families.empty()) {
      count(body, one);
      continue;
    }
    const Cluster cluster = body.domain.families.lists[one.cluster];
    for (std::size_t l = 0; l < cluster.points.size(); ++l) {
      if (one.members >> l & 1) body.force_states.tensors[cluster.points[l]].lost_bonds() = 1;
    }
  }
  std::erase_if(affected_, [](const Affected& one) { return one.families.empty(); });
  soften_springs(body, part);
}

void Fracture::count_springs(Body& body) {
  const std::vector<GradientState>& now = body.force_states.gradients;
  const StepEnd start{body, start_, true}, end{body, start_, false};
  count_fading(body, end, start_gradients_);
  for (const Affected& one : affected_) {
    count(body, one);
    const Cluster cluster = body.domain.families.lists[one.cluster];
    const auto families = families_of(cluster, one.members);
    for (std::size_t l = 0; l < cluster.points.size(); ++l) {
      const int i = cluster.points[l];
      const BondWorkBalance before =
          SpringWorkBalance{start, start_gradients_, start_gradients_, now}.of(i, one.families[l]);
      const BondWorkBalance after = SpringWorkBalance{end, now, start_gradients_, now}.of(i, families[l]);
      body.fracture_energy[i] += released(before, after);
    }
  }
  for (const Affected& one : affected_) {
    for (const int i : body.domain.families.lists[one.cluster].points) body.force_states.tensors[i].lost_bonds() = 0;
  }
  affected_.clear();
}

double Fracture::bytes(const Body& body) const {
  return static_cast<double>(limits_.size() * (sizeof(Vector) + 2 * sizeof(double)) +
                             2 * next_checks_.size() * sizeof(double) +
                             whole_volume_.size() * (3 * sizeof(double) + sizeof(std::vector<int>)) +
                             body.force_states.gradients.size() * sizeof(GradientState)) +
         energies_.bytes() + fitted_.bytes() + averaged_.bytes() + travel_.bytes();
}

std::optional<Fracture> fracture_of(Body& body, double time) {
  return body.may_break() ? std::optional<Fracture>(std::in_place, body, time) : std::nullopt;
}

std::int64_t broken_bonds(const Body& body) {
  std::int64_t sum = 0;
  for (const auto& of_point : body.domain.families.broken) sum += static_cast<std::int64_t>(of_point.size());
  return sum;
}

}  // namespace strut

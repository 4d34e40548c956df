#include "contact/contact.hpp"

#include <algorithm>
#include <utility>

#include "base/timing.hpp"
#include "contact/laws/contact_law.hpp"
#include "contact/search/search.hpp"

namespace strut::contact {

namespace {

// The sum of the usual skin distances of two points, in units of the smaller horizon. Points that are not bonded start
// at least one horizon apart, and a pair touches at 0.9 of its initial distance or less. As long as this sum is below
// 0.1, pairs of undeformed material are listed only for fast points, and other pairs only once the material has shrunk
// by the remainder of this tenth.
constexpr double skin_fraction = 0.08;

// A search is made this many steps before a skin distance is used up, because the motion of the next step is a
// forecast, and points that touch in the step after it contribute to the stiffness, too.
constexpr double forecast = 3;

// A search is made only if a point has really used this fraction of its skin distance: the bound `used` also counts
// vibration.
constexpr double most_used = 0.5;

// Factor per step by which the stiffness bound falls after separation: a time step that jumps with every touch does not
// conserve energy.
constexpr double decay = 0.99;

std::vector<int> points_of(const Domain& domain, int first, int second) {
  std::vector<int> points;
  for (int i = 0; i < domain.owned; ++i) {
    if (domain.cloud.blocks[i] == first || domain.cloud.blocks[i] == second) points.push_back(i);
  }
  return points;
}

}  // namespace

Contact::Contact(const std::vector<Interaction>& interactions, const Domain& domain) {
  for (const Interaction& interaction : interactions) {
    const auto [first, second, model] = interaction;
    const bool one_body = domain.blocks[first].body == domain.blocks[second].body;
    const bool by_surfaces = std::holds_alternative<SurfaceLaw>(model.law);
    BlockPair blocks{first, second, one_body, by_surfaces, points_of(domain, first, second)};
    const double horizon = std::min(domain.blocks[first].smallest, domain.blocks[second].smallest);
    contact_pairs_.push_back({model, std::move(blocks), skin_fraction / 2 * horizon});
    ContactPair& added = contact_pairs_.back();
    if (by_surfaces) added.surfaces.emplace(domain, added.blocks, std::get<SurfaceLaw>(model.law));
  }
}

// Numbers of broken bonds of blocks.points when ranks last agreed; empty between bodies, or if no bonds may break.
BrokenCounts Contact::broken_of(const Domain& domain, const BlockPair& blocks) const {
  BrokenCounts counts;
  const auto& broken = domain.families.broken;
  if (!blocks.one_body || broken.empty()) return counts;
  for (const int i : blocks.points) counts.push_back(broken_before_.empty() ? broken[i].size() : broken_before_[i]);
  return counts;
}

void Contact::search(const Kinematics& kinematics, double dt, ContactPair& contact_pair) {
  const BlockPair& blocks = contact_pair.blocks;
  contact_pair.places.clear();
  for (const int i : blocks.points) contact_pair.places.push_back(kinematics.domain.current(i));
  contact_pair.skins = skin_distances_by_speed(kinematics, blocks, contact_pair.mean_velocity, contact_pair.skin, dt);
  const double radius = radius_of(contact_pair.model.law);
  if (contact_pair.searched) contact_pair.pressed = pressed_pairs(contact_pair.pairs);
  contact_pair.pairs = find_pairs(kinematics, blocks, radius, contact_pair.skins, broken_before_);
  if (contact_pair.model.friction > 0) contact_pair.couples.take(kinematics.domain, contact_pair.pairs.owned);
  contact_pair.frame = frame_of(kinematics, blocks, contact_pair.pairs);
  contact_pair.searched = true;
  contact_pair.meets = false;
  const BrokenCounts before = std::exchange(contact_pair.broken_counts, broken_of(kinematics.domain, blocks));
  const Domain& domain = kinematics.domain;
  if (contact_pair.surfaces) {
    contact_pair.surfaces->take(domain, blocks, before, contact_pair.broken_counts, contact_pair.pairs);
  } else {
    set_limits(domain, blocks, radius, before, contact_pair.broken_counts, contact_pair.pressed, contact_pair.pairs);
  }
  contact_pair.used = 0;
  contact_pair.result = {};
  contact_pair.loads.clear();
  contact_pair.friction.clear();
  ++searches_;
}

// Collective. The bound `used` grows with every vibration, so the distance that points have really moved is computed
// before a search, which costs many times as much.
void Contact::check(const Kinematics& kinematics, double dt, ContactPair& contact_pair) {
  static Teuchos::Time& timer = phase("Contact search");
  const Timed timed(timer);
  contact_pair.check_pending = false;
  if (!contact_pair.searched) contact_pair.frame = frame_of(kinematics, contact_pair.blocks, contact_pair.pairs);
  contact_pair.mean_velocity = mean_velocity(kinematics, contact_pair.blocks, contact_pair.frame);
  if (contact_pair.searched)
    contact_pair.used =
        part_used(kinematics, contact_pair.blocks, contact_pair.frame, contact_pair.places, contact_pair.skins);
  if (!contact_pair.searched || contact_pair.meets || contact_pair.used > most_used) {
    search(kinematics, dt, contact_pair);
  }
}

// True if points whose bonds broke since the last search are about to touch: that search has excluded them, and they
// may be nearer to each other than two skin distances. Blocks are ignored, because those of ghosts are unknown.
bool Contact::breaks_meet(const Kinematics& kinematics, const ContactPair& contact_pair) {
  constexpr double about_to_touch = 1.05;
  const Domain& domain = kinematics.domain;
  const double radius = radius_of(contact_pair.model.law);
  for (std::size_t k = 0; k < contact_pair.broken_counts.size(); ++k) {
    const int i = contact_pair.blocks.points[k];
    const std::vector<int>& broken = domain.families.broken[i];
    for (std::size_t n = contact_pair.broken_counts[k]; n < broken.size(); ++n) {
      const double apart = (domain.reference(broken[n]) - domain.reference(i)).norm();
      const double touch = about_to_touch * largest_touching_distance(radius, apart, true);
      if ((domain.current(broken[n]) - domain.current(i)).norm() < touch) return true;
    }
  }
  return false;
}

void Contact::check_where_pending(const Kinematics& kinematics, double dt) {
  const int before = searches_;
  for (ContactPair& contact_pair : contact_pairs_) {
    if (contact_pair.check_pending) check(kinematics, dt, contact_pair);
  }
  if (searches_ > before) find_points_of_several();
}

// ---- Points that touch points of several blocks --------------------------------------------------------------------
// The bound of the step and the friction on a point do not depend on how the other body is divided into blocks.

void Contact::find_points_of_several() {
  for (ContactPair& one : contact_pairs_) {
    one.elsewhere.clear();
    for (std::size_t n = 0; n < contact_pairs_.size(); ++n) {
      const ContactPair& other = contact_pairs_[n];
      if (&one == &other || one.surfaces || other.surfaces) continue;
      const std::vector<int>&mine = one.pairs.owned, &others = other.pairs.owned;  // both ascending
      for (std::size_t k = 0, l = 0; k < mine.size(); ++k) {
        while (l < others.size() && others[l] < mine[k]) ++l;
        if (l < others.size() && others[l] == mine[k]) one.elsewhere.push_back({k, n, l});
      }
    }
  }
}

namespace {

bool of_same_bodies(const Domain& domain, const BlockPair& one, const BlockPair& other) {
  const auto bodies = [&domain](const BlockPair& pair) {
    return std::minmax(domain.blocks[pair.first].body, domain.blocks[pair.second].body);
  };
  return bodies(one) == bodies(other);
}

}  // namespace

// If any point touches several blocks, the sums of the loads of all contact pairs on each point, else empty: all
// springs hold it at once, so that the stiffness bound includes them, all its contacts share the impulse that stops its
// sliding, and all blocks of the other body push its surface.
std::vector<Load> Contact::joined_loads(const Domain& domain, ContactPair& contact_pair) const {
  if (contact_pair.elsewhere.empty()) return {};
  std::vector<Load> loads = contact_pair.loads;
  for (const auto& [k, pair, there] : contact_pair.elsewhere) {
    const ContactPair& other = contact_pairs_[pair];
    const Load& more = other.loads[there];
    loads[k].springs += more.springs;
    if (contact_pair.loads[k].contacts == 0) continue;
    if (other.model.friction > 0) loads[k].contacts += more.contacts;
    if (of_same_bodies(domain, contact_pair.blocks, other.blocks)) loads[k].push += more.push;
  }
  double& stiffness = contact_pair.result.stiffness;
  for (const Load& load : loads) stiffness = std::max(stiffness, largest_eigenvalue(load.springs, stiffness));
  return loads;
}

void Contact::add_normal_forces(const Kinematics& kinematics, double dt, ContactPair& contact_pair,
                                std::vector<Vector>& force_density) {
  Pairs& pairs = contact_pair.pairs;
  if (contact_pair.surfaces) {
    const auto& law = std::get<SurfaceLaw>(contact_pair.model.law);
    contact_pair.result = contact_pair.surfaces->add_normal_forces(kinematics, law, dt == 0, pairs, force_density);
  } else {
    const auto& law = std::get<PairLaw>(contact_pair.model.law);
    contact_pair.result = contact::add_normal_forces(kinematics, dt, law, pairs, force_density, contact_pair.loads);
  }
}

void Contact::add_friction(const Kinematics& kinematics, double dt, const Sliding& sliding,
                           const std::vector<Load>& loads, ContactPair& contact_pair,
                           std::vector<Vector>& force_density) {
  Pairs& pairs = contact_pair.pairs;
  const Model& model = contact_pair.model;
  if (contact_pair.surfaces) {
    const auto& law = std::get<SurfaceLaw>(model.law);
    contact_pair.surfaces->add_friction(kinematics, sliding, law, model.friction, pairs, contact_pair.couples,
                                        force_density, contact_pair.friction);
  } else {
    const auto& law = std::get<PairLaw>(model.law);
    contact::add_friction(kinematics, law, model.friction, dt, pairs, loads, contact_pair.couples, force_density,
                          contact_pair.friction);
  }
}

void Contact::add_forces(const Kinematics& kinematics, double dt, const Sliding& sliding,
                         std::vector<Vector>& force_density) {
  static Teuchos::Time& timer = phase("Contact forces");
  const Timed timed(timer);
  const auto may_touch = [](const ContactPair& pair) {
    return !pair.pairs.empty() || pair.pairs.halo || pair.couples.any();
  };
  for (ContactPair& pair : contact_pairs_) {
    if (may_touch(pair)) add_normal_forces(kinematics, dt, pair, force_density);
  }
  for (ContactPair& pair : contact_pairs_) {
    const std::vector<Load> of_all = joined_loads(kinematics.domain, pair);
    const bool rubs = pair.model.friction > 0 && (dt > 0 || sliding.is_trial);
    const std::vector<Load>& loads = of_all.empty() ? pair.loads : of_all;
    if (rubs && may_touch(pair)) add_friction(kinematics, dt, sliding, loads, pair, force_density);
  }
}

void Contact::add_forces(const Kinematics& kinematics, double dt, std::vector<Vector>& force_density) {
  if (!any()) return;
  check_where_pending(kinematics, dt);
  add_forces(kinematics, dt, {kinematics.velocities, dt}, force_density);
}

void Contact::foresee(const Kinematics& kinematics, double dt) {
  std::vector<Vector> forces(kinematics.domain.owned, Vector::Zero());  // those at the present positions are known
  for (ContactPair& pair : contact_pairs_) {
    const bool of_points = !pair.surfaces && (!pair.pairs.empty() || pair.pairs.halo);
    if (of_points) add_normal_forces(kinematics, dt, pair, forces);
  }
  for (ContactPair& pair : contact_pairs_) {
    if (pair.surfaces) continue;
    joined_loads(kinematics.domain, pair);
    stiffness_ = std::max(stiffness_, pair.result.stiffness);
  }
  if (any()) stiffness_ = kinematics.domain.communicator.max(stiffness_);
}

void Contact::add_trial_forces(const Kinematics& kinematics, std::span<const Vector> increments,
                               std::vector<Vector>& force_density) {
  if (!any()) return;
  check_where_pending(kinematics, 0);
  add_forces(kinematics, 0, {.of = increments, .is_trial = true}, force_density);
}

double Contact::friction_work_of_trial(std::span<const Vector> increments) const {
  double work = 0;
  for (const ContactPair& pair : contact_pairs_) {
    if (pair.surfaces) work += pair.surfaces->friction_work(pair.pairs, pair.friction, increments);
  }
  return work;
}

void Contact::commit() {
  for (ContactPair& pair : contact_pairs_) {
    if (pair.surfaces && pair.model.friction > 0) pair.surfaces->commit(pair.friction);
  }
}

void Contact::add_stiffness(std::span<const Vector> field, std::span<Vector> result) {
  for (ContactPair& contact_pair : contact_pairs_) {
    if (contact_pair.pairs.empty() && !contact_pair.pairs.halo) continue;
    if (contact_pair.surfaces) {
      contact_pair.surfaces->add_stiffness(contact_pair.pairs, field, result);
    } else {
      contact::add_stiffness(std::get<PairLaw>(contact_pair.model.law), contact_pair.pairs, field, result);
    }
  }
}

void Contact::add_springs(std::span<Tensor> springs) const {
  for (const ContactPair& contact_pair : contact_pairs_) {
    if (contact_pair.surfaces) {
      contact_pair.surfaces->add_springs(contact_pair.pairs, springs);
    } else {
      contact::add_springs(std::get<PairLaw>(contact_pair.model.law), contact_pair.pairs, springs);
    }
  }
}

void Contact::append_to_agree(const Kinematics& kinematics, std::vector<double>& numbers) {
  if (!any()) return;
  for (const ContactPair& contact_pair : contact_pairs_) {
    numbers.push_back(contact_pair.result.stiffness);
    numbers.push_back(breaks_meet(kinematics, contact_pair));
    numbers.push_back(largest_use(kinematics, contact_pair.blocks, contact_pair.mean_velocity, contact_pair.skins));
  }
  numbers.push_back(deepest().penetration);
  count_broken(kinematics.domain);
}

void Contact::count_broken(const Domain& domain) {
  broken_before_.clear();
  for (const auto& of_point : domain.families.broken) broken_before_.push_back(of_point.size());
}

void Contact::take_agreed(std::span<const double> numbers, double dt) {
  if (!any()) return;
  double of_points = 0, of_surfaces = 0;  // ω² of a sum of operators is at most the sum of theirs
  for (std::size_t m = 0; m < contact_pairs_.size(); ++m) {
    ContactPair& contact_pair = contact_pairs_[m];
    if (contact_pair.surfaces) {
      of_surfaces += numbers[3 * m];
    } else {
      of_points = std::max(of_points, numbers[3 * m]);  // includes all blocks that a point touches
    }
    contact_pair.meets = numbers[3 * m + 1] > 0;
    const double use = dt * numbers[3 * m + 2];
    contact_pair.used += use;
    contact_pair.check_pending =
        !contact_pair.searched || contact_pair.meets || !(contact_pair.used + forecast * use < 1);
  }
  stiffness_ = std::max(of_points + of_surfaces, decay * stiffness_);
  penetration_ = numbers.back();
}

void Contact::serialize(Archive& archive, const Kinematics& kinematics, double dt) {
  archive.number("contact_stiffness", stiffness_);
  archive.number("penetration", penetration_);
  archive.number("searches", searches_);
  const Domain& domain = kinematics.domain;
  // A rank without points cannot tell by itself whether bonds may break.
  const bool any_may_break = any() && domain.communicator.any(!domain.families.broken.empty());
  for (std::size_t m = 0; m < contact_pairs_.size(); ++m) {
    ContactPair& pair = contact_pairs_[m];
    const bool may_break = pair.blocks.one_body && any_may_break;
    const bool rubs = pair.surfaces && pair.model.friction > 0, had_a_start = pair.surfaces && !pair.blocks.one_body;
    if (!may_break && !rubs && !had_a_start) continue;
    std::vector<std::int64_t> ids;
    for (const int i : pair.blocks.points) ids.push_back(domain.id(i));
    archive.points("contact_" + std::to_string(m), ids);
    if (may_break) serialize_breaks(archive, domain, pair);
    if (had_a_start) pair.surfaces->serialize_start(archive);
    if (pair.surfaces && (may_break || rubs)) pair.surfaces->serialize(archive, may_break);
  }
  if (archive.loading()) restore(kinematics, dt);
}

// Bonds that have broken since the last search count in the next one only.
void Contact::serialize_breaks(Archive& archive, const Domain& domain, ContactPair& pair) {
  pair.broken_counts.resize(pair.blocks.points.size(), 0);
  archive.field("broken_at_search", 1, [&pair](std::size_t k, int) -> std::size_t& { return pair.broken_counts[k]; });
  if (pair.surfaces) return;
  if (pair.searched) pair.pressed = pressed_pairs(pair.pairs);
  contact::serialize(archive, domain, pair.blocks, pair.pressed);
}

// Restores pairs and friction; the solver has the forces.
void Contact::restore(const Kinematics& kinematics, double dt) {
  const Domain& domain = kinematics.domain;
  count_broken(domain);
  for (ContactPair& pair : contact_pairs_) {
    for (std::size_t k = 0; k < pair.broken_counts.size(); ++k) {
      broken_before_[pair.blocks.points[k]] = pair.broken_counts[k];
    }
    pair.searched = false;
    check(kinematics, dt, pair);
  }
  find_points_of_several();
  count_broken(domain);
  std::vector<Vector> forces(domain.owned, Vector::Zero());
  add_forces(kinematics, dt, forces);
  for (ContactPair& pair : contact_pairs_) {
    pair.meets = domain.communicator.any(breaks_meet(kinematics, pair));
    pair.check_pending = true;  // the use of the skin distances in the next step is unknown
    // An equilibrium has no time step from which to recompute friction: it is that of the last commit.
    const bool rubs = pair.surfaces && pair.model.friction > 0;
    if (rubs && dt == 0) pair.friction = pair.surfaces->committed_friction();
  }
}

}  // namespace strut::contact

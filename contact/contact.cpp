#include "contact/contact.hpp"

#include <algorithm>

#include "base/timing.hpp"

namespace strut::contact {

namespace {

// The usual skins of a pair together, in units of the smaller horizon. Points that are not bonded start at least a
// horizon apart, and a pair touches at 0.9 of its distance at the most: with less than a tenth, no pair of undeformed
// material is in a list but those of fast points, and what is left of the tenth is the strain at which others get
// there.
constexpr double skin_share = 0.08;

// A search is due this many steps before a skin is used up, since the motion of the next step is a forecast.
constexpr double forecast = 2;

// A search is made where a point has really used this part of its skin; by the bound it often only trembles.
constexpr double most_used = 0.5;

// The bound of the stiffness falls so slowly after points have parted: a step that jumps with every touch costs energy.
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
    Parties parties{first, second, one_body, points_of(domain, first, second)};
    const double horizon = std::min(domain.blocks[first].smallest, domain.blocks[second].smallest);
    meetings_.push_back({model, std::move(parties), skin_share / 2 * horizon});
  }
}

void Contact::search(const Crowd& crowd, double dt, Meeting& meeting) {
  const Parties& parties = meeting.parties;
  meeting.places.clear();
  for (const int i : parties.points) meeting.places.push_back(crowd.domain.current(i));
  meeting.skins = skins_by_speed(crowd, parties, meeting.mean_velocity, meeting.skin, dt);
  meeting.pairs = find_pairs(crowd, parties, meeting.model, meeting.skins);
  meeting.frame = frame_of(crowd, parties, meeting.pairs);
  meeting.searched = true;
  meeting.used = 0;
  meeting.tally = {};
  meeting.friction.clear();
  ++searches_;
}

// Collective. The bound grows with every tremble. How far points have really gone is looked at before a search, which
// costs many times as much.
void Contact::look(const Crowd& crowd, double dt, Meeting& meeting) {
  static Teuchos::Time& timer = phase("Contact search");
  const Timed timed(timer);
  meeting.due = false;
  if (!meeting.searched) meeting.frame = frame_of(crowd, meeting.parties, meeting.pairs);
  meeting.mean_velocity = mean_velocity(crowd, meeting.parties, meeting.frame);
  if (meeting.searched) meeting.used = part_used(crowd, meeting.parties, meeting.frame, meeting.places, meeting.skins);
  if (!meeting.searched || meeting.used > most_used) search(crowd, dt, meeting);
}

void Contact::add_forces(const Crowd& crowd, double dt, Meeting& meeting, std::vector<Vector>& force_density) {
  Pairs& pairs = meeting.pairs;
  if (pairs.empty() && !pairs.halo) return;
  static Teuchos::Time& timer = phase("Contact forces");
  const Timed timed(timer);
  const Model& model = meeting.model;
  meeting.tally = add_normal_forces(crowd, model, pairs, force_density);
  if (model.friction > 0 && dt > 0) add_friction(crowd, model, dt, pairs, force_density, meeting.friction);
}

void Contact::add_forces(const Crowd& crowd, double dt, std::vector<Vector>& force_density) {
  for (Meeting& meeting : meetings_) {
    if (meeting.due) look(crowd, dt, meeting);
    add_forces(crowd, dt, meeting, force_density);
  }
}

void Contact::add_stiffness(std::span<const Vector> field, std::span<Vector> result) {
  for (Meeting& meeting : meetings_) {
    if (meeting.pairs.empty() && !meeting.pairs.halo) continue;
    contact::add_stiffness(meeting.model, meeting.pairs, field, result);
  }
}

void Contact::add_springs(std::span<Tensor> springs) const {
  for (const Meeting& meeting : meetings_) contact::add_springs(meeting.model, meeting.pairs, springs);
}

void Contact::append_to_agree(const Crowd& crowd, std::vector<double>& numbers) const {
  if (!any()) return;
  for (const Meeting& meeting : meetings_) {
    numbers.push_back(meeting.tally.stiffness);
    numbers.push_back(largest_use(crowd, meeting.parties, meeting.mean_velocity, meeting.skins));
  }
  numbers.push_back(deepest().penetration);
}

void Contact::take_agreed(std::span<const double> numbers, double dt) {
  if (!any()) return;
  double stiffness = 0;  // ω² of a sum of operators is at most the sum of theirs
  for (std::size_t m = 0; m < meetings_.size(); ++m) {
    Meeting& meeting = meetings_[m];
    stiffness += numbers[2 * m];
    const double use = dt * numbers[2 * m + 1];
    meeting.used += use;
    meeting.due = !meeting.searched || !(meeting.used + forecast * use < 1);
  }
  stiffness_ = std::max(stiffness, decay * stiffness_);
  penetration_ = numbers.back();
}

void Contact::keep(Archive& archive, const Crowd& crowd, double dt) {
  archive.number("contact_stiffness", stiffness_);
  archive.number("penetration", penetration_);
  if (!archive.restores()) return;
  std::vector<Vector> forces(crowd.domain.owned, Vector::Zero());  // the solver has them; here are pairs and friction
  for (Meeting& meeting : meetings_) meeting.searched = false, meeting.due = true;
  add_forces(crowd, dt, forces);
  for (Meeting& meeting : meetings_) meeting.due = true;  // how far points may go in the next step, nobody has asked
}

double Contact::energy() const {
  double sum = 0;
  for (const Meeting& meeting : meetings_) sum += meeting.tally.energy;
  return sum;
}

Deepest Contact::deepest() const {
  Deepest deepest;
  for (const Meeting& meeting : meetings_) deepest.take(meeting.tally.deepest);
  return deepest;
}

FrictionWork Contact::friction_work(double kick, std::span<const Vector> before, std::span<const Vector> after) const {
  FrictionWork work;
  for (const Meeting& meeting : meetings_) {
    for (std::size_t k = 0; k < meeting.friction.size(); ++k) {
      const int i = meeting.pairs.owned[k];
      work.before += 0.5 * kick * meeting.friction[k].dot(before[i]);
      work.after += 0.5 * kick * meeting.friction[k].dot(after[i]);
    }
  }
  return work;
}

}  // namespace strut::contact

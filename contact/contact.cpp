#include "contact/contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/timing.hpp"

namespace strut::contact {

namespace {

// The skin in units of the smaller horizon. Points that are not bonded start at least a horizon apart, and a pair
// touches at 0.9 of its distance at the most: with less than a tenth, no pair of undeformed material is in a list.
constexpr double skin_share = 0.09;

// A search is due this many steps before the skin is used up, since the motion of the next step is a forecast.
constexpr double forecast = 2;

// The bound of the stiffness falls so slowly after points have parted: a step that jumps with every touch costs energy.
constexpr double decay = 0.99;

// Of this share of the points a new search of all costs about as much as one about single ones.
constexpr double most_moved = 0.05;

// The mean motion of points is that of one in so many: any that is the same on all ranks will do.
constexpr std::size_t sampling = 16;

std::vector<int> points_of(const Domain& domain, int first, int second) {
  std::vector<int> points;
  for (int i = 0; i < domain.owned; ++i) {
    if (domain.cloud.blocks[i] == first || domain.cloud.blocks[i] == second) points.push_back(i);
  }
  return points;
}

// How far some vectors reach along +x, +y, +z, −x, −y, −z: their bounding box, in a form whose union is a maximum.
struct Reach {
  double along[6];

  Reach() { std::fill(std::begin(along), std::end(along), -std::numeric_limits<double>::infinity()); }
  void add(const Vector& v) {
    for (int c = 0; c < 3; ++c) {
      along[c] = std::max(along[c], v[c]);
      along[3 + c] = std::max(along[3 + c], -v[c]);
    }
  }
};

// The diagonal of the box that holds both: no two of the vectors differ by more.
double diagonal(const double* one, const double* other) {
  double square = 0;
  for (int c = 0; c < 3; ++c) {
    const double width = std::max(one[c], other[c]) + std::max(one[3 + c], other[3 + c]);
    if (width > 0) square += width * width;  // a box of nothing is turned inside out
  }
  return std::sqrt(square);
}

Vector place(const Crowd& crowd, int i) { return crowd.sites[i].current.head<3>().matrix(); }

}  // namespace

Contact::Contact(const std::vector<Interaction>& interactions, const Domain& domain) {
  for (const Interaction& interaction : interactions) {
    const auto [first, second, model] = interaction;
    const bool one_body = domain.blocks[first].body == domain.blocks[second].body;
    Parties parties{first, second, one_body, points_of(domain, first, second)};
    const double horizon = std::min(domain.blocks[first].smallest, domain.blocks[second].smallest);
    meetings_.push_back({model, std::move(parties), skin_share * horizon});
    blocks_.insert(blocks_.end(), {first, second});
  }
  std::sort(blocks_.begin(), blocks_.end());
  blocks_.erase(std::unique(blocks_.begin(), blocks_.end()), blocks_.end());
}

void Contact::search(const Crowd& crowd, Meeting& meeting) {
  const Model& model = meeting.model;
  meeting.places.clear();
  for (const int i : meeting.parties.points) meeting.places.push_back(place(crowd, i));
  const double gap = meeting.parties.self() ? 0 : distance_of_boxes(crowd, meeting.parties, meeting.places);
  meeting.far = gap > model.radius + meeting.skin;
  meeting.pairs = meeting.far ? Pairs{} : find_pairs(crowd, meeting.parties, meeting.places, model, meeting.skin);
  meeting.allowance = meeting.far ? gap - model.radius : meeting.skin;
  meeting.travelled = 0;
  meeting.tally = {};
  meeting.friction.clear();
  ++searches_;
}

// Collective. The bound grows with the fastest points, which often only tremble, or are few. How far points have really
// gone is looked at before a search, which costs a hundred times as much: only those that have gone a quarter of the
// allowance, beside the mean of all, need one. While no other has gone farther, half the allowance is left.
void Contact::look(const Crowd& crowd, Meeting& meeting) {
  static Teuchos::Time& timer = phase("Contact search");
  const Timed timed(timer);
  const std::vector<int>& points = meeting.parties.points;
  double sums[] = {static_cast<double>(points.size()), static_cast<double>(meeting.places.size()), 0, 0, 0, 0};
  for (std::size_t k = 0; k < meeting.places.size(); k += sampling) {
    const Vector way = place(crowd, points[k]) - meeting.places[k];
    for (int c = 0; c < 3; ++c) sums[2 + c] += way[c];
    ++sums[5];
  }
  crowd.domain.communicator.sum(sums);
  if (sums[1] < sums[0]) return search(crowd, meeting);  // the first time
  const Vector mean = Vector(sums[2], sums[3], sums[4]) / std::max(1.0, sums[5]);
  std::vector<int> moved;
  double farthest[] = {0};  // of the others
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double way = (place(crowd, points[k]) - meeting.places[k] - mean).norm();
    if (way <= 0.25 * meeting.allowance) {
      farthest[0] = std::max(farthest[0], way);
    } else {
      moved.push_back(static_cast<int>(k));
    }
  }
  const auto all_moved = crowd.domain.communicator.sum(static_cast<std::int64_t>(moved.size()));
  if (all_moved > 0 && (meeting.far || all_moved > most_moved * sums[0])) return search(crowd, meeting);
  crowd.domain.communicator.max(farthest);
  meeting.travelled = 2 * farthest[0];
  if (all_moved == 0) return;
  for (const int k : moved) meeting.places[k] = place(crowd, points[k]) - mean;
  renew_pairs(crowd, meeting.parties, meeting.places, moved, meeting.model, meeting.skin, meeting.pairs);
  meeting.friction.clear();
  ++renewals_;
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
    if (meeting.due) look(crowd, meeting);
    meeting.due = false;
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
  for (const Meeting& meeting : meetings_) numbers.push_back(meeting.tally.stiffness);
  std::vector<Reach> reaches(crowd.domain.blocks.size());
  for (int i = 0; i < crowd.domain.owned; ++i) reaches[crowd.domain.cloud.blocks[i]].add(crowd.velocities[i]);
  for (const int block : blocks_) {
    numbers.insert(numbers.end(), std::begin(reaches[block].along), std::end(reaches[block].along));
  }
  numbers.push_back(deepest().penetration);
}

void Contact::take_agreed(std::span<const double> numbers, double dt) {
  if (!any()) return;
  double stiffness = 0;  // ω² of a sum of operators is at most the sum of theirs
  for (std::size_t m = 0; m < meetings_.size(); ++m) stiffness += numbers[m];
  stiffness_ = std::max(stiffness, decay * stiffness_);
  penetration_ = numbers.back();
  const auto reach = [&](int block) {
    const auto at = std::find(blocks_.begin(), blocks_.end(), block) - blocks_.begin();
    return numbers.data() + meetings_.size() + 6 * at;
  };
  for (Meeting& meeting : meetings_) {
    const double motion = dt * diagonal(reach(meeting.parties.first), reach(meeting.parties.second));
    meeting.travelled += motion;
    meeting.due = !(meeting.travelled + forecast * motion < meeting.allowance);
  }
}

void Contact::keep(Archive& archive, const Crowd& crowd, double dt) {
  archive.number("contact_stiffness", stiffness_);
  archive.number("penetration", penetration_);
  if (!archive.restores()) return;
  std::vector<Vector> forces(crowd.domain.owned, Vector::Zero());  // the solver has them; here are pairs and friction
  for (Meeting& meeting : meetings_) meeting.due = true;
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

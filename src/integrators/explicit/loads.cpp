#include "integrators/explicit/loads.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <utility>

namespace strut {

namespace {

bool move_rigidly(const Body& body, const std::vector<std::size_t>& blocks) {
  return std::ranges::all_of(blocks, [&](std::size_t b) { return body.blocks[b].in_rigid_motion; });
}

}  // namespace

Loads::Loads(const Conditions& conditions) : change_(depend_on_time(conditions, Stage::forces)) {
  conditions.visit([this](const AddsForces auto& one) { loads_.emplace_back().condition.add(one); });
  regroup();
}

void Loads::take_levels(const Body& body, const std::optional<Levels>& before, const Levels& after, int highest) {
  if (loads_.empty()) return;
  highest_ = highest, before_ = before, after_ = after;
  after_.resize(body.owned(), 0);
  if (before_) before_->resize(body.owned(), 0);
  for (Load& load : loads_) {
    if (highest > 0) std::tie(load.is_on_wholes, load.blocks) = extent_of(load.condition, body);
  }
  regroup();
}

// Puts the points of loads into groups of equal steps.
void Loads::regroup() {
  groups_.clear(), now_.clear();
  for (const Load& load : loads_) {
    const bool of_whole_steps = (load.was_whole && load.is_whole) || (highest_ == 0 && !before_);
    std::map<std::pair<int, int>, Levels> members;  // marks, by the levels before and after
    for (std::size_t i = 0; !of_whole_steps && i < after_.size(); ++i) {
      const int first = load.was_whole ? 0 : (before_ ? *before_ : after_)[i], last = load.is_whole ? 0 : after_[i];
      Levels& marks = members[{first, last}];
      marks.resize(after_.size(), 0);
      marks[i] = 1;
    }
    if (of_whole_steps) groups_.push_back({0, 0, load.condition});
    for (const auto& [levels, marks] : members)
      groups_.push_back({levels.first, levels.second, loads_on(load.condition, {marks, 1})});
  }
}

Loads::Impulse Loads::impulse(const Group& group, const Moment& moment) const {
  const double first = std::ldexp(moment.before, -(moment.level > 0 ? group.after : group.before)),
               last = std::ldexp(moment.after, -group.after);
  Impulse found{&group.loads, {moment.time}, std::ldexp((first + last) / (moment.before + moment.after), moment.level)};
  const int count = change_ && highest_ > group.after ? 1 << (highest_ - group.after) : 1;
  if (count == 1) return found;
  const double begin = moment.time - 0.5 * first, end = std::min(moment.time + 0.5 * last, moment.end);
  found.times.clear(), found.part /= count;
  for (int n = 0; n < count; ++n) found.times.push_back(begin + (n + 0.5) / count * (end - begin));
  return found;
}

void Loads::add(const Moment& moment, Body& body) {
  if (moment.level == 0 && highest_ > 0) {
    bool changes = false;
    for (Load& load : loads_) {
      const bool whole = load.is_on_wholes && move_rigidly(body, load.blocks);
      changes |= std::exchange(load.is_whole, whole) != whole;
    }
    if (changes) regroup();
  }
  now_.clear();
  for (const Group& group : groups_) {
    if (group.after >= moment.level) now_.push_back(impulse(group, moment));
  }
  for (const Impulse& one : now_) {
    for (const double t : one.times) add_forces(*one.loads, t, one.part, body);
  }
}

void Loads::add_work(double impulse_time, const Body& body, ImpulseWork& work) const {
  for (const Impulse& one : now_) {
    for (const double t : one.times) add_work_of_forces(*one.loads, t, one.part * impulse_time, body, work);
  }
}

void Loads::end_whole_step() {
  before_.reset();
  for (Load& load : loads_) load.was_whole = load.is_whole;
  for (Group& group : groups_) group.before = group.after;
}

void Loads::serialize(Archive& archive, const Body& body) {
  if (loads_.empty()) return;
  for (std::size_t n = 0; n < loads_.size(); ++n)
    archive.number("load_" + std::to_string(n) + "_in_whole_steps", loads_[n].was_whole);
  bool differ = body.domain.communicator.any(before_.has_value());
  Levels before = before_.value_or(Levels());
  before.resize(body.owned(), 0);
  archive.number("load_levels_differ", differ);
  archive.field("load_levels_before", 1, [&](std::size_t i, int) -> std::uint8_t& { return before[i]; });
  if (!archive.loading()) return;
  before_.reset();
  if (differ) before_ = std::move(before);
}

}  // namespace strut

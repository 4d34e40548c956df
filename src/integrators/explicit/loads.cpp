#include "integrators/explicit/loads.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace strut {

Loads::Loads(const Conditions& conditions) : change_(depend_on_time(conditions, Stage::forces)) {
  conditions.visit([this](const AddsForces auto& one) { conditions_.add(one); });
  even_ = {0, 0, conditions_};
}

void Loads::take_levels(const Body& body, const std::optional<Levels>& before, const Levels& after, int highest) {
  if (conditions_.count() == 0) return;
  highest_ = highest;
  groups_.clear(), now_.clear();
  before_ = before;
  even_.loads = conditions_;
  if (highest == 0 && !before) return;
  Conditions parts;
  std::tie(even_.loads, parts) = loads_on_wholes_and_parts(conditions_, body);
  const auto level = [](const Levels& levels, int i) { return levels.empty() ? 0 : levels[i]; };
  std::map<std::pair<int, int>, Levels> members;  // marks, by the levels before and after
  for (int i = 0; i < body.owned(); ++i) {
    Levels& marks = members[{level(before ? *before : after, i), level(after, i)}];
    marks.resize(body.owned(), 0);
    marks[i] = 1;
  }
  for (const auto& [levels, marks] : members)
    groups_.push_back({levels.first, levels.second, loads_on(parts, {marks, 1})});
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
  now_.clear();
  if (moment.level == 0) now_.push_back(impulse(even_, moment));
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
  for (Group& group : groups_) group.before = group.after;
}

void Loads::serialize(Archive& archive, const Body& body) {
  bool differ = body.domain.communicator.any(before_.has_value());
  archive.number("load_levels_differ", differ);
  if (!differ) return before_.reset();
  if (!before_) before_.emplace();
  before_->resize(body.owned(), 0);
  archive.field("load_levels_before", 1, [&](std::size_t i, int) -> std::uint8_t& { return (*before_)[i]; });
}

}  // namespace strut

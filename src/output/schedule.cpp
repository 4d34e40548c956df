#include "output/schedule.hpp"

#include <cmath>

namespace strut {

namespace {
constexpr double round_off = 1e-9;  // of the interval: times are sums of steps
}

Schedule::Schedule(bool enabled, std::optional<int> frequency, std::optional<double> interval, double initial_time)
    : enabled_(enabled),
      frequency_(frequency),
      interval_(interval),
      initial_time_(initial_time),
      next_time_(initial_time) {}

bool Schedule::is_scheduled(int step, double time) const {
  if (!enabled_) return false;
  if (time == pending_at_) return true;
  if (frequency_) return step % *frequency_ == 0;
  return interval_ && time >= next_time_ - round_off * *interval_;
}

void Schedule::serialize(Archive& archive, const std::string& name, int step, double time) {
  double interval = interval_.value_or(0), next = next_time_;
  double pending_at = !enabled_ ? pending_at_ : is_scheduled(step, time) ? time : never;
  archive.number(name + "_interval", interval);
  archive.number(name + "_next", next);
  archive.number(name + "_due_at", pending_at);
  if (!archive.loading()) return;
  pending_at_ = !enabled_ && pending_at == never ? time : pending_at;  // the last time of a run has output, due or not
  if (enabled_ && pending_at != never && pending_at < time) uncounted_ = pending_at;
  if (interval == interval_.value_or(0)) {
    next_time_ = next;
  } else {
    done(time);
  }
}

void Schedule::done(double time) {
  if (!interval_) return;
  const double passed = std::floor((time - initial_time_) / *interval_ + round_off);
  next_time_ = initial_time_ + (passed + 1) * *interval_;
}

}  // namespace strut

#include "output/means.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/errors.hpp"
#include "base/numbers.hpp"

namespace strut {

Layers::Layers(const std::string& set, const Body& body, const std::string& path)
    : Layers(deck::Profile{.name = "", .layers = 1, .node_set = set}, body, path) {}

Layers::Layers(const deck::Profile& profile, const Body& body, const std::string& path)
    : direction_(profile.direction), count_(profile.layers) {
  const Communicator& ranks = body.domain.communicator;
  group_ = PointGroup(body.domain.cloud, profile.node_set, path);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int i = 0; i < body.owned(); ++i) {
    if (!group_.counts(body.domain.cloud, i)) continue;
    const double place = direction_.dot(body.domain.reference(i)), volume = body.domain.volume(i);
    low = std::min(low, place - reach_of_cell(body.domain.cloud, volume, i, -direction_));
    high = std::max(high, place + reach_of_cell(body.domain.cloud, volume, i, direction_));
  }
  low_ = ranks.min(low);
  thickness_ = (ranks.max(high) - low_) / count_;
  std::vector<double> points(count_);
  for (int i = 0; i < body.owned(); ++i) {
    if (const int layer = of(body, i); layer >= 0) points[layer] += 1;
  }
  ranks.sum(points);
  const auto none = std::find(points.begin(), points.end(), 0.0);
  if (none == points.end()) return;
  if (count_ == 1) throw Error(path + ": the node set or block holds no point");
  throw Error(path + ": layer " + std::to_string(none - points.begin() + 1) + " of " + std::to_string(count_) +
              " holds no point; expected fewer Layers");
}

int Layers::of(const Body& body, int i) const {
  if (!group_.counts(body.domain.cloud, i)) return -1;
  if (count_ == 1) return 0;
  constexpr double round_off = 1e-9;  // so that points between two layers, as nodes may be, are all in the upper one
  const double height = direction_.dot(body.domain.reference(i)) - low_;
  return thickness_ > 0 ? std::clamp(static_cast<int>(height / thickness_ + round_off), 0, count_ - 1) : 0;
}

std::vector<std::string> Reduction::columns() const {
  if (layers_.count() == 1) return {name_};
  std::vector<std::string> names;
  const std::string start = name_.substr(0, name_.size() - 1);
  for (int layer = 1; layer <= layers_.count(); ++layer) names.push_back(start + " " + std::to_string(layer) + ")");
  return names;
}

template <class Value>
std::vector<double> Reduction::sums(const Body& body, const Value& value) const {
  const std::vector<bool> has = number_.observable.blocks_that_have_it(body);
  const int count = layers_.count();
  std::vector<double> sums(2 * static_cast<std::size_t>(count));
  for (int i = 0; i < body.owned(); ++i) {
    const int layer = has[body.domain.cloud.blocks[i]] ? layers_.of(body, i) : -1;
    if (layer < 0) continue;
    sums[layer] += value(i);
    sums[count + layer] += body.domain.volume(i);
  }
  body.domain.communicator.sum(sums);
  return sums;
}

bool Reduction::exists(const Body& body) const {
  const std::vector<double> sums = this->sums(body, [](int) { return 0.0; });
  return is_sum(name_) || std::all_of(sums.begin() + layers_.count(), sums.end(), [](double v) { return v > 0; });
}

std::vector<double> Reduction::values(const Body& body) const {
  const std::vector<double> numbers = number_.of(body);
  if (is_extreme(name_)) return {extreme(body, numbers)};
  const int count = layers_.count();
  const std::vector<double> sums =
      this->sums(body, [&](int i) { return (is_sum(name_) ? 1 : body.domain.volume(i)) * numbers[i]; });
  std::vector<double> means(count);
  for (int layer = 0; layer < count; ++layer) means[layer] = sums[layer] / (is_sum(name_) ? 1 : sums[count + layer]);
  return means;
}

double Reduction::extreme(const Body& body, const std::vector<double>& numbers) const {
  const std::vector<bool> has = number_.observable.blocks_that_have_it(body);
  const double sign = name_.starts_with("Max_") ? 1 : -1;
  double best = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < body.owned(); ++i) {
    if (has[body.domain.cloud.blocks[i]] && layers_.of(body, i) >= 0) best = std::max(best, sign * numbers[i]);
  }
  return sign * body.domain.communicator.max(best);
}

namespace {

// Parsed "Mean_X(set)": a number, and its points.
struct Asked {
  PointNumber number;
  std::string set = {};  // or block, or profile; "" for all points
  PointGroup group = {};
  const deck::Profile* profile = nullptr;
};

Asked asked_for(const std::vector<Observable>& all, const std::vector<deck::Profile>& profiles, const PointCloud& cloud,
                const std::string& name, const std::string& path) {
  const std::size_t bracket = name.back() == ')' ? name.find('(') : std::string::npos;
  const std::string whole = name.substr(0, bracket);
  const bool is_mean = Reduction::is_mean(whole), is_known = is_mean || Reduction::is_extreme(whole);
  const auto number = is_known ? PointNumber::find(all, whole.substr(whole.find('_') + 1)) : std::nullopt;
  if (!number) {
    const auto prefixes = to_words(is_mean ? "Mean_ Sum_" : "Max_ Min_ Mean_ Sum_");
    throw Error(path + ": expected " + (is_mean ? "" : "Max_, Min_, ") + "Mean_ or Sum_ and the name of a variable" +
                did_you_mean(whole, names_of_numbers(all, prefixes)) + "; variables are " + joined(names_of(all)));
  }
  if (bracket == std::string::npos) return {*number};
  const std::string set = name.substr(bracket + 1, name.size() - bracket - 2);
  const auto is_wanted = [&](const deck::Profile& profile) { return is_mean && profile.name == set; };
  const auto profile = std::find_if(profiles.begin(), profiles.end(), is_wanted);
  if (profile == profiles.end()) return {*number, set, PointGroup(cloud, set, path)};  // throws if there is none
  const auto among = [&set](const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), set) != names.end();
  };
  if (set == "all" || among(cloud.set_names) || among(cloud.block_names)) {
    throw Error(path + ": '" + set +
                "' is a section of History > Profiles and the name of points (node set, block or " +
                "'all'); expected another name of the profile");
  }
  return {*number, set, PointGroup(cloud, profile->node_set, "History > Profiles > " + set + " > Node Set"), &*profile};
}

}  // namespace

void check_reduction(const std::vector<Observable>& all, const std::vector<deck::Profile>& profiles,
                     const PointCloud& cloud, const Communicator& communicator, const std::string& name,
                     const std::string& where) {
  const std::string path = where + " > " + name;
  const Asked asked = asked_for(all, profiles, cloud, name, path);
  if (Reduction::is_extreme(name) && communicator.sum(std::ssize(asked.group.points(cloud))) == 0)
    throw Error(path + ": the node set or block holds no point");
}

Reduction reduction_of(const std::vector<Observable>& all, const std::vector<deck::Profile>& profiles, const Body& body,
                       const std::string& name, const std::string& where) {
  const std::string path = where + " > " + name;
  const Asked asked = asked_for(all, profiles, body.domain.cloud, name, path);
  if (asked.profile) return {name, asked.number, Layers(*asked.profile, body, "History > Profiles > " + asked.set)};
  return {name, asked.number, asked.set.empty() ? Layers() : Layers(asked.set, body, path)};
}

void MeanForces::add(std::span<const double> before, std::span<const double> after) {
  for (std::size_t k = 0; k < passed_.size(); ++k) {
    passed_[k] += ahead_[k] + before[k];
    ahead_[k] = after[k];
  }
}

std::vector<double> MeanForces::take(double time, const Communicator& communicator) {
  std::vector<double> means = std::exchange(passed_, std::vector<double>(passed_.size()));
  communicator.sum(means);
  for (double& mean : means) mean = time > since_ ? mean / (time - since_) : 0;
  since_ = time;
  return means;
}

void MeanForces::serialize(Archive& archive) {
  archive.number("mean_forces_since", since_);
  for (std::size_t k = 0; k < passed_.size(); ++k) {
    archive.rank_sum("mean_force_passed_" + std::to_string(k), passed_[k]);
    archive.rank_sum("mean_force_ahead_" + std::to_string(k), ahead_[k]);
  }
}

}  // namespace strut

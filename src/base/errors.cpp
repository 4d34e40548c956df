#include "base/errors.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <utility>

#include "base/parallel/gather_scatter.hpp"

namespace strut {

namespace {

// Levenshtein distance, ignoring case.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = diagonal + (lower(a[i - 1]) != lower(b[j - 1]));
      diagonal = std::exchange(row[j], std::min({change, row[j] + 1, row[j - 1] + 1}));
    }
  }
  return row.back();
}

}  // namespace

void raise_together(const Communicator& communicator, const std::string& problem) {
  if (!communicator.any(!problem.empty())) return;
  const std::string framed = problem.empty() ? "" : problem + '\0';
  std::string all;
  const std::vector<char> gathered = gather(communicator, std::span<const char>(framed));
  std::vector<std::string> distinct;
  for (auto begin = gathered.begin(); begin != gathered.end();) {
    const auto end = std::find(begin, gathered.end(), '\0');
    const std::string text(begin, end);
    if (std::find(distinct.begin(), distinct.end(), text) == distinct.end()) distinct.push_back(text);
    begin = end + 1;
  }
  all = joined(distinct, "\n");
  communicator.broadcast(all);
  throw Error(all);
}

void raise_first(const Communicator& communicator, const std::string& problem) {
  raise_together(communicator, communicator.first_rank(!problem.empty()) == communicator.rank() ? problem : "");
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& valid) {
  const std::string* nearest = nullptr;
  std::size_t best = std::max<std::size_t>(1, name.size() / 3) + 1;  // a larger distance is no similarity
  for (const std::string& candidate : valid) {
    if (name.size() >= candidate.size() + best) continue;  // skips very long names, as from a damaged file
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best) {
      best = distance;
      nearest = &candidate;
    }
  }
  return nearest ? " (did you mean '" + *nearest + "'?)" : "";
}

std::string joined(const std::vector<std::string>& words, std::string_view separator) {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += separator;
    text += word;
  }
  return text;
}

}  // namespace strut

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "advice/checks.hpp"
#include "base/parallel/gather_scatter.hpp"
#include "base/text.hpp"

namespace strut {

namespace {

// The numbers of all points, distributed so that equal numbers are on one rank, and sorted there.
std::vector<std::int64_t> dealt_by_number(const Domain& domain) {
  const Communicator& ranks = domain.communicator;
  const auto rank_of = [&ranks](std::int64_t number) {
    return static_cast<int>(static_cast<std::uint64_t>(number) % static_cast<std::uint64_t>(ranks.size()));
  };
  std::vector<std::int64_t> numbers(domain.cloud.element_ids.begin(), domain.cloud.element_ids.begin() + domain.owned);
  std::ranges::stable_sort(numbers, {}, rank_of);
  std::vector<std::int64_t> to_ranks(ranks.size(), 0);
  for (const std::int64_t number : numbers) ++to_ranks[rank_of(number)];
  numbers = exchange(ranks, std::span<const std::int64_t>(numbers), to_ranks, counts_from_ranks(ranks, to_ranks));
  std::ranges::sort(numbers);
  return numbers;
}

}  // namespace

std::string doubled_numbers(const Situation& situation) {
  const Domain& domain = situation.scene.body.domain;
  const std::vector<std::int64_t> numbers = dealt_by_number(domain);
  std::int64_t doubled = 0;
  double least = std::numeric_limits<double>::max();
  for (std::size_t n = 1; n < numbers.size(); ++n) {
    if (numbers[n] != numbers[n - 1]) continue;
    ++doubled;
    least = std::min(least, static_cast<double>(numbers[n]));
  }
  doubled = domain.communicator.sum(doubled);
  if (doubled == 0) return "";
  return text_of("WARNING: Discretization > Input Mesh File: its map of numbers gives the number ",
                 static_cast<std::int64_t>(domain.communicator.min(least)), " to more than one ", word(domain.cloud.at),
                 ", and so on, ", doubled, " times in all: results and messages name them alike; expected each once\n");
}

}  // namespace strut

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "advice/checks.hpp"
#include "base/parallel/gather_scatter.hpp"
#include "base/text.hpp"

namespace strut {

namespace {

// The numbers of all points, distributed so that equal numbers are on one rank, and sorted there.
std::vector<std::int64_t> dealt_by_number(const Domain& domain) {
  const Communicator& ranks = domain.communicator;
  std::vector<int> owners;
  for (const std::int64_t number : domain.cloud.element_ids)
    owners.push_back(static_cast<int>(static_cast<std::uint64_t>(number) % static_cast<std::uint64_t>(ranks.size())));
  std::vector<std::int64_t> numbers = Routes(ranks, owners).there(domain.cloud.element_ids);
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

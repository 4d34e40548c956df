#include "topology/sent_to_ranks.hpp"

#include "base/parallel/communicator.hpp"
#include "base/parallel/gather_scatter.hpp"

namespace strut {

std::vector<double> sent_to_ranks(std::span<const int> ranks, std::span<const double> records, int width,
                                  const Communicator& communicator) {
  std::vector<std::int64_t> to_ranks(static_cast<std::size_t>(communicator.size()), 0);
  for (const int rank : ranks) to_ranks[static_cast<std::size_t>(rank)] += width;
  return exchange(communicator, records, to_ranks, counts_from_ranks(communicator, to_ranks));
}

}  // namespace strut

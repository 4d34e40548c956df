// Exchange of values without any rank holding those of all ranks: in portions to and from rank 0 (gatherv, scatterv),
// and between all ranks; and `gather`. All calls are collective; T is trivially copyable.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "base/parallel/communicator.hpp"

namespace strut {

// The largest number of values of other ranks that rank 0 holds at a time.
constexpr std::size_t largest_portion = std::size_t{1} << 16;

namespace gather_scatter {

// The implementation of the functions below, in bytes; `size`: of a value.
using Take = std::function<void(const char* values, std::size_t count)>;
using Give = std::function<void(std::int64_t begin, char* values, std::size_t count)>;
void gatherv(const Communicator& communicator, const char* mine, std::size_t count, std::size_t size, const Take& take);
void scatterv(const Communicator& communicator, const std::vector<std::int64_t>& counts, char* mine, std::size_t size,
              const Give& give);
constexpr std::size_t largest_message = std::size_t{1} << 30;  // bytes
void exchange(const Communicator& communicator, const char* leaving, const std::vector<std::int64_t>& to_ranks,
              char* arriving, const std::vector<std::int64_t>& from_ranks, std::size_t size,
              std::size_t largest_message);

}  // namespace gather_scatter

// Gatherv: takes all ranks' values in the order of ranks, by repeated calls of take(portion) on rank 0.
template <class T, class TakePortion>
void gatherv(const Communicator& communicator, std::span<const T> mine, const TakePortion& take) {
  static_assert(std::is_trivially_copyable_v<T>);
  gather_scatter::gatherv(
      communicator, reinterpret_cast<const char*>(mine.data()), mine.size(), sizeof(T),
      [&take](const char* values, std::size_t count) { take(std::span(reinterpret_cast<const T*>(values), count)); });
}

// All ranks' values in the order of ranks, on rank 0 (empty on others), which holds them all: for few values only.
template <class T>
std::vector<T> gather(const Communicator& communicator, std::span<const T> mine) {
  std::vector<T> all;
  gatherv(communicator, mine,
          [&all](std::span<const T> portion) { all.insert(all.end(), portion.begin(), portion.end()); });
  return all;
}

// Scatterv: sends rank r the next counts[r] values; on rank 0, give(begin, portion) fills those from number `begin` on.
template <class T, class GivePortion>
std::vector<T> scatterv(const Communicator& communicator, const std::vector<std::int64_t>& counts,
                        const GivePortion& give) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<T> mine(static_cast<std::size_t>(counts[static_cast<std::size_t>(communicator.rank())]));
  gather_scatter::scatterv(communicator, counts, reinterpret_cast<char*>(mine.data()), sizeof(T),
                           [&give](std::int64_t begin, char* values, std::size_t count) {
                             give(begin, std::span(reinterpret_cast<T*>(values), count));
                           });
  return mine;
}

// The number of values that each rank sends to this one, if this one sends to_ranks[r] to rank r.
std::vector<std::int64_t> counts_from_ranks(const Communicator& communicator,
                                            const std::vector<std::int64_t>& to_ranks);

// `leaving`: to_ranks[r] values for each rank r, one rank after the other. Returns the from_ranks[r] values of each
// rank r, without a limit on their number; `largest_message` in bytes, the same on all ranks.
template <class T>
std::vector<T> exchange(const Communicator& communicator, std::span<const T> leaving,
                        const std::vector<std::int64_t>& to_ranks, const std::vector<std::int64_t>& from_ranks,
                        std::size_t largest_message = gather_scatter::largest_message) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<T> arriving(
      static_cast<std::size_t>(std::accumulate(from_ranks.begin(), from_ranks.end(), std::int64_t{0})));
  gather_scatter::exchange(communicator, reinterpret_cast<const char*>(leaving.data()), to_ranks,
                           reinterpret_cast<char*>(arriving.data()), from_ranks, sizeof(T), largest_message);
  return arriving;
}

// The ways of values to the ranks that are given for them, and back.
class Routes {
 public:
  // Collective. Value k goes to ranks[k].
  Routes(const Communicator& communicator, std::span<const int> ranks);

  // Collective. Sends value(k) for each k. Returns those that come to this rank: in the order of the ranks that send
  // them, and of k there.
  template <class Value>
  auto there(const Value& value) const {
    using T = std::decay_t<decltype(value(0))>;
    std::vector<T> leaving;
    leaving.reserve(order_.size());
    for (const int k : order_) leaving.push_back(value(k));
    return exchange<T>(communicator_, leaving, to_ranks_, from_ranks_);
  }
  template <class T>
  std::vector<T> there(const std::vector<T>& values) const {
    return there([&values](int k) { return values[k]; });
  }

  // Collective. Sends an answer to each value that came; returns those to the values that went, by k.
  template <class T>
  std::vector<T> back(const std::vector<T>& answers) const {
    const std::vector<T> arrived = exchange<T>(communicator_, answers, from_ranks_, to_ranks_);
    std::vector<T> all(arrived.size());
    for (std::size_t n = 0; n < all.size(); ++n) all[order_[n]] = arrived[n];
    return all;
  }

 private:
  Communicator communicator_;
  std::vector<int> order_;                           // of the values, by their ranks
  std::vector<std::int64_t> to_ranks_, from_ranks_;  // numbers of values
};

// The names of rank 0, on all ranks. They may contain any character.
std::vector<std::string> broadcast_names(std::vector<std::string> names, const Communicator& communicator);

}  // namespace strut

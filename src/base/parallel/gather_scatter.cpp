#include "base/parallel/gather_scatter.hpp"

#include <mpi.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <algorithm>

namespace strut {

namespace {

MPI_Comm raw(const Communicator& communicator) {
  return *Teuchos::rcp_dynamic_cast<const Teuchos::MpiComm<int>>(communicator.teuchos())->getRawMpiComm();
}

template <class Portion>
void in_portions(std::size_t count, const Portion& portion) {
  for (std::size_t begin = 0; begin < count; begin += largest_portion) {
    portion(begin, std::min(largest_portion, count - begin));
  }
}

}  // namespace

void gather_scatter::gatherv(const Communicator& communicator, const char* mine, std::size_t count, std::size_t size,
                             const Take& take) {
  const MPI_Comm comm = raw(communicator);
  const std::uint64_t own = count;
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(communicator.rank() == 0 ? communicator.size() : 0));
  MPI_Gather(&own, 1, MPI_UINT64_T, counts.data(), 1, MPI_UINT64_T, 0, comm);
  if (communicator.rank() != 0) {
    return in_portions(count, [&](std::size_t begin, std::size_t values) {
      MPI_Send(mine + begin * size, static_cast<int>(values * size), MPI_BYTE, 0, 0, comm);
    });
  }
  in_portions(count, [&](std::size_t begin, std::size_t values) { take(mine + begin * size, values); });
  std::vector<char> portion;
  for (int source = 1; source < communicator.size(); ++source) {
    in_portions(counts[static_cast<std::size_t>(source)], [&](std::size_t, std::size_t values) {
      portion.resize(values * size);
      MPI_Recv(portion.data(), static_cast<int>(values * size), MPI_BYTE, source, 0, comm, MPI_STATUS_IGNORE);
      take(portion.data(), values);
    });
  }
}

void gather_scatter::scatterv(const Communicator& communicator, const std::vector<std::int64_t>& counts, char* mine,
                              std::size_t size, const Give& give) {
  const MPI_Comm comm = raw(communicator);
  const auto count_of = [&](int rank) { return static_cast<std::size_t>(counts[static_cast<std::size_t>(rank)]); };
  if (communicator.rank() != 0) {
    return in_portions(count_of(communicator.rank()), [&](std::size_t begin, std::size_t values) {
      MPI_Recv(mine + begin * size, static_cast<int>(values * size), MPI_BYTE, 0, 0, comm, MPI_STATUS_IGNORE);
    });
  }
  in_portions(count_of(0), [&](std::size_t begin, std::size_t values) {
    give(static_cast<std::int64_t>(begin), mine + begin * size, values);
  });
  std::int64_t next = counts[0];
  std::vector<char> portion;
  for (int target = 1; target < communicator.size(); ++target) {
    in_portions(count_of(target), [&](std::size_t, std::size_t values) {
      portion.resize(values * size);
      give(next, portion.data(), values);
      MPI_Send(portion.data(), static_cast<int>(values * size), MPI_BYTE, target, 0, comm);
      next += static_cast<std::int64_t>(values);
    });
  }
}

std::vector<std::int64_t> counts_from_ranks(const Communicator& communicator,
                                            const std::vector<std::int64_t>& to_ranks) {
  std::vector<std::int64_t> from_ranks(to_ranks.size());
  MPI_Alltoall(to_ranks.data(), 1, MPI_INT64_T, from_ranks.data(), 1, MPI_INT64_T, raw(communicator));
  return from_ranks;
}

// Counts in MPI messages are ints: larger data go in several messages, which arrive in order.
void gather_scatter::exchange(const Communicator& communicator, const char* leaving,
                              const std::vector<std::int64_t>& to_ranks, char* arriving,
                              const std::vector<std::int64_t>& from_ranks, std::size_t size,
                              std::size_t largest_message) {
  const MPI_Comm comm = raw(communicator);
  const auto own = static_cast<std::size_t>(communicator.rank());
  std::vector<MPI_Request> requests;
  const auto over_ranks = [&](const std::vector<std::int64_t>& counts, const auto& visit) {
    std::size_t begin = 0;  // bytes
    for (std::size_t rank = 0; rank < counts.size(); ++rank) {
      const std::size_t end = begin + static_cast<std::size_t>(counts[rank]) * size;
      if (rank == own) visit(static_cast<int>(rank), begin, end - begin);
      for (; rank != own && begin < end; begin += largest_message) {
        visit(static_cast<int>(rank), begin, std::min(largest_message, end - begin));
      }
      begin = end;
    }
  };
  std::size_t own_offset = 0;
  over_ranks(from_ranks, [&](int rank, std::size_t begin, std::size_t bytes) {
    if (rank == communicator.rank()) return void(own_offset = begin);
    MPI_Irecv(arriving + begin, static_cast<int>(bytes), MPI_BYTE, rank, 0, comm, &requests.emplace_back());
  });
  over_ranks(to_ranks, [&](int rank, std::size_t begin, std::size_t bytes) {
    if (rank == communicator.rank()) return void(std::copy_n(leaving + begin, bytes, arriving + own_offset));
    MPI_Isend(leaving + begin, static_cast<int>(bytes), MPI_BYTE, rank, 0, comm, &requests.emplace_back());
  });
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

Routes::Routes(const Communicator& communicator, std::span<const int> ranks)
    : communicator_(communicator), order_(ranks.size()), to_ranks_(communicator.size(), 0) {
  std::iota(order_.begin(), order_.end(), 0);
  std::ranges::stable_sort(order_, {}, [&](int k) { return ranks[k]; });
  for (const int rank : ranks) ++to_ranks_[rank];
  from_ranks_ = counts_from_ranks(communicator, to_ranks_);
}

// Sends the lengths, then all names as one text.
std::vector<std::string> broadcast_names(std::vector<std::string> names, const Communicator& communicator) {
  std::vector<std::uint64_t> lengths;
  std::string text;
  for (const std::string& name : names) {
    lengths.push_back(name.size());
    text += name;
  }
  communicator.broadcast(lengths);
  communicator.broadcast(text);
  names.clear();
  std::size_t begin = 0;
  for (const std::uint64_t length : lengths) {
    names.push_back(text.substr(begin, length));
    begin += length;
  }
  return names;
}

}  // namespace strut

#include "base/parallel/portions.hpp"

#include <mpi.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <cstring>

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

// Values of so many bytes, so that counts in messages are of values: they are ints.
class ValueType {
 public:
  explicit ValueType(std::size_t size) {
    MPI_Type_contiguous(static_cast<int>(size), MPI_BYTE, &type_);
    MPI_Type_commit(&type_);
  }
  ~ValueType() { MPI_Type_free(&type_); }
  ValueType(const ValueType&) = delete;
  ValueType& operator=(const ValueType&) = delete;
  operator MPI_Datatype() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

// As MPI wants them: counts, and where each begins.
struct Layout {
  std::vector<int> counts, begins;
  explicit Layout(const std::vector<std::int64_t>& of_ranks) {
    int begin = 0;
    for (const std::int64_t count : of_ranks) {
      counts.push_back(static_cast<int>(count));
      begins.push_back(begin);
      begin += counts.back();
    }
  }
};

}  // namespace

void portions::collect(const Communicator& communicator, const char* mine, std::size_t count, std::size_t size,
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

void portions::deal(const Communicator& communicator, const std::vector<std::int64_t>& counts, char* mine,
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

void portions::exchange(const Communicator& communicator, const char* leaving,
                        const std::vector<std::int64_t>& to_ranks, char* arriving,
                        const std::vector<std::int64_t>& from_ranks, std::size_t size) {
  if (communicator.size() == 1) {
    if (to_ranks[0] > 0) std::memcpy(arriving, leaving, static_cast<std::size_t>(to_ranks[0]) * size);
    return;
  }
  const ValueType type(size);
  const Layout to(to_ranks), from(from_ranks);
  MPI_Alltoallv(leaving, to.counts.data(), to.begins.data(), type, arriving, from.counts.data(), from.begins.data(),
                type, raw(communicator));
}

// Lengths first, then the names as one text.
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

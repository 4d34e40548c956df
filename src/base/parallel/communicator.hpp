// The ranks of a run: a thin, copyable handle of a Teuchos communicator that keeps Trilinos' headers out of ours. All
// members except rank(), size(), abort() and teuchos() are collective.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace Teuchos {
template <class Ordinal>
class Comm;
template <class T>
class RCP;
}  // namespace Teuchos

namespace strut {

// Starts MPI and Kokkos, and finalizes them when it goes out of scope: the first object of main().
class Runtime {
 public:
  Runtime(int& argc, char**& argv);
  ~Runtime();
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;
};

class Communicator {
 public:
  Communicator();  // all ranks of MPI_COMM_WORLD
  ~Communicator();
  Communicator(const Communicator&);
  Communicator& operator=(const Communicator&);

  int rank() const { return rank_; }
  int size() const { return size_; }

  int ranks_of_node() const;  // ranks that share memory with this one, itself included

  void barrier() const;
  [[noreturn]] void abort() const;           // ends all ranks at once; not collective
  void sum(std::span<double> values) const;  // in place, on all ranks
  void max(std::span<double> values) const;
  double sum(double value) const;
  double max(double value) const;
  double min(double value) const;
  std::int64_t sum(std::int64_t value) const;
  bool any(bool here) const;        // on any rank
  int first_rank(bool here) const;  // the lowest one where it is true, -1 if none: of ranks that are alike, one speaks

  void broadcast(std::string& text) const;  // from rank 0
  template <class T>
  void broadcast(std::vector<T>& values) const;  // from rank 0, resized elsewhere; T trivially copyable

  const Teuchos::RCP<const Teuchos::Comm<int>>& teuchos() const;

 private:
  void broadcast_bytes(void* data, std::size_t size) const;

  struct Implementation;
  std::shared_ptr<const Implementation> implementation_;
  int rank_ = 0;
  int size_ = 1;
};

template <class T>
void Communicator::broadcast(std::vector<T>& values) const {
  static_assert(std::is_trivially_copyable_v<T>);
  std::uint64_t count = values.size();
  broadcast_bytes(&count, sizeof count);
  values.resize(count);
  broadcast_bytes(values.data(), count * sizeof(T));
}

}  // namespace strut

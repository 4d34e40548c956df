#include "base/parallel/communicator.hpp"

#include <mpi.h>

#include <Kokkos_Core.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_DefaultMpiComm.hpp>
#include <algorithm>
#include <cstdlib>

namespace strut {

namespace {

constexpr std::size_t largest_message = std::size_t{1} << 30;  // bytes: MPI's counts are ints

bool owns_mpi = true;  // not if it ran before, as in a script in Python: then it is left running

// Starts Kokkos with one thread, whatever its build and the environment say: the threads of a rank are not Kokkos'
// (threads.hpp). The command line is not passed, because Kokkos would answer --help with its own page.
void start_kokkos() {
#if KOKKOS_VERSION >= 30700
  Kokkos::initialize(Kokkos::InitializationSettings().set_num_threads(1));
#else
  Kokkos::initialize(Kokkos::InitArguments(1));
#endif
}

// Settings of Open MPI for a process that no launcher started; a user's own settings stay. A helper process for each
// run would take longer to start than MPI itself; and programs without one share the folder of one session, which the
// first to end removes while another begins to use it.
void run_alone() {
  for (const char* set_by_a_launcher : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"}) {
    if (std::getenv(set_by_a_launcher)) return;
  }
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
}

}  // namespace

Runtime::Runtime(int& argc, char**& argv) {
  int is_there = 0, level = MPI_THREAD_SINGLE;
  MPI_Initialized(&is_there);
  owns_mpi = is_there == 0;
  run_alone();
  if (owns_mpi) MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);  // a run that asks for threads checks it
  start_kokkos();
}

Runtime::~Runtime() {
  Kokkos::finalize();
  if (owns_mpi) MPI_Finalize();
}

struct Communicator::Implementation {
  Teuchos::RCP<const Teuchos::Comm<int>> teuchos;
  MPI_Comm raw;
};

Communicator::Communicator() {
  const Teuchos::RCP<const Teuchos::Comm<int>> comm = Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_WORLD));
  implementation_ = std::make_shared<const Implementation>(Implementation{comm, MPI_COMM_WORLD});
  rank_ = comm->getRank();
  size_ = comm->getSize();
}

Communicator::~Communicator() = default;
Communicator::Communicator(const Communicator&) = default;
Communicator& Communicator::operator=(const Communicator&) = default;

const Teuchos::RCP<const Teuchos::Comm<int>>& Communicator::teuchos() const { return implementation_->teuchos; }

int Communicator::ranks_of_node() const {
  MPI_Comm node = MPI_COMM_NULL;
  MPI_Comm_split_type(implementation_->raw, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &node);
  int count = 1;
  MPI_Comm_size(node, &count);
  MPI_Comm_free(&node);
  return count;
}

void Communicator::barrier() const { teuchos()->barrier(); }

void Communicator::abort() const {
  MPI_Abort(implementation_->raw, 1);
  std::abort();
}

void Communicator::sum(std::span<double> values) const {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM,
                implementation_->raw);
}

void Communicator::max(std::span<double> values) const {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MAX,
                implementation_->raw);
}

double Communicator::sum(double value) const {
  sum(std::span(&value, 1));
  return value;
}

double Communicator::max(double value) const {
  max(std::span(&value, 1));
  return value;
}

double Communicator::min(double value) const { return -max(-value); }

std::int64_t Communicator::sum(std::int64_t value) const {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT64_T, MPI_SUM, implementation_->raw);
  return value;
}

bool Communicator::any(bool here) const { return max(here ? 1.0 : 0.0) > 0; }

int Communicator::first_rank(bool here) const {
  const double first = min(here ? rank_ : size_);
  return first < size_ ? static_cast<int>(first) : -1;
}

void Communicator::broadcast(std::string& text) const {
  std::vector<char> bytes(text.begin(), text.end());
  broadcast(bytes);
  text.assign(bytes.begin(), bytes.end());
}

void Communicator::broadcast_bytes(void* data, std::size_t size) const {
  for (std::size_t begin = 0; begin < size; begin += largest_message) {
    const int count = static_cast<int>(std::min(largest_message, size - begin));
    MPI_Bcast(static_cast<char*>(data) + begin, count, MPI_BYTE, 0, implementation_->raw);
  }
}

}  // namespace strut

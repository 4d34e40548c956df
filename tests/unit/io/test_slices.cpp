// Points in slices, values in portions, and what a rank has of a body in memory while files are read and written.
#include <gtest/gtest.h>
#include <malloc.h>
#include <mpi.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>
#include <numeric>

#include "base/archive.hpp"
#include "base/errors.hpp"
#include "io/checkpoint/checkpoint_file.hpp"
#include "io/exodus/exodus.hpp"
#include "io/grid/grid.hpp"
#include "io/slices.hpp"
#include "unit/io/bricks.hpp"
#include "unit/temporary_folder.hpp"

namespace {

// Bytes that C++ has allocated on the heap, and their maximum; bytes that this rank has received from others.
std::atomic<std::int64_t> taken = 0, most_taken = 0;
std::int64_t received = 0;

int size_of(MPI_Datatype type) {
  int size = 0;
  MPI_Type_size(type, &size);
  return size;
}

}  // namespace

void* operator new(std::size_t size) {
  void* memory = std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  taken += static_cast<std::int64_t>(malloc_usable_size(memory));
  most_taken = std::max<std::int64_t>(most_taken, taken);
  return memory;
}
void operator delete(void* memory) noexcept {
  taken -= static_cast<std::int64_t>(malloc_usable_size(memory));
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }

// Between the program and MPI, to count.
int MPI_Recv(void* to, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Status* status) {
  received += static_cast<std::int64_t>(count) * size_of(type);
  return PMPI_Recv(to, count, type, from, tag, comm, status);
}
int MPI_Bcast(void* values, int count, MPI_Datatype type, int root, MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  if (rank != root) received += static_cast<std::int64_t>(count) * size_of(type);
  return PMPI_Bcast(values, count, type, root, comm);
}
int MPI_Irecv(void* to, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Request* request) {
  received += static_cast<std::int64_t>(count) * size_of(type);
  return PMPI_Irecv(to, count, type, from, tag, comm, request);
}

namespace strut::io {
namespace {

TEST(Slices, OwnersCountsAndBeginsAgree) {
  for (const std::int64_t total : {1, 2, 7, 64, 1000}) {
    for (const int ranks : {1, 2, 3, 8, 13}) {
      const std::vector<std::int64_t> counts = slice_counts(total, ranks);
      EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::int64_t{0}), total);
      for (int rank = 0; rank < ranks; ++rank) {
        for (std::int64_t k = 0; k < counts[rank]; ++k) {
          EXPECT_EQ(slice_owner(total, ranks, slice_begin(total, ranks, rank) + k), rank);
        }
      }
    }
  }
}

// Every third number, dealt to the ranks from the last one on; two values each.
TEST(Slices, ThereAndBackAgain) {
  const Communicator world;
  std::vector<std::int64_t> ids, values;
  for (std::int64_t id = 297; id >= 0; id -= 3) {
    if (id % world.size() != world.rank()) continue;
    ids.push_back(id);
    values.insert(values.end(), {10 * id, 10 * id + 1});
  }
  const Slices slices(world, ids);
  EXPECT_EQ(slices.size(), 100);
  const std::vector<std::int64_t> second = slices.to_slices(std::span<const std::int64_t>(values), 2, 1);
  const std::vector<std::int64_t> rows = slices.rows_to_slices(std::span<const std::int64_t>(values), 2);
  ASSERT_EQ(second.size(), slices.ids().size());
  for (std::size_t n = 0; n < second.size(); ++n) {
    EXPECT_EQ(slices.ids()[n], 3 * (slices.first() + static_cast<std::int64_t>(n)));
    EXPECT_EQ(second[n], 10 * slices.ids()[n] + 1);
    EXPECT_EQ(rows[2 * n], 10 * slices.ids()[n]);
  }
  std::vector<std::int64_t> back(values.size());
  slices.rows_from_slices<std::int64_t>(rows, 2, back);
  EXPECT_EQ(back, values);
}

TEST(Slices, SeveralRanksMayAskForTheSame) {
  const Communicator world;
  const std::vector<std::int64_t> asked = {5, 0, 9};  // on all ranks
  const Slices slices(world, asked, 10);
  EXPECT_EQ(slices.size(), 3);
  std::vector<std::int64_t> squares, answers(3);
  for (const std::int64_t id : slices.ids()) squares.push_back(id * id);
  slices.rows_from_slices<std::int64_t>(squares, 1, answers);
  EXPECT_EQ(answers, (std::vector<std::int64_t>{25, 0, 81}));
}

TEST(Portions, AreInOrderAndBounded) {
  const Communicator world;
  constexpr std::int64_t total = 3 * static_cast<std::int64_t>(largest_portion) + 17;
  const std::vector<std::int64_t> counts = slice_counts(total, world.size());
  const auto mine = scatterv<std::int64_t>(world, counts, [](std::int64_t begin, std::span<std::int64_t> values) {
    EXPECT_LE(values.size(), largest_portion);
    std::iota(values.begin(), values.end(), begin);
  });
  ASSERT_EQ(std::ssize(mine), counts[world.rank()]);
  EXPECT_EQ(mine.front(), slice_begin(total, world.size(), world.rank()));
  EXPECT_TRUE(std::is_sorted(mine.begin(), mine.end()));
  std::int64_t next = 0;
  gatherv<std::int64_t>(world, mine, [&next](std::span<const std::int64_t> values) {
    EXPECT_LE(values.size(), largest_portion);
    for (const std::int64_t value : values) EXPECT_EQ(value, next++);
  });
  EXPECT_EQ(next, world.rank() == 0 ? total : 0);
}

// As if what MPI takes in one message were five values, or less than one: each rank has another number for each other.
TEST(Portions, WhatIsTooMuchForAMessageGoesInSeveral) {
  const Communicator world;
  const int ranks = world.size();
  for (const std::size_t largest : {std::size_t{3}, std::size_t{40}, gather_scatter::largest_message}) {
    std::vector<std::int64_t> to, leaving, expected;
    for (int r = 0; r < ranks; ++r) {
      to.push_back((r + 2 * world.rank()) % 3 * 9);
      for (std::int64_t k = 0; k < to.back(); ++k) leaving.push_back(1000 * world.rank() + 100 * r + k);
      for (std::int64_t k = 0; k < (world.rank() + 2 * r) % 3 * 9; ++k) {
        expected.push_back(1000 * r + 100 * world.rank() + k);
      }
    }
    EXPECT_EQ(exchange(world, std::span<const std::int64_t>(leaving), to, counts_from_ranks(world, to), largest),
              expected);
  }
}

class Memory : public testing::Test {
 protected:
  const Communicator world;
  const TemporaryFolder folder{world};

  // Bytes that an action takes at the most, beyond what was taken before.
  template <class Action>
  double most_of(const Action& action) const {
    const std::int64_t before = taken;
    most_taken = before;
    action();
    return static_cast<double>(most_taken - before);
  }

  // Beside its part of a body, rank 0 has some portions, of at most 24 bytes a value (a node's place, thrice: as the
  // library has it, as it is checked, as it travels), and the names of the file.
  template <class Action>
  void expect_no_more_on_rank_0(const char* what, const Action& action) const {
    constexpr double of_portions = 3 * 24 * static_cast<double>(largest_portion) + 1e6;
    const double mine = most_of(action);
    const double root = world.max(world.rank() == 0 ? mine : 0.0), others = world.max(world.rank() == 0 ? 0.0 : mine);
    EXPECT_LE(root, (world.size() > 1 ? 1.05 * others : root) + of_portions) << what;
  }
};

std::vector<double> planes(int count) {
  std::vector<double> x(static_cast<std::size_t>(count) + 1);
  std::iota(x.begin(), x.end(), 0.0);
  return x;
}

// 216,000 elements, of which each rank's part takes more than the portions do.
TEST_F(Memory, OfRankZeroIsThatOfTheOthers) {
  if (world.size() == 1) GTEST_SKIP() << "there are no others";
  constexpr int edge = 60;
  run_on_root(world, [&] { write_mesh(folder / "mesh.g", bricks(planes(edge), planes(edge), planes(edge))); });
  for (const bool with_cells : {false, true}) {
    expect_no_more_on_rank_0("grid", [&] { make_grid({0, 0, 0}, {1, 1, 1}, {edge, edge, edge}, world, with_cells); });
    expect_no_more_on_rank_0("nodes", [&] { read_exodus(folder / "mesh.g", world, PointsAt::nodes, with_cells); });
    expect_no_more_on_rank_0("elements",
                             [&] { read_exodus(folder / "mesh.g", world, PointsAt::elements, with_cells); });
  }
  const PointCloud cloud = read_exodus(folder / "mesh.g", world);
  const std::vector<std::vector<double>> columns = {std::vector<double>(9 * cloud.size(), 1.5)};
  expect_no_more_on_rank_0("frame", [&] {
    ExodusWriter(folder / "result.e", world, cloud, {{"F", 9, true}}).write(0, columns);
  });
  Snapshot snapshot{{{"all", cloud.ids, {{"F", 9, columns[0]}}}}, {}, {}};
  expect_no_more_on_rank_0("checkpoint", [&] { write_checkpoint(folder / "a.restart", world, snapshot, "deck"); });
  snapshot.groups[0].columns[0].values.assign(9 * cloud.size(), 0);
  expect_no_more_on_rank_0("resumed", [&] { read_checkpoint(folder / "a.restart", world, snapshot); });
  EXPECT_EQ(snapshot.groups[0].columns[0].values, columns[0]);
}

// Its slice of the file, and its points from the slices of others.
TEST_F(Memory, ResumedRanksReceiveTwiceTheirShareAtMost) {
  constexpr std::int64_t points = 20000;
  Snapshot snapshot{{{"all", {}, {{"a", 3, {}}, {"b", 1, {}}}}}, {{"time", 1.0}}, {{"energy", 2.0}}};
  Snapshot::Group& group = snapshot.groups[0];
  for (std::int64_t id = world.rank(); id < points; id += world.size()) group.ids.push_back(id);
  for (Snapshot::Column& column : group.columns) column.values.assign(column.width * group.ids.size(), 0.5);
  write_checkpoint(folder / "a.restart", world, snapshot, "deck");
  received = 0;
  read_checkpoint(folder / "a.restart", world, snapshot);
  const std::size_t share = sizeof(double) * (1 + 3 + 1) * group.ids.size();  // ids are as long
  EXPECT_LE(received, static_cast<std::int64_t>(2 * share + 1000));           // and numbers, names, counts
  EXPECT_GE(received, static_cast<std::int64_t>(world.size() > 1 ? share / 4 : 0)) << "is it counted at all?";
}

}  // namespace
}  // namespace strut::io

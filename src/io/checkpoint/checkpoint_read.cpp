#include <algorithm>
#include <numeric>
#include <optional>

#include "base/build_facts.hpp"
#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"
#include "io/checkpoint/checkpoint_file.hpp"
#include "io/checkpoint/checkpoint_layout.hpp"
#include "io/netcdf/classic_netcdf.hpp"
#include "io/netcdf/netcdf_lists.hpp"
#include "io/netcdf/trial_read.hpp"

namespace strut::io {

namespace fs = std::filesystem;
using namespace checkpoint_layout;

namespace {

constexpr std::size_t portion = std::size_t{1} << 20;  // values that are sent to the ranks at a time

NetcdfLists opened(const fs::path& path) {
  std::error_code failure;
  if (!fs::exists(path, failure)) throw Error(path.string() + ": there is no such file");
  if (const std::string problem = classic_netcdf_problem(path); !problem.empty()) {
    throw Error(path.string() + ": not a checkpoint, or damaged: " + problem);
  }
  if (is_hdf5(path)) throw Error(path.string() + ": is no checkpoint of strut");  // which HDF5 might not survive
  NetcdfLists file = NetcdfLists::open(path);
  if (!file.has_number(mark)) throw Error(path.string() + ": is no checkpoint of strut");
  if (const double found = file.number(mark); found != version) {
    throw Error(path.string() + ": has version " + std::to_string(static_cast<int>(found)) + "; this strut reads " +
                std::to_string(version) + " (" + build_facts() + ", the file is by " + file.text("written_by") + ")");
  }
  return file;
}

[[noreturn]] void differs(const fs::path& path, const std::string& what) {
  throw Error(path.string() + ": is of another deck or mesh: " + what +
              ". A run can go on with another final time, and other times of output, not with another model");
}

// That the file has what the snapshot has. The numbers of points are those over all ranks.
void compare(const fs::path& path, const NetcdfLists& file, const Snapshot& snapshot,
             const std::vector<std::int64_t>& counts) {
  int lists = 1 + static_cast<int>(snapshot.shares.size());  // with the check sum
  for (const auto& [name, value] : snapshot.numbers) {
    if (!file.has_number(name_of_number(name))) differs(path, "it has no number '" + name + "'");
  }
  for (const auto& [name, value] : snapshot.shares) {
    if (file.size(name_of_share(name)) == 0) differs(path, "it has no number '" + name + "'");
  }
  for (std::size_t g = 0; g < snapshot.groups.size(); ++g) {
    const Snapshot::Group& group = snapshot.groups[g];
    const std::size_t count = file.size(name_of_ids(g));
    if (count != static_cast<std::size_t>(counts[g])) {
      differs(path, group.name + ": " + std::to_string(count) + " points there, " + std::to_string(counts[g]) +
                        " in the deck's mesh");
    }
    if (count > 0) lists += 1 + static_cast<int>(group.columns.size());
    for (const Snapshot::Column& column : group.columns) {
      if (file.size(name_of(g, column.name)) != count * static_cast<std::size_t>(column.width)) {
        differs(path, group.name + ": no column '" + column.name + "' that fits");
      }
    }
  }
  if (file.lists() != lists) {
    differs(path,
            "it has " + std::to_string(file.lists()) + " lists of numbers; the deck asks for " + std::to_string(lists));
  }
}

void check_sum(const fs::path& path, const NetcdfLists& file, const Snapshot& snapshot) {
  Sum sum;
  for (const auto& [name, value] : snapshot.numbers) sum.add(std::vector<double>{file.number(name_of_number(name))});
  for (const auto& [name, value] : snapshot.shares) sum.add(file.reals(name_of_share(name)));
  for (std::size_t g = 0; g < snapshot.groups.size(); ++g) {
    sum.add(file.integers(name_of_ids(g)));
    for (const Snapshot::Column& column : snapshot.groups[g].columns) sum.add(file.reals(name_of(g, column.name)));
  }
  if (file.reals("sum") != std::vector<double>{sum.value()}) {
    throw Error(path.string() + ": is damaged: its check sum is not that of its contents");
  }
}

// Collective. All values of rank 0, in portions of whole rows of `width` values; take(first row, values) everywhere.
template <class T, class Take>
void deal(const Communicator& communicator, const std::vector<T>& all, int width, const Take& take) {
  const std::size_t step = portion / static_cast<std::size_t>(width) * static_cast<std::size_t>(width);
  std::vector<std::int64_t> size{static_cast<std::int64_t>(all.size())};
  communicator.broadcast(size);
  for (std::size_t begin = 0; begin < static_cast<std::size_t>(size[0]); begin += step) {
    std::vector<T> values;
    if (communicator.rank() == 0) {
      const std::size_t end = std::min(all.size(), begin + step);
      values.assign(all.begin() + static_cast<std::ptrdiff_t>(begin), all.begin() + static_cast<std::ptrdiff_t>(end));
    }
    communicator.broadcast(values);
    take(begin / static_cast<std::size_t>(width), values);
  }
}

// Of a group's points on this rank, in the order of their ids: the place here, and the row in the file.
struct Row {
  std::size_t place, row;
};

// Collective. `known`: whether every point of this rank is in the file.
std::vector<Row> rows_of(const Communicator& communicator, const std::vector<std::int64_t>& ids,
                         const std::vector<std::int64_t>& in_file, bool& known) {
  const std::vector<std::size_t> order = order_by_id(ids);
  std::vector<Row> rows;
  std::size_t next = 0;
  deal(communicator, in_file, 1, [&](std::size_t first, const std::vector<std::int64_t>& sorted) {
    for (std::size_t n = 0; n < sorted.size() && next < order.size(); ++n) {
      if (sorted[n] == ids[order[next]]) rows.push_back({order[next++], first + n});
    }
  });
  known = known && rows.size() == ids.size();
  return rows;
}

void take_rows(const std::vector<Row>& rows, std::size_t first, const std::vector<double>& values,
               Snapshot::Column& column, std::size_t& next) {
  const auto width = static_cast<std::size_t>(column.width);
  for (; next < rows.size() && (rows[next].row - first + 1) * width <= values.size(); ++next) {
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>((rows[next].row - first) * width), width,
                column.values.begin() + static_cast<std::ptrdiff_t>(rows[next].place * width));
  }
}

}  // namespace

std::string read_checkpoint(const fs::path& path, const Communicator& communicator, Snapshot& snapshot) {
  std::vector<std::int64_t> counts;
  for (const Snapshot::Group& group : snapshot.groups) counts.push_back(communicator.sum(std::ssize(group.ids)));
  std::optional<NetcdfLists> file;
  std::string deck;
  run_on_root(communicator, [&] {
    file.emplace(opened(path));
    compare(path, *file, snapshot, counts);
    check_sum(path, *file, snapshot);
    deck = file->text("deck");
  });
  communicator.broadcast(deck);
  const auto from_root = [&](const auto& get) {
    auto values = decltype(get()){};
    run_on_root(communicator, [&] { values = get(); });
    return values;
  };
  for (auto& [name, value] : snapshot.numbers) {
    std::vector<double> one = from_root([&] { return std::vector<double>{file->number(name_of_number(name))}; });
    communicator.broadcast(one);
    value = one[0];
  }
  for (auto& [name, value] : snapshot.shares) {
    std::vector<double> of_ranks = from_root([&] { return file->reals(name_of_share(name)); });
    communicator.broadcast(of_ranks);
    const auto rank = static_cast<std::size_t>(communicator.rank());
    if (of_ranks.size() == static_cast<std::size_t>(communicator.size())) {
      value = of_ranks[rank];
    } else {
      value = rank == 0 ? std::accumulate(of_ranks.begin(), of_ranks.end(), 0.0) : 0;
    }
  }
  bool known = true;
  for (std::size_t g = 0; g < snapshot.groups.size(); ++g) {
    Snapshot::Group& group = snapshot.groups[g];
    const auto ids = from_root([&] { return file->integers(name_of_ids(g)); });
    const std::vector<Row> rows = rows_of(communicator, group.ids, ids, known);
    for (Snapshot::Column& column : group.columns) {
      const auto values = from_root([&] { return file->reals(name_of(g, column.name)); });
      std::size_t next = 0;
      deal(communicator, values, column.width, [&](std::size_t first, const std::vector<double>& portion) {
        take_rows(rows, first, portion, column, next);
      });
    }
  }
  raise_together(communicator, known ? "" : path.string() + ": is of another mesh: the ids of its points are others");
  return deck;
}

void remove_checkpoint(const fs::path& path, const Communicator& communicator) {
  run_on_root(communicator, [&] {
    std::error_code failure;
    fs::remove(part_of(path), failure);
    if (!fs::exists(path, failure)) return;
    const bool ours = fs::is_regular_file(path) && classic_netcdf_problem(path).empty() && !is_hdf5(path) &&
                      NetcdfLists::open(path).has_number(mark);
    if (!ours) {
      throw Error(path.string() + ": is no checkpoint of strut, and a run would replace it: expected another " +
                  "name in Restart > Filename");
    }
    fs::remove(path, failure);
    if (failure) throw Error(path.string() + ": cannot remove it: " + failure.message());
  });
}

}  // namespace strut::io

#include "io/restart_file.hpp"

#include <fcntl.h>
#include <netcdf.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <numeric>
#include <optional>

#include "base/build_facts.hpp"
#include "base/communicator.hpp"
#include "base/errors.hpp"
#include "io/classic_netcdf.hpp"
#include "io/rehearsal.hpp"

namespace strut::io {

namespace fs = std::filesystem;

namespace {

// Of the layout below: raise it with every change of what the file holds.
constexpr int version = 1;
constexpr const char* mark = "strut_restart";

constexpr std::size_t portion = std::size_t{1} << 20;  // values that are sent to the ranks at a time

std::string name_of_ids(std::size_t group) { return "g" + std::to_string(group) + "_id"; }
std::string name_of(std::size_t group, const std::string& column) { return "g" + std::to_string(group) + "_" + column; }
std::string name_of_share(const std::string& name) { return "share_" + name; }
std::string name_of_number(const std::string& name) { return "number_" + name; }

// FNV-1a of all that is written, word by word: a disk or a copy that has changed a bit is found out.
class Sum {
 public:
  template <class T>
  void add(const std::vector<T>& values) {
    static_assert(sizeof(T) == 8);
    for (const T& value : values) {
      std::uint64_t word;
      std::memcpy(&word, &value, 8);
      sum_ = (sum_ ^ word) * 0x100000001b3u;
    }
  }
  double value() const { return static_cast<double>(sum_ >> 12); }

 private:
  std::uint64_t sum_ = 0xcbf29ce484222325u;
};

// A netCDF file of the classic model with 64-bit sizes: plain, and whole or recognisably not.
class File {
 public:
  static File create(const fs::path& path) {
    File file(path);
    file.check(nc_create(path.c_str(), NC_64BIT_DATA | NC_CLOBBER, &file.handle_), "create it");
    nc_set_fill(file.handle_, NC_NOFILL, nullptr);
    return file;
  }
  static File open(const fs::path& path) {
    File file(path);
    file.check(nc_open(path.c_str(), NC_NOWRITE, &file.handle_), "open it");
    return file;
  }
  ~File() {
    if (handle_ >= 0) nc_abort(handle_);
  }
  File(File&& other) noexcept : path_(std::move(other.path_)), handle_(std::exchange(other.handle_, -1)) {}

  void put_text(const std::string& name, const std::string& text) const {
    check(nc_put_att_text(handle_, NC_GLOBAL, name.c_str(), text.size(), text.c_str()), "write '" + name + "'");
  }
  std::string text(const std::string& name) const {
    std::size_t length = 0;
    check(nc_inq_attlen(handle_, NC_GLOBAL, name.c_str(), &length), "find '" + name + "' in it");
    std::string text(length, '\0');
    check(nc_get_att_text(handle_, NC_GLOBAL, name.c_str(), text.data()), "read '" + name + "'");
    return text;
  }
  void put_number(const std::string& name, double value) const {
    check(nc_put_att_double(handle_, NC_GLOBAL, name.c_str(), NC_DOUBLE, 1, &value), "write '" + name + "'");
  }
  double number(const std::string& name) const {
    double value = 0;
    std::size_t length = 0;
    check(nc_inq_attlen(handle_, NC_GLOBAL, name.c_str(), &length), "find '" + name + "' in it");
    if (length != 1) throw Error(path_.string() + ": damaged: '" + name + "' is not one number");
    check(nc_get_att_double(handle_, NC_GLOBAL, name.c_str(), &value), "read '" + name + "'");
    return value;
  }

  // A variable of so many values; of none there is no variable (a size of 0 would mean one that grows).
  void define(const std::string& name, nc_type type, std::size_t size) const {
    if (size == 0) return;
    int dimension = 0, variable = 0;
    check(nc_def_dim(handle_, ("of_" + name).c_str(), size, &dimension), "define '" + name + "'");
    check(nc_def_var(handle_, name.c_str(), type, 1, &dimension, &variable), "define '" + name + "'");
  }
  void end_definitions() const { check(nc_enddef(handle_), "write its header"); }
  void put(const std::string& name, const std::vector<double>& values) const {
    if (!values.empty()) check(nc_put_var_double(handle_, variable(name), values.data()), "write '" + name + "'");
  }
  void put(const std::string& name, const std::vector<long long>& values) const {
    if (!values.empty()) check(nc_put_var_longlong(handle_, variable(name), values.data()), "write '" + name + "'");
  }
  std::vector<double> values(const std::string& name) const {
    std::vector<double> values(size(name));
    if (!values.empty()) check(nc_get_var_double(handle_, variable(name), values.data()), "read '" + name + "'");
    return values;
  }
  std::vector<long long> integers(const std::string& name) const {
    std::vector<long long> values(size(name));
    if (!values.empty()) check(nc_get_var_longlong(handle_, variable(name), values.data()), "read '" + name + "'");
    return values;
  }
  bool has(const std::string& name) const {
    int number = 0;
    return nc_inq_varid(handle_, name.c_str(), &number) == NC_NOERR;
  }
  // Of a variable; 0 where there is none.
  std::size_t size(const std::string& name) const {
    if (!has(name)) return 0;
    int dimension = 0;
    int rank = 0;
    std::size_t size = 0;
    check(nc_inq_varndims(handle_, variable(name), &rank), "read the size of '" + name + "'");
    if (rank != 1) throw Error(path_.string() + ": damaged: '" + name + "' is not a list");
    check(nc_inq_vardimid(handle_, variable(name), &dimension), "read the size of '" + name + "'");
    check(nc_inq_dimlen(handle_, dimension, &size), "read the size of '" + name + "'");
    return size;
  }
  int variables() const {
    int count = 0;
    check(nc_inq_nvars(handle_, &count), "count its lists");
    return count;
  }
  bool has_attribute(const std::string& name) const {
    return nc_inq_attid(handle_, NC_GLOBAL, name.c_str(), nullptr) == NC_NOERR;
  }
  void close() { check(nc_close(std::exchange(handle_, -1)), "close it"); }

 private:
  explicit File(fs::path path) : path_(std::move(path)) {}

  int variable(const std::string& name) const {
    int number = 0;
    check(nc_inq_varid(handle_, name.c_str(), &number), "find '" + name + "' in it");
    return number;
  }
  // Positive codes are the system's.
  void check(int code, const std::string& doing) const {
    if (code == NC_NOERR) return;
    throw Error(path_.string() + ": cannot " + doing + ": " + (code > 0 ? std::strerror(code) : nc_strerror(code)));
  }

  fs::path path_;
  int handle_ = -1;
};

// What is in the file is on the disk.
void sync(const fs::path& path) {
  const int handle = ::open(path.c_str(), O_RDONLY);
  const bool good = handle >= 0 && ::fsync(handle) == 0;
  const int why = errno;
  if (handle >= 0) ::close(handle);
  if (!good) throw Error(path.string() + ": cannot write it to disk: " + std::strerror(why));
}

void replace(const fs::path& path, const fs::path& part) {
  sync(part);
  std::error_code failure;
  fs::rename(part, path, failure);
  if (failure) throw Error(path.string() + ": cannot replace it: " + failure.message());
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY);
  if (handle >= 0) ::fsync(handle), ::close(handle);  // some file systems cannot; then they need not
}

fs::path part_of(const fs::path& path) { return path.string() + ".part"; }

// Rank 0's part of what all ranks do: after a failure it goes on taking part, so that no rank waits for it.
class OnRoot {
 public:
  explicit OnRoot(const Communicator& communicator) : communicator_(communicator) {}

  template <class Action>
  void operator()(Action&& action) {
    if (communicator_.rank() != 0 || !problem_.empty()) return;
    try {
      action();
    } catch (const std::exception& error) {
      problem_ = error.what();
    }
  }
  const std::string& problem() const { return problem_; }
  void raise() const { raise_together(communicator_, problem_); }

 private:
  const Communicator& communicator_;
  std::string problem_;
};

std::vector<std::size_t> order_by_id(const std::vector<std::int64_t>& ids) {
  std::vector<std::size_t> order(ids.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&ids](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
  return order;
}

// The layout, on rank 0: of the groups, how many points all ranks have of each.
void define(const File& file, const Snapshot& snapshot, const std::vector<std::size_t>& sizes, int ranks,
            const std::string& deck) {
  file.put_number(mark, version);
  file.put_text("written_by", build_facts());
  file.put_text("deck", deck);
  for (const auto& [name, value] : snapshot.numbers) file.put_number(name_of_number(name), value);
  for (const auto& [name, value] : snapshot.shares) file.define(name_of_share(name), NC_DOUBLE, ranks);
  for (std::size_t g = 0; g < snapshot.groups.size(); ++g) {
    file.define(name_of_ids(g), NC_INT64, sizes[g]);
    for (const Snapshot::Column& column : snapshot.groups[g].columns) {
      file.define(name_of(g, column.name), NC_DOUBLE, sizes[g] * static_cast<std::size_t>(column.width));
    }
  }
  file.define("sum", NC_DOUBLE, 1);
  file.end_definitions();
}

std::vector<double> arranged(const std::vector<double>& values, const std::vector<std::size_t>& order, int width) {
  std::vector<double> result;
  result.reserve(values.size());
  for (const std::size_t place : order) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(place * static_cast<std::size_t>(width));
    result.insert(result.end(), begin, begin + width);
  }
  return result;
}

// Collective. Everything into `file`, which only rank 0 has.
void fill(std::optional<File>& file, const Communicator& communicator, const Snapshot& snapshot,
          const std::string& deck, const fs::path& part, OnRoot& on_root) {
  std::vector<std::vector<std::int64_t>> ids;
  std::vector<std::size_t> sizes;
  for (const Snapshot::Group& group : snapshot.groups) {
    ids.push_back(communicator.gather(std::span(group.ids)));
    sizes.push_back(ids.back().size());
  }
  Sum sum;
  on_root([&] {
    file.emplace(File::create(part));
    define(*file, snapshot, sizes, communicator.size(), deck);
  });
  const auto put = [&](const std::string& name, const auto& values) {
    file->put(name, values);
    sum.add(values);
  };
  for (const auto& [name, value] : snapshot.numbers) sum.add(std::vector<double>{value});
  for (const auto& [name, value] : snapshot.shares) {
    const std::vector<double> of_ranks = communicator.gather(std::span(&value, 1));
    on_root([&] { put(name_of_share(name), of_ranks); });
  }
  for (std::size_t g = 0; g < snapshot.groups.size(); ++g) {
    const std::vector<std::size_t> order = order_by_id(ids[g]);
    std::vector<long long> sorted;
    for (const std::size_t place : order) sorted.push_back(ids[g][place]);
    on_root([&] { put(name_of_ids(g), sorted); });
    for (const Snapshot::Column& column : snapshot.groups[g].columns) {
      const std::vector<double> values = communicator.gather(std::span(column.values));
      on_root([&] { put(name_of(g, column.name), arranged(values, order, column.width)); });
    }
  }
  on_root([&] {
    file->put("sum", std::vector<double>{sum.value()});
    file->close();
  });
}

// ---- reading

File opened(const fs::path& path) {
  std::error_code failure;
  if (!fs::exists(path, failure)) throw Error(path.string() + ": there is no such file");
  if (const std::string problem = classic_netcdf_problem(path); !problem.empty()) {
    throw Error(path.string() + ": not a restart file, or damaged: " + problem);
  }
  if (is_hdf5(path)) throw Error(path.string() + ": is no restart file of strut");  // which HDF5 might not survive
  File file = File::open(path);
  if (!file.has_attribute(mark)) throw Error(path.string() + ": is no restart file of strut");
  if (const double found = file.number(mark); found != version) {
    throw Error(path.string() + ": has version " + std::to_string(static_cast<int>(found)) + "; this strut reads " +
                std::to_string(version) + " (" + build_facts() + ", the file is by " + file.text("written_by") + ")");
  }
  return file;
}

[[noreturn]] void differs(const fs::path& path, const std::string& what) {
  throw Error(path.string() + ": is of another deck or mesh: " + what +
              ". A run can go on with another final time, output or restart, not with another model");
}

// That the file has what the snapshot has. The numbers of points are those over all ranks.
void compare(const fs::path& path, const File& file, const Snapshot& snapshot,
             const std::vector<std::int64_t>& counts) {
  int lists = 1 + static_cast<int>(snapshot.shares.size());  // with the check sum
  for (const auto& [name, value] : snapshot.numbers) {
    if (!file.has_attribute(name_of_number(name))) differs(path, "it has no number '" + name + "'");
  }
  for (const auto& [name, value] : snapshot.shares) {
    if (!file.has(name_of_share(name))) differs(path, "it has no number '" + name + "'");
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
  if (file.variables() != lists) {
    differs(path, "it has " + std::to_string(file.variables()) + " lists of numbers; the deck asks for " +
                      std::to_string(lists));
  }
}

void check_sum(const fs::path& path, const File& file, const Snapshot& snapshot) {
  Sum sum;
  for (const auto& [name, value] : snapshot.numbers) sum.add(std::vector<double>{file.number(name_of_number(name))});
  for (const auto& [name, value] : snapshot.shares) sum.add(file.values(name_of_share(name)));
  for (std::size_t g = 0; g < snapshot.groups.size(); ++g) {
    sum.add(file.integers(name_of_ids(g)));
    for (const Snapshot::Column& column : snapshot.groups[g].columns) sum.add(file.values(name_of(g, column.name)));
  }
  if (file.values("sum") != std::vector<double>{sum.value()}) {
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
                         const std::vector<long long>& in_file, bool& known) {
  const std::vector<std::size_t> order = order_by_id(ids);
  std::vector<Row> rows;
  std::size_t next = 0;
  deal(communicator, in_file, 1, [&](std::size_t first, const std::vector<long long>& sorted) {
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

void write_restart(const fs::path& path, const Communicator& communicator, const Snapshot& snapshot,
                   const std::string& deck) {
  std::optional<File> file;
  OnRoot on_root(communicator);
  fill(file, communicator, snapshot, deck, part_of(path), on_root);
  on_root([&] { replace(path, part_of(path)); });
  if (!on_root.problem().empty()) {
    file.reset();
    std::error_code ignored;
    fs::remove(part_of(path), ignored);
  }
  on_root.raise();
}

std::string read_restart(const fs::path& path, const Communicator& communicator, Snapshot& snapshot) {
  std::vector<std::int64_t> counts;
  for (const Snapshot::Group& group : snapshot.groups) counts.push_back(communicator.sum(std::ssize(group.ids)));
  std::optional<File> file;
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
    std::vector<double> of_ranks = from_root([&] { return file->values(name_of_share(name)); });
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
      const auto values = from_root([&] { return file->values(name_of(g, column.name)); });
      std::size_t next = 0;
      deal(communicator, values, column.width, [&](std::size_t first, const std::vector<double>& portion) {
        take_rows(rows, first, portion, column, next);
      });
    }
  }
  raise_together(communicator, known ? "" : path.string() + ": is of another mesh: the ids of its points are others");
  return deck;
}

void remove_restart(const fs::path& path, const Communicator& communicator) {
  run_on_root(communicator, [&] {
    std::error_code failure;
    fs::remove(part_of(path), failure);
    if (!fs::exists(path, failure)) return;
    const bool ours = fs::is_regular_file(path) && classic_netcdf_problem(path).empty() && !is_hdf5(path) &&
                      File::open(path).has_attribute(mark);
    if (!ours) {
      throw Error(path.string() + ": is no restart file of strut, and a run would replace it: expected another " +
                  "name in Restart > Filename");
    }
    fs::remove(path, failure);
    if (failure) throw Error(path.string() + ": cannot remove it: " + failure.message());
  });
}

}  // namespace strut::io

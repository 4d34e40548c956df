#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <sstream>

#include "base/build_facts.hpp"
#include "base/errors.hpp"
#include "base/files.hpp"
#include "base/parallel/communicator.hpp"
#include "base/parallel/gather_scatter.hpp"
#include "io/check_sum.hpp"
#include "io/checkpoint/checkpoint_file.hpp"
#include "io/checkpoint/checkpoint_layout.hpp"
#include "io/netcdf/classic_netcdf.hpp"
#include "io/netcdf/netcdf_lists.hpp"
#include "io/on_root.hpp"
#include "io/slices.hpp"

namespace strut::io {

namespace fs = std::filesystem;
using namespace checkpoint_layout;

namespace {

NetcdfLists opened(const fs::path& path) {
  std::error_code failure;
  if (!fs::exists(path, failure)) throw Error(path.string() + ": there is no such file");
  if (const std::string problem = classic_netcdf_problem(path); !problem.empty()) {
    throw Error(path.string() + ": not a checkpoint, or damaged: " + problem);
  }
  if (is_hdf5(path)) throw Error(path.string() + ": is no checkpoint of strut");  // HDF5 might crash on it
  NetcdfLists file = NetcdfLists::open(path);
  if (!file.has_number(checkpoint_mark)) throw Error(path.string() + ": is no checkpoint of strut");
  if (const double found = file.number(checkpoint_mark); found != version) {
    throw Error(path.string() + ": has version " + std::to_string(static_cast<int>(found)) + "; this strut reads " +
                std::to_string(version) + " (" + build_facts() + ", the file is by " + file.text("written_by") + ")");
  }
  return file;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

[[noreturn]] void differs(const fs::path& path, const std::string& what) {
  throw Error(path.string() + ": is of another deck or mesh: " + what +
              ". A run can go on with another final time, and other times of output, not with another model");
}

// The checksum of a list, read in portions.
template <class T>
double sum_of(const NetcdfLists& file, const std::string& name) {
  const std::size_t size = file.size(name);
  CheckSum sum;
  std::vector<T> values;
  for (std::size_t begin = 0; begin < size; begin += values.size()) {
    values.resize(std::min(largest_portion, size - begin));
    file.get(name, values, static_cast<std::int64_t>(begin));
    sum.add(std::span<const T>(values));
  }
  return sum.value();
}

// The check sum of the deck and of all numbers of the file, whether or not the snapshot asks for them.
double sum_of_head(const NetcdfLists& file) {
  CheckSum sum;
  sum.add(file.text("deck"));
  for (const std::string& name : lines_of(file.text(name_of_numbers))) sum.add(file.number(name_of_number(name)));
  return sum.value();
}

// The lists of a file, on rank 0, and what a snapshot, which may be of another deck, asks of them.
class PartsOfFile {
 public:
  PartsOfFile(const fs::path& path, const NetcdfLists& file)
      : path_(path),
        file_(file),
        groups_(lines_of(file.text(name_of_groups))),
        lists_(lines_of(file.text(name_of_lists))),
        sums_(file.reals(name_of_sums)) {
    if (sums_.size() != 1 + lists_.size() || sums_[0] != sum_of_head(file)) damaged("its numbers");
  }

  // The number of the group in the file, −1: it is not there.
  int group(const std::string& name) const {
    const auto found = std::find(groups_.begin(), groups_.end(), name);
    return found == groups_.end() ? -1 : static_cast<int>(found - groups_.begin());
  }
  // True if the list is there; throws Error if it is damaged.
  template <class T>
  bool has(const std::string& list) const {
    const auto found = std::find(lists_.begin(), lists_.end(), list);
    if (found == lists_.end()) return false;
    if (sums_[1 + (found - lists_.begin())] != sum_of<T>(file_, list)) damaged(in_words(list));
    return true;
  }

  // Throws Error unless the file has all that the snapshot asks for, and no more.
  void expect(const Snapshot& snapshot, const std::vector<std::int64_t>& counts) const {
    for (std::size_t g = 0; g < snapshot.groups.size(); ++g) {
      const std::string there = g < groups_.size() ? groups_[g] : "nothing", &here = snapshot.groups[g].name;
      if (there != here)
        differs(path_, "it has the points of '" + there + "' where the deck's mesh has '" + here + "'");
    }
    std::vector<std::string> missing;
    compare(
        snapshot, counts, [](const std::string&) { return true; }, missing);
    if (!missing.empty()) differs(path_, "it has no '" + joined(missing, "', '") + "' that fits");
    if (lists_ != lists_of(snapshot)) differs(path_, "it has lists of numbers that the deck does not ask for");
  }
  // Throws Error if any list is damaged.
  void check_all() const {
    std::set<std::string> ids;
    for (std::size_t g = 0; g < groups_.size(); ++g) ids.insert(name_of_ids(g));
    for (const std::string& list : lists_) ids.contains(list) ? has<std::int64_t>(list) : has<double>(list);
  }

  // Adds the names that the snapshot asks for and the file lacks to `missing`; returns the numbers of its groups there.
  std::vector<int> compare(const Snapshot& snapshot, const std::vector<std::int64_t>& counts, const Takes& takes,
                           std::vector<std::string>& missing) const {
    for (const auto& [name, value] : snapshot.numbers) {
      if (takes(name) && !file_.has_number(name_of_number(name))) missing.push_back(name);
    }
    for (const auto& [name, value] : snapshot.rank_sums) {
      if (takes(name) && !has<double>(name_of_rank_sum(name))) missing.push_back(name);
    }
    std::vector<int> groups;
    for (std::size_t g = 0; g < snapshot.groups.size(); ++g) {
      groups.push_back(group(snapshot.groups[g].name));
      compare(snapshot.groups[g], counts[g], groups.back(), takes, missing);
    }
    return groups;
  }

 private:
  void compare(const Snapshot::Group& group, std::int64_t count, int g, const Takes& takes,
               std::vector<std::string>& missing) const {
    if (g >= 0 && has<std::int64_t>(name_of_ids(g)) && file_.size(name_of_ids(g)) != static_cast<std::size_t>(count)) {
      throw Error(path_.string() + ": is of another mesh: " + group.name + ": " +
                  std::to_string(file_.size(name_of_ids(g))) + " points there, " + std::to_string(count) + " here");
    }
    for (const Snapshot::Column& column : group.columns) {
      const std::string name = group.name + " > " + column.name;
      if (!takes(name)) continue;
      const bool there = g >= 0 && has<double>(name_of(g, column.name)) &&
                         file_.size(name_of(g, column.name)) == static_cast<std::size_t>(count * column.width);
      if (!there) missing.push_back(name);
    }
  }
  // "'velocity' of all points".
  std::string in_words(const std::string& list) const {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const std::string begin = name_of(g, "");
      if (list.starts_with(begin)) return "'" + list.substr(begin.size()) + "' of " + groups_[g];
    }
    const std::string prefix = name_of_rank_sum("");
    return "'" + (list.starts_with(prefix) ? list.substr(prefix.size()) : list) + "'";
  }
  [[noreturn]] void damaged(const std::string& what) const {
    throw Error(path_.string() + ": is damaged: the check sum of " + what + " is not that of its contents");
  }

  const fs::path& path_;
  const NetcdfLists& file_;
  std::vector<std::string> groups_, lists_;
  std::vector<double> sums_;
};

// Collective. Sends each rank its slice of a list with `width` values per point (scatterv).
template <class T>
std::vector<T> dealt(const Communicator& communicator, const std::optional<NetcdfLists>& file, const std::string& name,
                     std::vector<std::int64_t> counts, int width, OnRoot& on_root) {
  for (std::int64_t& count : counts) count *= width;
  return scatterv<T>(communicator, counts, [&](std::int64_t begin, std::span<T> values) {
    on_root([&] { file->get(name, values, begin); });
  });
}

// Collective. Reads the columns of a group: each rank gets a slice and passes it on to the points, so that it never has
// more than its slice and its points. Returns false if the file has other points. `g`: its number in the file.
template <class IsWanted>
bool restore(const Communicator& communicator, const std::optional<NetcdfLists>& file, std::size_t g,
             const IsWanted& is_wanted, Snapshot::Group& group) {
  const Slices slices(communicator, group.ids);
  OnRoot on_root(communicator);
  const auto ids = dealt<std::int64_t>(communicator, file, name_of_ids(g), slices.counts(), 1, on_root);
  for (Snapshot::Column& column : group.columns) {
    if (!is_wanted(column)) continue;
    const auto rows =
        dealt<double>(communicator, file, name_of(g, column.name), slices.counts(), column.width, on_root);
    slices.rows_from_slices<double>(rows, column.width, column.values);
  }
  on_root.raise();
  return ids == slices.ids();
}

template <class Get>
std::vector<double> from_root(const Communicator& communicator, const Get& get) {
  std::vector<double> values;
  run_on_root(communicator, [&] { values = get(); });
  communicator.broadcast(values);
  return values;
}

double number(const Communicator& communicator, const std::optional<NetcdfLists>& file, const std::string& name) {
  return from_root(communicator, [&] { return std::vector<double>{file->number(name_of_number(name))}; })[0];
}

double rank_sum(const Communicator& communicator, const std::optional<NetcdfLists>& file, const std::string& name) {
  const std::vector<double> of_ranks = from_root(communicator, [&] { return file->reals(name_of_rank_sum(name)); });
  if (of_ranks.size() == static_cast<std::size_t>(communicator.size())) return of_ranks[communicator.rank()];
  return communicator.rank() == 0 ? std::accumulate(of_ranks.begin(), of_ranks.end(), 0.0) : 0;
}

// Calls open() for the newest file; if that fails and there is a previous one, for that. If both fail, throws the first
// error.
template <class Open>
void open_either(const fs::path& newest, fs::path& path, const Open& open, std::string& note) {
  try {
    return open();
  } catch (const Error& error) {
    note = error.what();
  }
  try {
    path = before_of(newest);
    open();
  } catch (const Error&) {
    throw Error(note);
  }
  note += "; going on from the one before, " + path.string();
}

// Collective. Fills the snapshot's numbers and columns whose names are wanted. `groups`: the numbers of its groups in
// the file, −1 for one that is not there.
void fill(const Communicator& communicator, const fs::path& path, const std::optional<NetcdfLists>& file,
          const std::vector<int>& groups, const Takes& wanted, Snapshot& snapshot) {
  for (auto& [name, value] : snapshot.numbers) {
    if (wanted(name)) value = number(communicator, file, name);
  }
  for (auto& [name, value] : snapshot.rank_sums) {
    if (wanted(name)) value = rank_sum(communicator, file, name);
  }
  bool known = true;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    Snapshot::Group& group = snapshot.groups[g];
    const auto is_wanted = [&](const Snapshot::Column& column) { return wanted(group.name + " > " + column.name); };
    const bool any = groups[g] >= 0 && (group.columns.empty() || std::ranges::any_of(group.columns, is_wanted));
    known = (!any || restore(communicator, file, groups[g], is_wanted, group)) && known;
  }
  raise_together(communicator, known ? "" : path.string() + ": is of another mesh: the ids of its points are others");
}

}  // namespace

std::string read_checkpoint(const fs::path& newest, const Communicator& communicator, Snapshot& snapshot) {
  std::vector<std::int64_t> counts;
  for (const Snapshot::Group& group : snapshot.groups) counts.push_back(communicator.sum(std::ssize(group.ids)));
  std::optional<NetcdfLists> file;
  fs::path path = newest;
  std::string note;  // on rank 0
  const auto open = [&] {
    NetcdfLists found = opened(path);
    PartsOfFile(path, found).expect(snapshot, counts);
    file.emplace(std::move(found));
  };
  run_on_root(communicator, [&] { open_either(newest, path, open, note); });
  std::vector<int> groups(snapshot.groups.size());
  std::iota(groups.begin(), groups.end(), 0);
  fill(
      communicator, path, file, groups, [](const std::string&) { return true; }, snapshot);
  return note;
}

std::vector<std::string> read_checkpoint_parts(const CheckpointFacts& facts, const Communicator& communicator,
                                               const Takes& takes, Snapshot& snapshot) {
  std::vector<std::int64_t> counts;
  for (const Snapshot::Group& group : snapshot.groups) counts.push_back(communicator.sum(std::ssize(group.ids)));
  std::optional<NetcdfLists> file;
  std::vector<std::string> names;
  std::vector<int> groups;  // their numbers in the file
  run_on_root(communicator, [&] {
    file.emplace(opened(facts.file));
    if (file->number(name_of_number("time")) != facts.time) {
      throw Error(facts.file.string() + ": its run has replaced it meanwhile; expected a run that has ended");
    }
    groups = PartsOfFile(facts.file, *file).compare(snapshot, counts, takes, names);
  });
  communicator.broadcast(groups);
  names = broadcast_names(std::move(names), communicator);
  const std::set<std::string> missing(names.begin(), names.end());
  const auto is_there = [&](const std::string& name) { return takes(name) && !missing.contains(name); };
  fill(communicator, facts.file, file, groups, is_there, snapshot);
  return names;
}

bool checkpoint_is_there(const fs::path& path) {
  std::error_code failure;
  return fs::exists(path, failure) || fs::exists(before_of(path), failure);
}

CheckpointFacts facts_of_checkpoint(const fs::path& path, const Communicator& communicator) {
  CheckpointFacts facts{.file = path};
  run_on_root(communicator, [&] {
    const auto read = [&] {
      const NetcdfLists file = opened(facts.file);
      const PartsOfFile parts(facts.file, file);
      parts.check_all();
      facts.has_expanded = parts.has<double>(name_of(std::max(0, parts.group("all points")), "thermal_strain"));
      facts.deck = file.text("deck"), facts.time = file.number(name_of_number("time"));
      if (file.number(name_of_deck_sum) == sum_of_deck(facts.deck)) return;
      throw Error(facts.file.string() + ": is damaged: the check sum of its deck is not that of its contents");
    };
    open_either(path, facts.file, read, facts.note);
  });
  std::string file = facts.file.string();
  communicator.broadcast(file);
  facts.file = file;
  communicator.broadcast(facts.deck);
  facts.has_expanded = communicator.any(facts.has_expanded);
  facts.time = communicator.max(communicator.rank() == 0 ? facts.time : -std::numeric_limits<double>::infinity());
  return facts;
}

void remove_checkpoint(const fs::path& path, const Communicator& communicator) {
  run_on_root(communicator, [&] {
    for (const fs::path& file : {part_of(path), before_of(path), path}) {
      std::error_code failure;
      if (!fs::exists(file, failure)) continue;
      if (!fs::is_regular_file(file) || !is_of_kind(file, FileKind::checkpoint)) {
        throw Error(file.string() + ": is no checkpoint of strut, and a run would replace it: expected another " +
                    "name in Restart > Filename");
      }
      fs::remove(file, failure);
      if (failure) throw Error(file.string() + ": cannot remove it: " + failure.message());
    }
  });
}

}  // namespace strut::io

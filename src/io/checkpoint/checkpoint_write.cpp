#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>

#include "base/build_facts.hpp"
#include "base/errors.hpp"
#include "base/files.hpp"
#include "base/parallel/communicator.hpp"
#include "io/check_sum.hpp"
#include "io/checkpoint/checkpoint_file.hpp"
#include "io/checkpoint/checkpoint_layout.hpp"
#include "io/netcdf/netcdf_lists.hpp"
#include "io/on_root.hpp"
#include "io/slices.hpp"

namespace strut::io {

namespace fs = std::filesystem;
using namespace checkpoint_layout;

namespace {

// Keeps the previous file under another name. Without hard links the file has only that name for a moment.
void keep_before(const fs::path& path) {
  std::error_code failure;
  if (!fs::exists(path, failure)) return;
  fs::remove(before_of(path), failure);
  fs::create_hard_link(path, before_of(path), failure);
  if (failure) fs::rename(path, before_of(path), failure);
}

void replace(const fs::path& path, const fs::path& part) {
  force_to_disk(part);
  keep_before(path);
  std::error_code failure;
  fs::rename(part, path, failure);
  if (failure) throw Error(path.string() + ": cannot replace it: " + failure.message());
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY);
  if (handle >= 0) ::fsync(handle), ::close(handle);  // some file systems cannot sync; then it is not needed
}

template <class Names, class NameOf>
std::string lines(const Names& names, const NameOf& name_of) {
  std::string text;
  for (const auto& one : names) text += name_of(one) + "\n";
  return text;
}

// Defines the layout, on rank 0. `sizes`: number of points of each group over all ranks.
void define(const NetcdfLists& file, const Snapshot& snapshot, const std::vector<std::size_t>& sizes, int ranks,
            const std::string& deck) {
  const std::vector<std::string> lists = lists_of(snapshot);
  file.define(name_of_sums, NetcdfLists::Of::reals, 1 + lists.size());
  file.put(checkpoint_mark, double{version});
  file.put("written_by", build_facts());
  file.put("deck", deck);
  file.put(name_of_deck_sum, sum_of_deck(deck));
  file.put(name_of_numbers, lines(snapshot.numbers, [](const auto& one) { return one.first; }));
  file.put(name_of_groups, lines(snapshot.groups, [](const Snapshot::Group& one) { return one.name; }));
  file.put(name_of_lists, lines(lists, [](const std::string& one) { return one; }));
  for (const auto& [name, value] : snapshot.numbers) file.put(name_of_number(name), value);
  for (const auto& [name, value] : snapshot.rank_sums)
    file.define(name_of_rank_sum(name), NetcdfLists::Of::reals, ranks);
  for (std::size_t g = 0; g < snapshot.groups.size(); ++g) {
    file.define(name_of_ids(g), NetcdfLists::Of::integers, sizes[g]);
    for (const Snapshot::Column& column : snapshot.groups[g].columns) {
      file.define(name_of(g, column.name), NetcdfLists::Of::reals, sizes[g] * static_cast<std::size_t>(column.width));
    }
  }
  file.end_definitions();
}

// Collective. Writes everything to `file`, which only rank 0 has open: no rank has more than its slice of a column.
void fill(std::optional<NetcdfLists>& file, const Communicator& communicator, const Snapshot& snapshot,
          const std::string& deck, const fs::path& part, OnRoot& on_root) {
  std::vector<std::size_t> sizes;
  for (const Snapshot::Group& group : snapshot.groups) {
    sizes.push_back(static_cast<std::size_t>(communicator.sum(std::ssize(group.ids))));
  }
  CheckSum head;
  head.add(deck);
  for (const auto& [name, value] : snapshot.numbers) head.add(value);
  std::vector<double> sums = {head.value()};
  on_root([&] {
    file.emplace(NetcdfLists::create(part));
    define(*file, snapshot, sizes, communicator.size(), deck);
  });
  const auto put = [&]<class T>(const std::string& name, std::span<const T> mine) {
    std::int64_t begin = 0;
    CheckSum sum;
    gatherv(communicator, mine, [&](std::span<const T> portion) {
      on_root([&] { file->put(name, portion, begin); });
      sum.add(portion);
      begin += std::ssize(portion);
    });
    sums.push_back(sum.value());
  };
  for (const auto& [name, value] : snapshot.rank_sums) put(name_of_rank_sum(name), std::span(&value, 1));
  for (std::size_t g = 0; g < snapshot.groups.size(); ++g) {
    const Slices slices(communicator, snapshot.groups[g].ids);
    put(name_of_ids(g), std::span(slices.ids()));
    for (const Snapshot::Column& column : snapshot.groups[g].columns) {
      const std::vector<double> rows = slices.rows_to_slices(std::span(column.values), column.width);
      put(name_of(g, column.name), std::span(rows));
    }
  }
  on_root([&] {
    file->put(name_of_sums, sums);
    file->close();
  });
}

}  // namespace

void write_checkpoint(const fs::path& path, const Communicator& communicator, const Snapshot& snapshot,
                      const std::string& deck) {
  std::optional<NetcdfLists> file;
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

}  // namespace strut::io

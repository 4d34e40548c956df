#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <set>

#include "base/errors.hpp"
#include "base/files.hpp"
#include "base/numbers.hpp"
#include "base/parallel/gather_scatter.hpp"
#include "io/exodus/exodus.hpp"
#include "io/on_root.hpp"
#include "io/slices.hpp"

namespace strut::io {

namespace {

struct Line {
  std::array<double, 3> position = {};
  int block = 0;
  double volume = 0;
};

// Parses a line; returns the error, or "".
std::string parse(const std::string& text, Line& line) {
  const std::vector<std::string> words = to_words(text);
  if (text.find('\0') != std::string::npos) return "expected a text, found a byte 0";
  if (words.size() != 5) {
    return "expected 5 columns (x y z block volume), found " + std::to_string(words.size()) +
           (trimmed(text).find('\r') != std::string_view::npos ? " and lines that end in CR alone" : "");
  }
  double numbers[5] = {};
  for (int i = 0; i < 5; ++i) {
    const auto number = to_finite(words[i]);
    if (!number) return "'" + words[i] + "' is not a finite number";
    numbers[i] = *number;
  }
  if (numbers[3] != std::floor(numbers[3]) || std::abs(numbers[3]) > 1e9) {
    return "block '" + words[3] + "' is not an integer";
  }
  if (numbers[4] <= 0) return "volume " + words[4] + " m³ is not positive";
  line = {{numbers[0], numbers[1], numbers[2]}, static_cast<int>(numbers[3]), numbers[4]};
  return "";
}

// The points of a file, read in order.
class TextFile {
 public:
  explicit TextFile(std::filesystem::path path) : path_(std::move(path)) {
    if (const std::string why = unreadable(path_); !why.empty()) throw Error(why);
    file_.open(path_);
  }

  // The next points, `most` at most; empty at the end.
  std::vector<Line> next(std::size_t most) {
    std::vector<Line> lines;
    std::string text;
    while (lines.size() < most && std::getline(file_, text)) {
      if (++number_ == 1) text = without_mark(text);
      const std::string content = text.substr(0, text.find('#'));
      if (content.find_first_not_of(" \t\r") == std::string::npos) continue;
      if (is_header(content)) continue;
      const std::string problem = parse(content, lines.emplace_back());
      if (problem.empty()) continue;
      throw Error(path_.string() + ", line " + std::to_string(number_) + ": " + problem + ": \"" + text.substr(0, 120) +
                  "\"");
    }
    return lines;
  }

 private:
  // True for the line that names the columns, with which PeriLab's lists begin. Throws Error if they are not strut's.
  bool is_header(const std::string& content) const {
    const std::vector<std::string> words = to_words(content);
    if (words[0] != "header:") return false;
    if (words == std::vector<std::string>{"header:", "x", "y", "z", "block_id", "volume"}) return true;
    const bool is_flat = std::ranges::find(words, "z") == words.end();
    throw Error(path_.string() + ", line " + std::to_string(number_) + ": " +
                (is_flat ? "two-dimensional problems are not there; " : "") +
                "expected the columns x y z block_id volume, no more: \"" + content.substr(0, 120) + "\"");
  }

  std::filesystem::path path_;
  std::ifstream file_;
  std::size_t number_ = 0;  // of the line
};

// A rank's part of the points, in the order of the lines.
struct Part {
  std::vector<std::int64_t> ids;
  std::vector<Line> lines;
};

// Collective. Sends portions to the ranks in turn, because the number of points is not known yet.
Part dealt(const std::filesystem::path& path, const Communicator& communicator) {
  std::optional<TextFile> file;
  run_on_root(communicator, [&] { file.emplace(path); });
  Part mine;
  std::int64_t first = 0;
  OnRoot on_root(communicator);
  for (int turn = 0;; turn = (turn + 1) % communicator.size()) {
    std::vector<Line> lines;
    on_root([&] { lines = file->next(largest_portion); });
    std::vector<std::int64_t> counts(static_cast<std::size_t>(communicator.size()), 0), size{std::ssize(lines)};
    communicator.broadcast(size);
    if (size[0] == 0) break;
    counts[static_cast<std::size_t>(turn)] = size[0];
    const std::vector<Line> own =
        scatterv<Line>(communicator, counts, [&](std::int64_t begin, std::span<Line> portion) {
          std::copy_n(lines.begin() + begin, portion.size(), portion.begin());
        });
    mine.lines.insert(mine.lines.end(), own.begin(), own.end());
    for (std::int64_t n = 0; n < std::ssize(own); ++n) mine.ids.push_back(first + n);
    first += size[0];
  }
  on_root([&] {
    if (first == 0) throw Error(path.string() + ": the file has no points");
  });
  on_root.raise();
  return mine;
}

// Collective. The numbers of the blocks over all ranks, ascending.
std::vector<int> block_numbers(const std::vector<Line>& lines, const Communicator& communicator) {
  std::set<int> found;
  for (const Line& line : lines) found.insert(line.block);
  const std::vector<int> own(found.begin(), found.end());
  const std::vector<int> all = gather(communicator, std::span<const int>(own));
  found.insert(all.begin(), all.end());
  std::vector<int> numbers(found.begin(), found.end());
  communicator.broadcast(numbers);
  return numbers;
}

}  // namespace

// Blocks are in the order of their numbers, points in the order of the lines.
PointCloud read_text(const std::filesystem::path& file, const Communicator& communicator) {
  const Part part = dealt(file, communicator);
  const Slices slices(communicator, part.ids);
  PointCloud cloud;
  cloud.ids = slices.ids();
  const std::vector<int> numbers = block_numbers(part.lines, communicator);
  for (const int number : numbers) cloud.block_names.push_back("block_" + std::to_string(number));
  for (const Line& line : slices.to_slices(std::span(part.lines))) {
    cloud.positions.emplace_back(line.position.data());
    cloud.volumes.push_back(line.volume);
    cloud.spacings.push_back(std::cbrt(line.volume));
    const auto place = std::lower_bound(numbers.begin(), numbers.end(), line.block);
    cloud.blocks.push_back(static_cast<int>(place - numbers.begin()));
  }
  cloud.sets.assign(cloud.size(), 0);
  for (const std::int64_t id : cloud.ids) cloud.element_ids.push_back(id + 1);
  return cloud;
}

}  // namespace strut::io

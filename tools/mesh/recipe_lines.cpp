#include "mesh/recipe_lines.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "base/numbers.hpp"

namespace strut::mesh {

namespace {

class Lines {
 public:
  Lines(const std::vector<std::string>& keys, std::vector<std::string>& problems) : keys_(keys), problems_(problems) {}

  std::vector<Entries> read(std::istream& stream) {
    std::string text;
    int lines = 0;
    for (int number = 1; std::getline(stream, text); ++number) {
      if (number == 1) text = without_mark(text);
      const std::string content(trimmed(std::string_view(text).substr(0, text.find('#'))));
      if (content.empty()) continue;
      if (content.find('\0') != std::string::npos) throw Error("it is no recipe but holds other than text");
      read_line(content, number);
      if (++lines == looked_at || stream.peek() == EOF) check_kind(lines);
    }
    if (bodies_.empty()) return {common_};
    for (Entries& body : bodies_) body.by_key.insert(common_.by_key.begin(), common_.by_key.end());
    return bodies_;
  }

 private:
  static constexpr int looked_at = 100;

  void check_kind(int lines) const {
    if (lines > looked_at || foreign_ <= 2 || foreign_ < lines / 2) return;
    throw Error("it is no recipe: expected lines 'key = value' or '[body]', found '" + first_foreign_ + "'" +
                " and others; meshes of other programs are for tools/tetrahedra, images for tools/voxels");
  }

  // A line that cannot be of a recipe.
  void take_foreign(const std::string& content) {
    if (foreign_++ > 0) return;
    for (const char c : content.substr(0, 60)) first_foreign_ += c >= ' ' && c <= '~' ? c : '?';
  }

  void read_line(const std::string& content, int number) {
    if (content == "[body]") {
      bodies_.push_back({number});
      return;
    }
    const auto sign = content.find('=');
    if (sign == std::string::npos) {
      take_foreign(content);
      return fail(number, "expected 'key = value' or '[body]', found '" + content + "'");
    }
    const std::string key(trimmed(content.substr(0, sign))), value(trimmed(content.substr(sign + 1)));
    if (std::ranges::find(keys_, key) == keys_.end()) {
      if (key.find_first_not_of("abcdefghijklmnopqrstuvwxyz_ ") != std::string::npos) take_foreign(content);
      return fail(number, "unknown key '" + key + "'" + did_you_mean(key, keys_) + "; keys are " + joined(keys_));
    }
    Entries& body = bodies_.empty() ? common_ : bodies_.back();
    if (value.empty()) return fail(number, "key '" + key + "' has no value");
    if (const Entry* first = body.find(key)) {
      return fail(number, "key '" + key + "' again (first in line " + std::to_string(first->line) + ")");
    }
    body.by_key[key] = {value, number};
  }

  void fail(int line, const std::string& problem) {
    problems_.push_back("line " + std::to_string(line) + ": " + problem);
  }

  const std::vector<std::string>& keys_;
  std::vector<std::string>& problems_;
  int foreign_ = 0;
  std::string first_foreign_;
  Entries common_{1};
  std::vector<Entries> bodies_;
};

}  // namespace

std::vector<Entries> read_lines(std::istream& stream, const std::vector<std::string>& keys,
                                std::vector<std::string>& problems) {
  return Lines(keys, problems).read(stream);
}

}  // namespace strut::mesh

#include "point/request.hpp"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>

#include "base/errors.hpp"

namespace strut::point {
namespace {

const char* const usage =
    "usage: strut-point DECK.xml [--material NAME] PATH [--steps N]\n"
    "PATH is one of --uniaxial-strain RATE FINAL, --uniaxial-stress RATE FINAL, --path strain FILE.csv, "
    "--path stress FILE.csv";

constexpr int uniaxial_steps = 1000;

double number_of(const std::string& option, const std::string& word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
    throw Error(option + ": '" + word + "' is not a number");
  }
  return value;
}

// The words of a command line, consumed from the front.
class Words {
 public:
  explicit Words(const std::vector<std::string>& words) : words_(words) {}
  bool empty() const { return next_ == words_.size(); }
  const std::string& take() { return words_[next_++]; }
  const std::string& take_for(const std::string& option, const std::string& what) {
    if (empty()) throw Error(option + " needs " + what);
    return take();
  }

 private:
  const std::vector<std::string>& words_;
  std::size_t next_ = 0;
};

Path uniaxial_path(const std::string& option, Words& words) {
  const double rate = number_of(option, words.take_for(option, "a rate (1/s) and a final strain"));
  const double final = number_of(option, words.take_for(option, "a final strain after the rate"));
  if (!(rate > 0)) throw Error(option + ": expected a rate > 0 (1/s); compression is a negative final strain");
  if (final == 0) throw Error(option + ": the final strain is 0, expected another (negative: compression)");
  Path path = uniaxial(option == "--uniaxial-stress" ? lateral_stress : all_strain, rate, final);
  path.steps = uniaxial_steps;
  return path;
}

Path path_from_file(const std::string& option, Words& words) {
  const std::string kind = words.take_for(option, "strain or stress, and a file");
  if (kind != "strain" && kind != "stress") {
    throw Error(option + ": '" + kind + "', expected strain or stress" + did_you_mean(kind, {"strain", "stress"}));
  }
  return read_path(words.take_for(option, "a file after " + kind), kind == "stress" ? all_stress : all_strain);
}

int steps_of(const std::string& option, Words& words) {
  const double steps = number_of(option, words.take_for(option, "a number of steps"));
  if (!(steps >= 1 && steps <= 1e9 && steps == std::floor(steps))) {
    throw Error(option + ": expected a whole number from 1");
  }
  return static_cast<int>(steps);
}

}  // namespace

Request parse(const std::vector<std::string>& all) {
  const std::vector<std::string> options{"--material", "--uniaxial-strain", "--uniaxial-stress", "--path", "--steps"};
  Request request;
  std::optional<int> steps;
  const auto set_path = [&](const Path& path) {
    if (!request.path.rows.empty()) throw Error("more than one path is given\n" + std::string(usage));
    request.path = path;
  };
  for (Words words(all); !words.empty();) {
    const std::string word = words.take();
    if (word == "--material") {
      request.material = words.take_for(word, "a name");
    } else if (word == "--uniaxial-strain" || word == "--uniaxial-stress") {
      set_path(uniaxial_path(word, words));
    } else if (word == "--path") {
      set_path(path_from_file(word, words));
    } else if (word == "--steps") {
      steps = steps_of(word, words);
    } else if (word.starts_with("--")) {
      throw Error("unknown option " + word + did_you_mean(word, options));
    } else if (request.deck.empty()) {
      request.deck = word;
    } else {
      throw Error("'" + word + "' is one word too many\n" + usage);
    }
  }
  if (request.deck.empty()) throw Error("no deck is given\n" + std::string(usage));
  if (request.path.rows.empty()) throw Error("no path is given\n" + std::string(usage));
  if (steps) request.path.steps = *steps;
  return request;
}

}  // namespace strut::point

#include "mutate.hpp"

#include <algorithm>
#include <cctype>

namespace strut::fuzz {

namespace {

// A huge number of a header, in either order of its bytes.
std::string huge_number(Random& random) {
  static const std::vector<std::uint64_t> numbers = {0,
                                                     1,
                                                     2,
                                                     7,
                                                     255,
                                                     0x7fff,
                                                     0xffff,
                                                     1000000000,
                                                     0x7fffffff,
                                                     0x80000000,
                                                     0xffffffff,
                                                     0xfffffffc,
                                                     0x100000000,
                                                     0x27fffffff,
                                                     0x7fffffffffffffff,
                                                     0xffffffffffffffff};
  const std::uint64_t number = random.pick(numbers);
  const std::size_t size = random.chance(0.7) ? 4 : 8;
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes.push_back(static_cast<char>(number >> 8 * i & 255));
  if (random.chance(0.6)) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

void overwrite(std::string& bytes, std::size_t at, const std::string& by) {
  for (std::size_t i = 0; i < by.size() && at + i < bytes.size(); ++i) bytes[at + i] = by[i];
}

// Headers are at the front, and there damage is worse.
std::size_t place_in(const std::string& bytes, Random& random) {
  const std::size_t front = random.chance(0.6) ? std::min<std::size_t>(bytes.size(), 2000) : bytes.size();
  return random.below(front);
}

void damage_once(std::string& bytes, const std::string& other, Random& random) {
  const std::size_t at = place_in(bytes, random);
  const std::size_t length = std::min(bytes.size() - at, 1 + random.below(random.chance(0.7) ? 16 : 2000));
  switch (random.below(9)) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ 1 << random.below(8));
      return;
    case 1:
      bytes[at] = static_cast<char>(random.next());
      return;
    case 2:
      bytes.resize(random.below(bytes.size()));
      return;
    case 3:
      bytes.erase(at, length);
      return;
    case 4:
      bytes.insert(at, bytes.substr(at, length));
      return;
    case 5:
      bytes.replace(at, length, other.substr(random.below(other.size()), length));
      return;
    case 6:
      bytes.replace(at, length, std::string(length, random.chance(0.5) ? '\0' : '\xff'));
      return;
    default:
      return overwrite(bytes, at / 4 * 4, huge_number(random));
  }
}

bool is_blank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

// Words and the blanks between them.
std::vector<std::string> pieces_of(const std::string& text) {
  std::vector<std::string> pieces;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = begin + 1;
    while (end < text.size() && is_blank(text[end]) == is_blank(text[begin])) ++end;
    pieces.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  return pieces;
}

std::string joined(const std::vector<std::string>& pieces) {
  std::string text;
  for (const std::string& piece : pieces) text += piece;
  return text;
}

// Drops, doubles or swaps pieces, or replaces one.
void shuffle_once(std::vector<std::string>& pieces, Random& random) {
  if (pieces.empty()) return;
  const std::size_t a = random.below(pieces.size()), b = random.below(pieces.size());
  switch (random.below(5)) {
    case 0:
      pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(a));
      return;
    case 1:
      pieces.insert(pieces.begin() + static_cast<std::ptrdiff_t>(a), pieces[b]);
      return;
    case 2:
      std::swap(pieces[a], pieces[b]);
      return;
    case 3:
      pieces[a] = pieces[b];
      return;
    default:
      pieces[a] = awkward_value(random);
  }
}

std::string repeated(const std::string& text, std::size_t times) {
  std::string all;
  for (std::size_t n = 0; n < times; ++n) all += text;
  return all;
}

}  // namespace

std::string damaged(std::string bytes, const std::string& other, Random& random) {
  for (std::size_t n = 1 + random.below(4); n > 0 && !bytes.empty(); --n) damage_once(bytes, other, random);
  return bytes;
}

std::string awkward_value(Random& random) {
  static const std::vector<std::string> values = {"",
                                                  "nan",
                                                  "-nan",
                                                  "inf",
                                                  "-inf",
                                                  "1e400",
                                                  "-1e400",
                                                  "1e308",
                                                  "1e-320",
                                                  "-1",
                                                  "0",
                                                  "-0",
                                                  "1",
                                                  "2147483647",
                                                  "4294967296",
                                                  "99999999999999999999",
                                                  "0x10",
                                                  "1,5",
                                                  "1e",
                                                  "1.5.5",
                                                  "+",
                                                  "-",
                                                  ".",
                                                  "true",
                                                  "x",
                                                  "#",
                                                  "=",
                                                  "{}",
                                                  "{1,,2}",
                                                  "[body]",
                                                  "1 2 3",
                                                  "\xff\xfe",
                                                  "%s%n",
                                                  "../../etc",
                                                  "/dev/zero",
                                                  "/dev/full",
                                                  "/proc/self/mem",
                                                  "file",
                                                  "'",
                                                  "\"",
                                                  "<",
                                                  ">",
                                                  "&",
                                                  "&amp;",
                                                  "]]>",
                                                  "&#0;",
                                                  "&#x110000;",
                                                  "&lol;",
                                                  "-->",
                                                  "1e-300",
                                                  "0.5",
                                                  "1e9",
                                                  "1e18",
                                                  "all",
                                                  "name",
                                                  "\t",
                                                  "\n",
                                                  "10000000",
                                                  "1e-9"};
  if (random.chance(0.03)) return std::string(std::size_t{1} << (4 + random.below(15)), 'a');
  if (random.chance(0.02)) return repeated("9", 1 + random.below(5000));
  if (random.chance(0.02)) return {'a', '\0', 'b'};
  return random.pick(values);
}

std::string reworded(std::string text, Random& random) {
  std::vector<std::string> pieces = pieces_of(text);
  for (std::size_t n = 1 + random.below(4); n > 0; --n) shuffle_once(pieces, random);
  return joined(pieces);
}

// ---- expressions

std::string expression(Random& random, int depth) {
  static const std::vector<std::string> leaves = {"x", "y", "z", "t", "1", "0.5", "1e-3", "2", "1e308", "value", "q"};
  static const std::vector<std::string> operators = {
      "+", "-", "*", "/", "^", "<", ">", "<=", ">=", "==", "!=", "&&", "||", "%", "=", ";", ","};
  static const std::vector<std::string> functions = {"sin", "log",   "pow",  "sqrt",   "gamma", "i0",      "j1",
                                                     "i1",  "atan2", "rand", "printf", "exp",   "readline"};
  static const std::vector<std::string> statements = {"value = ", "if (",        "while (",
                                                      "for (",    "double a = ", "double a["};
  if (random.chance(0.01)) return repeated(random.chance(0.5) ? "(" : "-", 1 + random.below(200000)) + "x";
  if (random.chance(0.01)) return repeated("x+", random.below(20000)) + "x";
  const auto below = [&] { return expression(random, depth + 1); };
  if (depth > 6 || random.chance(0.3)) return random.chance(0.05) ? awkward_value(random) : random.pick(leaves);
  switch (random.below(8)) {
    case 0:
      return "(" + below() + ")";
    case 1:
      return random.pick(functions) + "(" + below() + (random.chance(0.3) ? ", " + below() : "") + ")";
    case 2:
      return (random.chance(0.5) ? "-" : "!") + below();
    case 3:
      return random.pick(statements) + below() + ";";
    case 4:
      return "if (" + below() + ") { value = " + below() + "; } else { value = " + below() + "; }";
    default:
      return below() + random.pick(operators) + below();
  }
}

// ---- decks

namespace {

// Tags and what stands between them.
std::vector<std::string> tags_of(const std::string& deck) {
  std::vector<std::string> tags;
  for (std::size_t begin = 0; begin < deck.size();) {
    std::size_t end = deck[begin] == '<' ? deck.find('>', begin) : deck.find('<', begin) - 1;
    end = std::min(end, deck.size() - 1) + 1;
    tags.push_back(deck.substr(begin, end - begin));
    begin = end;
  }
  return tags;
}

// The text between the quotes after ` name=`, of a tag that has it.
bool find_attribute(const std::string& tag, const std::string& name, std::size_t& begin, std::size_t& length) {
  const std::size_t at = tag.find(" " + name + "=\"");
  if (at == std::string::npos) return false;
  begin = at + name.size() + 3;
  const std::size_t end = tag.find('"', begin);
  if (end == std::string::npos) return false;
  length = end - begin;
  return true;
}

std::string escaped(const std::string& text) {
  std::string all;
  for (const char c : text) all += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
  return all;
}

std::string other_value(const std::vector<std::string>& tags, const std::string& name, Random& random) {
  std::size_t begin = 0, length = 0;
  for (int n = 0; n < 50; ++n) {
    const std::string& tag = random.pick(tags);
    if (find_attribute(tag, name, begin, length)) return tag.substr(begin, length);
  }
  return "";
}

std::string scaled(const std::string& number, Random& random) {
  static const std::vector<std::string> powers = {"e1", "e-1", "e3", "e-3", "e9", "e-9", "e300", "e-300", "0", ".5"};
  return (random.chance(0.2) ? "-" : "") + number + random.pick(powers);
}

void change_attribute(std::vector<std::string>& tags, Random& random) {
  static const std::vector<std::string> names = {"value", "value", "value", "value", "name", "type"};
  const std::string name = random.pick(names);
  std::size_t begin = 0, length = 0;
  for (int n = 0; n < 50; ++n) {
    std::string& tag = tags[random.below(tags.size())];
    if (!find_attribute(tag, name, begin, length)) continue;
    const std::string old = tag.substr(begin, length);
    switch (random.below(5)) {
      case 0:
        tag.replace(begin, length, other_value(tags, random.chance(0.8) ? name : "name", random));
        return;
      case 1:
        tag.replace(begin, length, scaled(old, random));
        return;
      case 2:
        tag.replace(begin, length, escaped(expression(random)));
        return;
      case 3:
        tag.replace(begin, length, reworded(old, random));
        return;
      default:
        tag.replace(begin, length, random.chance(0.5) ? awkward_value(random) : escaped(awkward_value(random)));
        return;
    }
  }
}

std::string odd_xml(Random& random) {
  const std::string bomb =
      "<!DOCTYPE d [<!ENTITY a \"aaaaaaaaaaaaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;\"><!ENTITY c "
      "\"&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;\"><!ENTITY lol \"&c;&c;&c;&c;&c;&c;&c;&c;&c;&c;\">]>";
  const std::string list = "<ParameterList name=\"a\">";
  switch (random.below(8)) {
    case 0:
      return bomb;
    case 1:
      return "<!DOCTYPE d [<!ENTITY lol SYSTEM \"file:///etc/passwd\">]>&lol;";
    case 2:
      return repeated(list, 1 + random.below(random.chance(0.1) ? 200000 : 300)) +
             (random.chance(0.5) ? "</ParameterList>" : "");
    case 3: {
      const std::size_t depth = random.below(300);
      return repeated(list, depth) + repeated("</ParameterList>", depth);
    }
    case 4:
      return "<![CDATA[" + awkward_value(random) + "]]>";
    case 5:
      return "<!-- " + awkward_value(random) + (random.chance(0.5) ? " -->" : "");
    case 6:
      return "<?xml " + awkward_value(random) + "?>";
    default:
      return "<xi:include href=\"/etc/passwd\"/>";
  }
}

}  // namespace

std::string changed_deck(std::string deck, Random& random) {
  std::vector<std::string> tags = tags_of(deck);
  for (std::size_t n = 1 + random.below(3); n > 0 && !tags.empty(); --n) {
    if (random.chance(0.75)) {
      change_attribute(tags, random);
    } else if (random.chance(0.8)) {
      shuffle_once(tags, random);
    } else {
      tags.insert(tags.begin() + static_cast<std::ptrdiff_t>(random.below(tags.size())), odd_xml(random));
    }
  }
  return joined(tags);
}

}  // namespace strut::fuzz

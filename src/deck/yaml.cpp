#include "deck/yaml.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Teuchos_YamlParameterListCoreHelpers.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/numbers.hpp"

namespace strut::deck {

namespace {

template <class T>
std::string text_of(const T& value) {
  if constexpr (std::is_same_v<T, std::string>) return std::string(trimmed(value));  // "> text" ends with a line break
  if constexpr (std::is_same_v<T, bool>) return value ? "true" : "false";
  if constexpr (std::is_same_v<T, int>) return std::to_string(value);
  if constexpr (std::is_same_v<T, double>) return to_text(value);
}

template <class T>
bool read_as(const Teuchos::ParameterEntry& entry, const std::string& type, Parameter& parameter) {
  if (entry.isType<T>()) {
    parameter.type = type, parameter.value = text_of(Teuchos::getValue<T>(entry));
    return true;
  }
  if (!entry.isType<Teuchos::Array<T>>()) return false;
  parameter.type = "Array(" + type + ")";
  const char* between = "{";
  for (const T& one : Teuchos::getValue<Teuchos::Array<T>>(entry)) {
    parameter.value += between + text_of(one);
    between = ", ";
  }
  parameter.value = (parameter.value.empty() ? "{" : parameter.value) + "}";
  return true;
}

List read_list(const Teuchos::ParameterList& yaml, const std::string& path, Problems& problems) {
  List list;
  for (auto at = yaml.begin(); at != yaml.end(); ++at) {
    const std::string& name = yaml.name(at);
    const Teuchos::ParameterEntry& entry = yaml.entry(at);
    Parameter parameter{name, "", ""};
    if (entry.isList()) {
      list.lists.push_back(read_list(yaml.sublist(name), path_to(path, name), problems));
      list.lists.back().name = name;
    } else if (read_as<double>(entry, "double", parameter) || read_as<int>(entry, "int", parameter) ||
               read_as<bool>(entry, "bool", parameter) || read_as<std::string>(entry, "string", parameter)) {
      list.parameters.push_back(parameter);
    } else {
      problems.add(path_to(path, name), "expected a number, a truth value, a text, a list of these, or a section");
    }
  }
  return list;
}

// Teuchos wants one outermost key. A deck whose sections are the outermost keys is wrapped in one.
const std::string outermost = "deck:\n", indent = "  ";

bool has_one_outermost_key(const std::string& text) {
  std::istringstream lines(text);
  int keys = 0;
  for (std::string line; std::getline(lines, line);) {
    const bool begins_here = !line.empty() && std::string_view(" \t\r#%-.").find(line[0]) == std::string_view::npos;
    keys += begins_here && line.find(':') != std::string::npos ? 1 : 0;
  }
  return keys <= 1;
}

std::string within_one_key(const std::string& text) {
  std::istringstream lines(text);
  std::string all = outermost;
  for (std::string line; std::getline(lines, line);) {
    const bool is_mark = line.starts_with("---") || line.starts_with("...") || line.starts_with("%");
    all += (is_mark ? "#" : line.empty() ? "" : indent) + line + "\n";
  }
  return all;
}

// "line 2 column 3", as in the text before it was wrapped.
std::string place_in_deck(const std::string& place, bool was_put_into_one) {
  int line = 0, column = 0;
  if (!was_put_into_one || std::sscanf(place.c_str(), "line %d column %d", &line, &column) != 2) return place;
  return "line " + std::to_string(line - 1) + " column " +
         std::to_string(std::max(1, column - static_cast<int>(indent.size())));
}

// Extracts from Teuchos' many lines: "Parser failure at line 2 column 3 of …" and, if it has one, its own last word.
void add_syntax_error(const std::string& what, bool was_put_into_one, Problems& problems) {
  const std::string mark = "Parser failure at ";
  const std::size_t begin = what.find(mark);
  const std::string place =
      begin == std::string::npos
          ? "YAML"
          : place_in_deck(what.substr(begin + mark.size(), what.find(" of ", begin) - begin - mark.size()),
                          was_put_into_one);
  const std::size_t twice = what.find("already exists"),
                    name = twice == std::string::npos ? twice : what.rfind('\n', twice);
  if (twice != std::string::npos && name != std::string::npos) {
    return problems.add(place,
                        std::string(trimmed(what.substr(name, twice - name))) + " is given twice; expected once");
  }
  problems.add(
      place,
      "this is neither XML nor a form of YAML that is read; expected <ParameterList>s, or 'Key: value' and indented "
      "sections (quoted keys, '<<' and sections after '-' are not read, nor Peridigm's text with aprepro's {…})");
}

// The first line that a tab indents, which YAML does not allow; 0 without any.
int line_indented_by_tab(const std::string& text) {
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.substr(0, line.find_first_not_of(" \t")).find('\t') != std::string::npos) return number;
  }
  return 0;
}

// True if the line has a '#' within a word or in quotes. YAML takes it as a part of the value, Teuchos as a comment.
bool has_hidden_comment(std::string_view line) {
  char quote = 0, before = ':';  // the last character that is no blank, after which a quote opens
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '#') return quote != 0 || (i > 0 && line[i - 1] != ' ' && line[i - 1] != '\t');
    if (quote != 0) {
      if (c == quote && quote == '\'' && i + 1 < line.size() && line[i + 1] == quote) {
        ++i;  // '' stands for one
      } else if (c == quote) {
        quote = 0;
      } else if (c == '\\' && quote == '"') {
        ++i;
      }
    } else if ((c == '\'' || c == '"') && std::string_view(":,[{-").find(before) != std::string_view::npos) {
      quote = c;
    }
    if (c != ' ') before = c;
  }
  return false;
}

// Tells lines, one after the other, that belong to a text of several lines (after "Value: |") or are empty.
class LinesOfTexts {
 public:
  bool have(const std::string& line) {
    const std::size_t begin = line.find_first_not_of(" \r");
    if (begin == std::string::npos || (indent_ != std::string::npos && begin > indent_)) return true;
    const std::size_t mark = line.find_last_of("|>");
    const bool begins_text = mark != std::string::npos && mark > 1 && line[mark - 1] == ' ' &&
                             line.find_first_not_of("+-0123456789 \r", mark + 1) == std::string::npos &&
                             line[line.find_last_not_of(' ', mark - 1)] == ':';
    indent_ = begins_text ? begin : std::string::npos;
    return false;
  }

 private:
  std::size_t indent_ = std::string::npos;  // of the key before the text
};

// The first line with a hidden comment outside of such texts; 0 without any.
int line_with_hidden_comment(const std::string& text) {
  std::istringstream lines(text);
  LinesOfTexts texts;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (!texts.have(line) && has_hidden_comment(line)) return number;
  }
  return 0;
}

// Puts quotes around the plain value at `begin` if it has a '>' or '|'. Returns where it ends: before a comment, and
// within brackets before the next value.
std::size_t quote_plain_value(std::string& line, std::size_t begin, bool in_brackets) {
  std::size_t end = std::min(line.find(" #", begin), line.size());
  if (in_brackets) end = std::min(end, line.find_first_of(",{}[]", begin));
  const std::string value(trimmed(line.substr(begin, end - begin)));
  const char quote = value.find_first_of("\"\\") == std::string::npos ? '"' : '\'';
  const bool is_text = value.find(quote) == std::string::npos && value.find(": ") == std::string::npos;
  if (!is_text || value.find_first_of(">|") == std::string::npos) return end;
  line.replace(begin, value.size(), quote + value + quote);
  return end + 2;
}

// Where the quote at `begin` closes; npos if not in this line.
std::size_t closing_quote(const std::string& line, std::size_t begin) {
  const char quote = line[begin];
  for (std::size_t i = begin + 1; i < line.size(); ++i) {
    if (line[i] == '\\' && quote == '"') {
      ++i;
    } else if (line[i] == quote) {
      if (quote == '"' || line[i + 1] != quote) return i;
      ++i;  // '' stands for one
    }
  }
  return std::string::npos;
}

// The same for all values of a line, and items of lists; `brackets`: that are open. False if a quote does not close in
// the line.
bool quote_plain_values(std::string& line, std::string& brackets) {
  char before = brackets.empty() ? '-' : ',';  // the last character that is no blank
  const std::size_t dash = line.find_first_not_of(' ');
  const auto begins_value = [&](std::size_t i) {
    if (before == ':') return line[i - 1] == ' ';
    if (brackets.empty())
      return i > dash && before == '-' && line[dash] == '-' && line[i - 1] == ' ' &&
             line.find(": ", i) == std::string::npos;
    return brackets.back() == '[' && (before == '[' || before == ',');
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '#') return true;
    if ((c == '\'' || c == '"') && std::string_view(":,[{-").find(before) != std::string_view::npos) {
      i = closing_quote(line, i);
      if (i == std::string::npos) return false;
    } else if (begins_value(i) && std::string_view(" {}[],>|&*!%@`").find(c) == std::string::npos) {
      i = quote_plain_value(line, i, !brackets.empty()) - 1;
    }
    if (c == '{' || c == '[') brackets += c;
    if ((c == '}' || c == ']') && !brackets.empty()) brackets.pop_back();
    if (c != ' ') before = line[i];
  }
  return true;
}

// Teuchos takes every '>' and '|' in a plain value ("z > 1") for the begin of a text of several lines, so these values
// get quotes. Texts of several lines stay; with quotes over several lines, all does.
std::string with_quotes(const std::string& text) {
  std::istringstream lines(text);
  LinesOfTexts texts;
  std::string all, brackets;
  for (std::string line; std::getline(lines, line);) {
    if (!texts.have(line) && !quote_plain_values(line, brackets)) return text;
    all += line + "\n";
  }
  return all;
}

// Teuchos and read_list recurse for each level.
bool is_too_deep(const std::string& text) {
  constexpr int deepest = 100;
  int brackets = 0, most = 0;
  for (const char c : text) {
    brackets += (c == '{' || c == '[') - (c == '}' || c == ']');
    most = std::max(most, brackets);
  }
  return most > deepest || text.find("\n" + std::string(4 * deepest, ' ')) != std::string::npos;
}

}  // namespace

std::optional<List> parse_yaml(const std::string& text, Problems& problems) {
  if (is_too_deep(text)) {
    problems.add("YAML", "more than a hundred levels; expected few");
    return std::nullopt;
  }
  if (const int line = line_with_hidden_comment(text)) {
    problems.add(
        "line " + std::to_string(line),
        "a '#' within a word or in quotes, which begins a comment here; expected a blank before a comment, and "
        "names without '#'");
    return std::nullopt;
  }
  const bool put_into_one = !has_one_outermost_key(text);
  const auto read = [&](const std::string& whole) {
    const auto yaml = Teuchos::getParametersFromYamlString(put_into_one ? within_one_key(whole) : whole);
    List deck = read_list(*yaml, "", problems);
    if (!put_into_one) deck.name = yaml->name();  // "Peridigm", say
    return deck;
  };
  try {
    return read(text);
  } catch (const std::exception&) {  // perhaps for want of quotes
  }
  try {
    return read(with_quotes(text));
  } catch (const std::exception& error) {
    if (const int line = line_indented_by_tab(text)) {
      problems.add("line " + std::to_string(line), "indented by a tab; expected spaces, as YAML has them");
    } else {
      add_syntax_error(error.what(), put_into_one, problems);
    }
  }
  return std::nullopt;
}

std::optional<List> parse_xml_or_yaml(const std::string& text, Problems& problems) {
  const std::string_view content = trimmed(text);
  return content.empty() || content[0] == '<' ? parse_xml(text, problems) : parse_yaml(text, problems);
}

}  // namespace strut::deck

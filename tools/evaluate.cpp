// strut-evaluate: the languages of decks for tools in Python. A line of standard input is four numbers, x y z t (nan:
// not known), and an expression; the answer is a line with its value, or with "error" and the reason. Files of
// tables are found from the working folder. With --xml standard input is a deck in YAML, and the answer is the same
// deck in XML.
#include <cmath>
#include <iostream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>

#include "base/errors.hpp"
#include "base/math/expression.hpp"
#include "base/math/table_files.hpp"
#include "deck/yaml.hpp"

namespace {

double value_of(const std::string& line) {
  std::istringstream words(line);
  double given[4];
  for (double& number : given) {
    std::string word;
    words >> word;
    number = word == "nan" ? std::nan("") : std::stod(word);
  }
  std::string text;
  std::getline(words, text);
  for (const std::string& name : strut::table_files(text))
    text = strut::with_table(text, name, strut::numbers_in_table(name));
  const strut::Expression expression = strut::Expression::compile(text);
  if (expression.uses_position() && std::isnan(given[0])) throw strut::Error("'x', 'y' and 'z' are not variables here");
  if (expression.uses_time() && std::isnan(given[3])) throw strut::Error("'t' is not a variable here");
  return expression(given[0], given[1], given[2], given[3]);
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const std::string signs = "&<>\"\n", names[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&#10;"};
    const std::size_t n = signs.find(c);
    result += n == std::string::npos ? std::string(1, c) : names[n];
  }
  return result;
}

void print_section(const strut::deck::List& list, std::ostream& out) {
  out << "<ParameterList name=\"" << escaped(list.name) << "\">\n";
  for (const auto& [name, type, value] : list.parameters) {
    out << "<Parameter name=\"" << escaped(name) << "\" type=\"" << type << "\" value=\"" << escaped(value) << "\"/>\n";
  }
  for (const strut::deck::List& inner : list.lists) print_section(inner, out);
  out << "</ParameterList>\n";
}

int print_in_xml() {
  const std::string text(std::istreambuf_iterator<char>(std::cin), {});
  strut::deck::Problems problems;
  const auto deck = strut::deck::parse_xml_or_yaml(text, problems);
  for (const std::string& line : problems.lines()) std::cerr << line << "\n";
  if (!deck || !problems.empty()) return 1;
  print_section(*deck, std::cout);
  return std::cout.flush() ? 0 : 1;
}

}  // namespace

int main(int count, char** words) {
  if (count > 1 && std::string(words[1]) == "--xml") return print_in_xml();
  std::cout.precision(std::numeric_limits<double>::max_digits10);
  for (std::string line; std::getline(std::cin, line);) {
    try {
      std::cout << value_of(line) << std::endl;
    } catch (const std::exception& error) {
      std::cout << "error " << error.what() << std::endl;
    }
  }
}

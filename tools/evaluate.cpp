// strut-evaluate: the languages of decks for tools in Python. A line of standard input is four numbers, x y z t (nan:
// not known), and an expression; the answer is a line with its value, or with "error" and the reason. After "integral",
// two times and an expression of t the answer is the integral over t. Files of tables are found from the working
// folder. With --xml standard input is a deck in YAML, and the answer is the same deck in XML.
#include <cmath>
#include <iostream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>

#include "base/errors.hpp"
#include "base/math/expression.hpp"
#include "base/math/function.hpp"
#include "base/math/table_files.hpp"
#include "base/math/time_integral.hpp"
#include "deck/yaml.hpp"

namespace {

double number_in(std::istream& words) {
  std::string word;
  words >> word;
  return word == "nan" ? std::nan("") : std::stod(word);
}

std::string expression_in(std::istream& words) {
  std::string text;
  std::getline(words, text);
  for (const std::string& name : strut::table_files(text))
    text = strut::with_table(text, name, strut::numbers_in_table(name));
  return text;
}

const char* const no_position = "'x', 'y' and 'z' are not variables here";

double value_in(std::istream& words) {
  double given[4];
  for (double& number : given) number = number_in(words);
  const strut::Expression expression = strut::Expression::compile(expression_in(words));
  if (expression.uses_position() && std::isnan(given[0])) throw strut::Error(no_position);
  if (expression.uses_time() && std::isnan(given[3])) throw strut::Error("'t' is not a variable here");
  return expression(given[0], given[1], given[2], given[3]);
}

double integral_in(std::istream& words) {
  const double from = number_in(words), to = number_in(words);
  const strut::Function value = strut::Function::parse(expression_in(words));
  if (value.depends_on_position()) throw strut::Error(no_position);
  return strut::time_integral(value, strut::Vector::Zero(), from, to);
}

double answer_to(const std::string& line) {
  const std::string integral = "integral ";
  const bool integrates = line.starts_with(integral);
  std::istringstream words(integrates ? line.substr(integral.size()) : line);
  return integrates ? integral_in(words) : value_in(words);
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
      std::cout << answer_to(line) << std::endl;
    } catch (const std::exception& error) {
      std::cout << "error " << error.what() << std::endl;
    }
  }
}

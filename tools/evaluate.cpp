// strut-evaluate: the language of a deck's expressions for tools in Python. A line of standard input is four numbers, x
// y z t (nan: not known), and an expression; the answer is a line with its value, or with "error" and what is wrong.
// Files of tables are found from the working folder.
#include <cmath>
#include <iostream>
#include <limits>
#include <sstream>
#include <string>

#include "base/errors.hpp"
#include "base/math/expression.hpp"
#include "base/math/table_files.hpp"

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
  if (expression.uses_place() && std::isnan(given[0])) throw strut::Error("'x', 'y' and 'z' are not variables here");
  if (expression.uses_time() && std::isnan(given[3])) throw strut::Error("'t' is not a variable here");
  return expression(given[0], given[1], given[2], given[3]);
}

}  // namespace

int main() {
  std::cout.precision(std::numeric_limits<double>::max_digits10);
  for (std::string line; std::getline(std::cin, line);) {
    try {
      std::cout << value_of(line) << std::endl;
    } catch (const std::exception& error) {
      std::cout << "error " << error.what() << std::endl;
    }
  }
}

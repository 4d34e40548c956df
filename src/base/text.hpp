// A text of parts, as a stream writes them: numbers with 6 digits, or those of a std::setprecision(n) before them.
#pragma once

#include <sstream>
#include <string>

namespace strut {

template <class... Parts>
std::string text_of(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

}  // namespace strut

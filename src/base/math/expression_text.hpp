// The text of an expression, read from left to right.
#pragma once

#include <cctype>
#include <string>

#include "base/errors.hpp"

namespace strut {

inline bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
inline bool in_name(char c) { return begins_name(c) || std::isdigit(static_cast<unsigned char>(c)) != 0; }

class ExpressionText {
 protected:
  explicit ExpressionText(const std::string& text) : text_(text) {}

  [[noreturn]] void fail(const std::string& what) const {
    const std::size_t shown = 20;
    const std::string rest = at_ < text_.size() ? "'" + text_.substr(at_, shown) + "'" : "the end";
    throw Error("at character " + std::to_string(at_ + 1) + ", before " + rest + ": " + what);
  }

  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }

  bool at_end() {
    skip_blanks();
    return at_ == text_.size();
  }

  char next() {
    skip_blanks();
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  bool take(const std::string& token) {
    skip_blanks();
    if (text_.compare(at_, token.size(), token) != 0) return false;
    at_ += token.size();
    return true;
  }

  void expect(const std::string& token) {
    if (!take(token)) fail("expected '" + token + "'");
  }

  std::string name() {
    skip_blanks();
    std::size_t end = at_;
    while (end < text_.size() && in_name(text_[end])) ++end;
    const std::string found = text_.substr(at_, end - at_);
    if (found.empty() || !begins_name(found[0])) fail("expected a name");
    at_ = end;
    return found;
  }

  // The next name, without consuming it.
  std::string coming_name() {
    const std::size_t here = at_;
    const std::string found = begins_name(next()) ? name() : "";
    at_ = here;
    return found;
  }

  bool mentions_value() const {
    const std::string wanted = "value";
    for (std::size_t n = text_.find(wanted); n != std::string::npos; n = text_.find(wanted, n + 1)) {
      const std::size_t end = n + wanted.size();
      if ((n == 0 || !in_name(text_[n - 1])) && (end == text_.size() || !in_name(text_[end]))) return true;
    }
    return false;
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

}  // namespace strut

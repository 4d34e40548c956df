// Every section is read with all its keys and with the required ones alone, in each of its cases: a reader that asks
// for a key or section that is not declared where it asks is found here.
#include <gtest/gtest.h>

#include "deck/values.hpp"
#include "deck_under_test.hpp"

namespace strut::deck {
namespace {

std::string number_in(const Range& range) {
  for (const char* text : {"1", "0.25", "10", "-0.25"}) {
    if (range.contains(std::stod(text))) return text;
  }
  throw std::logic_error("no sample of a number " + range.text());
}

std::string sample_of(const Key& key) {
  switch (key.kind) {
    case Kind::real:
    case Kind::integer:
    case Kind::expression:
      return number_in(key.range);
    case Kind::boolean:
      return "true";
    case Kind::reals:
      return key.range.contains(0) ? "0 1" : "1 2";
    case Kind::vector:
      return "0 0 1";
    case Kind::choice:
      return key.choices.front();
    case Kind::axes:
      return "zx";
    case Kind::text:
    case Kind::names:
      return "some";
  }
  return "";
}

// Writes a deck with the case of this number in every section that has so many.
struct Writer {
  std::size_t number;
  bool all_keys;

  static std::string parameter(const std::string& name, const std::string& value) {
    return "<Parameter name=\"" + name + "\" type=\"string\" value=\"" + value + "\"/>\n";
  }

  std::string keys(const Section& section, const std::string& selector) const {
    std::string text;
    for (const Key& key : section.keys) {
      if (key.name != selector && (key.required || all_keys)) text += parameter(key.name, sample_of(key));
    }
    if (section.any_key && all_keys) text += parameter("some Node Set", sample_of(*section.any_key));
    for (const Section& inner : section.sections) text += list(inner);
    return text;
  }

  std::string content(const Section& section) const {
    if (section.cases.empty()) return keys(section, "");
    const Section& chosen = section.cases[number % section.cases.size()];
    return parameter(section.selector, chosen.name) + keys(section, section.selector) + keys(chosen, "");
  }

  std::string list(const Section& section) const {
    const std::string name = section.name == any_name ? "some" : section.name;
    return "<ParameterList name=\"" + name + "\">\n" + content(section) + "</ParameterList>\n";
  }
};

TEST(DeckSections, ReadOnlyTheKeysTheyDeclare) {
  const DeckFolder folder;
  // The third of five laws has six forms of Hardening.
  for (std::size_t number = 0; number < 30; ++number) {
    for (const bool all_keys : {true, false}) {
      const std::string text = Writer{number, all_keys}.list(schema());
      const std::string error = folder.error(text);
      EXPECT_EQ(error.find("is not declared"), std::string::npos) << error << "\n" << text;
      EXPECT_EQ(error.find("unknown key"), std::string::npos) << error << "\n" << text;
    }
  }
}

TEST(DeckSections, RefuseOtherKeys) {
  const OptionalKey<double> width({.name = "Width"});
  const Section section = {.name = "Box", .keys = {width}, .sections = {{.name = "Lid"}}};
  const Values values("Box", "Box", section);
  EXPECT_FALSE(values[width]);
  EXPECT_THROW(values[OptionalKey<double>({.name = "Widht"})], std::logic_error);
  EXPECT_THROW(values[OptionalKey<int>({.name = "Width"})], std::logic_error);
  EXPECT_THROW(values.given(Key{.name = "Height"}), std::logic_error);
  EXPECT_THROW(values.section("Lead"), std::logic_error);
  EXPECT_TRUE(values.section("Lid").name().empty());
}

}  // namespace
}  // namespace strut::deck

// inputs/VARIABLES.md is the page that the tables of observables generate. To bring it up to date:
// STRUT_WRITE_KEYS=1 output_reference
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "output/observables.hpp"

TEST(OutputReference, IsUpToDate) {
  const std::filesystem::path page = std::filesystem::path(STRUT_SOURCE_DIR) / "inputs" / "VARIABLES.md";
  if (std::getenv("STRUT_WRITE_KEYS")) std::ofstream(page) << strut::observables_page();
  std::stringstream text;
  text << std::ifstream(page).rdbuf();
  EXPECT_TRUE(text.str() == strut::observables_page())
      << page << " differs from the tables: run this test with STRUT_WRITE_KEYS=1 in the environment";
}

TEST(OutputReference, EveryVariableHasAMeaningAndAUnit) {
  for (const strut::Observable& one : strut::observables_of_all_laws()) {
    EXPECT_FALSE(one.unit.empty()) << one.name;
    EXPECT_FALSE(one.meaning.empty()) << one.name;
  }
}

// inputs/KEYS.md is the page that the schema generates. To bring it up to date: STRUT_WRITE_KEYS=1 deck_reference
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "deck/deck.hpp"

TEST(DeckReference, IsUpToDate) {
  const std::filesystem::path page = std::filesystem::path(STRUT_SOURCE_DIR) / "inputs" / "KEYS.md";
  if (std::getenv("STRUT_WRITE_KEYS")) std::ofstream(page) << strut::deck::reference_page();
  std::stringstream text;
  text << std::ifstream(page).rdbuf();
  EXPECT_TRUE(text.str() == strut::deck::reference_page())
      << page << " differs from the schema: run this test with STRUT_WRITE_KEYS=1 in the environment";
}

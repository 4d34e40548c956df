// What a deck's sections make of a block: its material.
#include <gtest/gtest.h>

#include "regression/bodies.hpp"
#include "setup/blocks.hpp"

namespace strut::regression {
namespace {

double coefficient_in(const std::string& text) {
  const RunFolder folder;
  const deck::Deck deck = deck::read(folder.write("deck.xml", text), folder.world);
  PointCloud cloud;
  cloud.block_names = {"bar"};
  return coefficient_of(block_materials(deck, cloud)[0].stabilization);
}

// The deck with bonds that break.
std::string breaking(const std::string& text, const std::string& limit) {
  const std::string blocks = "<ParameterList name=\"Blocks\">", horizon = key("Horizon", "2.01e-3");
  const std::string models =
      section("Damage Models", section("cracks", key("Damage Model", "Critical Stretch") + limit));
  return changed(changed(text, horizon, horizon + key("Damage Model", "cracks")), blocks, models + blocks);
}

TEST(Blocks, ThatBreakByStretchHaveStifferSprings) {
  const std::string whole = Parts().text();
  const std::string broken = breaking(whole, key("Fracture Energy", "100"));
  const auto with_own = [](const std::string& text) {
    return changed(text, key("Density", "8930"), key("Density", "8930") + key("Stabilization Coefficient", "0.07"));
  };
  EXPECT_EQ(coefficient_in(whole), 0.01);
  EXPECT_EQ(coefficient_in(broken), 0.3);
  EXPECT_EQ(coefficient_in(with_own(whole)), 0.07);
  EXPECT_EQ(coefficient_in(with_own(broken)), 0.07);
}

std::string warnings_of(const std::string& text) {
  const RunFolder folder;
  return set_up(deck::read(folder.write("deck.xml", text), folder.world), folder.world).warnings;
}

TEST(Blocks, WhoseCracksAreNoiseAreToldOf) {
  const std::string whole = changed(Parts().text(), key("Density", "8930"),
                                    key("Density", "8930") + key("Formulation", "Quadratic Correspondence"));
  const std::string breaks = breaking(whole, key("Critical Stretch", "0.01"));
  EXPECT_EQ(warnings_of(whole).find("cracks"), std::string::npos);
  EXPECT_NE(warnings_of(breaks).find("WARNING: block 'bar' breaks bonds by Formulation"), std::string::npos);
}

}  // namespace
}  // namespace strut::regression

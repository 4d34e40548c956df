// A bar whose upper part, the block "plate" of a Lattice, is stiffer than the rest.
#pragma once

#include "regression/bodies.hpp"

namespace strut::regression {

// `stiff`: the material "copper" of the upper part; the lower one has another Young's modulus, Pa.
inline Parts stiff_ended_bar(const std::string& stiff, const std::string& soft_modulus) {
  Parts parts;
  parts.materials = stiff + changed(changed(stiff, "\"copper\"", "\"soft\""), "117e9", soft_modulus);
  parts.blocks =
      section("soft", key("Block Names", "bar") + key("Material", "soft") + key("Horizon Factor", "1.75")) +
      section("stiff", key("Block Names", "plate") + key("Material", "copper") + key("Horizon Factor", "1.75"));
  parts.times = key("Final Time", "20e-6");
  return parts;
}

}  // namespace strut::regression

// The section Start From: the state in which another run has ended.
#pragma once

#include <filesystem>
#include <optional>

#include "deck/forward.hpp"

namespace strut::deck {

struct StartFrom {
  std::filesystem::path checkpoint;      // relative to the working folder
  std::optional<bool> keeps_velocities;  // nullopt: after explicit steps, not after equilibria
};

Section start_from_section();
std::optional<StartFrom> read_start_from(const Values& deck);  // nullopt without the section

}  // namespace strut::deck

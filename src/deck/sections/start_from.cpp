#include "deck/sections/start_from.hpp"

#include "deck/values.hpp"

namespace strut::deck {

namespace {

const char* const name = "Start From";

const TextKey checkpoint({.name = "Checkpoint",
                          .meaning = "Path of the other run's checkpoint, relative to the working folder."});

const OptionalKey<bool> keeps_velocities(
    {.name = "Keep Velocities",
     .meaning = "true: points begin with the velocities of the checkpoint; false: at rest. Default: true after "
                "explicit steps, false after equilibria. An Initial Velocity replaces both."});

}  // namespace

Section start_from_section() {
  return {.name = name,
          .meaning =
              "Bodies begin as another run of the same mesh, blocks, materials, symmetry planes and periodic sides "
              "left them, on any number of ranks: positions, velocities, stress and state of the laws, temperature, "
              "thermal strain, broken bonds, friction of surfaces. Conditions, contact, solver and output are those of "
              "this deck; work begins at zero.",
          .keys = {checkpoint, keeps_velocities}};
}

std::optional<StartFrom> read_start_from(const Values& deck) {
  if (!deck.has_section(name)) return std::nullopt;
  const Values& values = deck.section(name);
  return StartFrom{.checkpoint = values[checkpoint], .keeps_velocities = values[keeps_velocities]};
}

}  // namespace strut::deck

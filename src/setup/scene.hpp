// The objects of a run.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "conditions/conditions.hpp"
#include "contact/contact.hpp"
#include "mechanics/body.hpp"
#include "points/partition.hpp"
#include "setup/dropped.hpp"
#include "solvers/explicit/central_difference.hpp"
#include "solvers/quasi_static/quasi_static.hpp"

namespace strut {

struct Scene {
  Body body;
  Conditions conditions;
  contact::Contact contact;
  StepControl control;
  std::optional<QuasiStaticControl> quasi_static;  // in its place
  Cuts cuts;                                       // what the partition was made by
  std::int64_t points = 0, bonds = 0, pieces = 0;  // over all ranks
  Dropped dropped;
  std::string outline;   // box, mass, wave speeds, speeds: what slips of units change
  std::string warnings;  // what may be meant otherwise, a line each
};

}  // namespace strut

// The objects of a run.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "conditions/conditions.hpp"
#include "contact/contact.hpp"
#include "integrators/explicit/central_difference.hpp"
#include "integrators/quasi_static/quasi_static.hpp"
#include "mechanics/body.hpp"
#include "setup/dropped.hpp"
#include "topology/partition.hpp"

namespace strut {

// A rigid tool of the deck; the closing report says whether it was touched.
struct ToolOfScene {
  std::string name;
  std::shared_ptr<bool> touched;  // on this rank
  bool is_resumed = false;        // a checkpoint knows where it has cut cells
};

struct Scene {
  Body body;
  Conditions conditions;
  contact::Contact contact;
  std::optional<Fracture> fracture;  // if bonds may break
  StepControl control;
  std::optional<QuasiStaticControl> quasi_static;  // instead of `control`, for equilibria
  PartitionWeights weights;                        // the partition weights
  std::int64_t points = 0, bonds = 0, pieces = 0;  // over all ranks
  Dropped dropped;
  std::vector<ToolOfScene> tools = {};  // as tools_of(conditions)
  std::string warnings;                 // of the set-up, a line each
  double highest_frequency = 0;         // 1/s, largest frequency bound after mass scaling; 0: no limit
};

}  // namespace strut

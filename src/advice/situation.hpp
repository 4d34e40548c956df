// Inside advice: the input of its checks.
#pragma once

#include <vector>

#include "advice/trajectories.hpp"
#include "contact/contact.hpp"
#include "deck/deck.hpp"
#include "setup/scene.hpp"

namespace strut {

struct Situation {
  const deck::Deck& deck;
  const Scene& scene;
  double start, duration;                          // of the run, s
  std::vector<contact::Interaction> interactions;  // as contact uses them
  std::vector<double> spacings;                    // mean spacing of each block, m
  std::vector<Trajectory> trajectories;            // of blocks
  std::vector<double> members;  // thickness of the members of each block, spacings (mechanics/thin_members.hpp)
};

}  // namespace strut

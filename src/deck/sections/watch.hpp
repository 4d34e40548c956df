// The section Watch: what ends a run that has gone wrong.
#pragma once

#include "deck/forward.hpp"

namespace strut::deck {

struct Watch {
  bool stops{};            // else it is told once
  bool stops_inverted{};   // else points that are turned inside out go on as masses
  double balance_error{};  // of the largest energy
  double smallest_step{};  // of the first step
  double penetration{};    // of the distance at which points touch
  double passing{};        // of the points of the smaller of two bodies
};

Section watch_section();
Watch read_watch(const Values& deck);

}  // namespace strut::deck

// The section Watch: limits that end a run which has gone wrong.
#pragma once

#include "deck/forward.hpp"

namespace strut::deck {

struct Watch {
  bool stops{};               // else it only warns, once
  bool stops_inverted{};      // else inverted points continue as masses
  double balance_error{};     // relative to the largest energy
  double smallest_step{};     // relative to the first step
  double penetration{};       // relative to the touching distance of points
  double interpenetration{};  // relative to the points of the smaller of two bodies
};

Section watch_section();
Watch read_watch(const Values& deck);

}  // namespace strut::deck

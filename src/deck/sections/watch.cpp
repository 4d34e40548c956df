#include "deck/sections/watch.hpp"

#include "deck/values.hpp"

namespace strut::deck {

namespace {

const char* const name = "Watch";

const std::vector<std::pair<std::string, bool>> actions = {{"Stop", true}, {"Continue", false}};

const ChoiceKey<bool> stops(
    {.name = "Beyond Limits",
     .fallback = "Stop",
     .meaning = "What happens where a limit of this section is passed. Continue: it is told once."},
    actions);

const ChoiceKey<bool> stops_inverted(
    {.name = "Inverted Points",
     .fallback = "Stop",
     .meaning = "What happens where a point is turned inside out (det F ≤ 0). Continue: it goes on as a "
                "mass without stress while it is; in explicit steps."},
    actions);

const RealKey balance_error(
    {.name = "Balance Error",
     .range = positive,
     .fallback = "0.5",
     .meaning = "The largest error of the balance of energy, as a part of the largest energy; a fifth of it where "
                "energy is gained out of nothing. Looked at with each frame and line of the history after the first "
                "ten, and at the end of the run. From 1 % on a warning tells of it once."});

const RealKey smallest_step({.name = "Smallest Step",
                             .range = {.low = 0, .high = 1},
                             .fallback = "1e-3",
                             .meaning = "As a part of the first one; in explicit steps."});

const RealKey penetration(
    {.name = "Penetration",
     .range = {.low = 0, .high = 1},
     .fallback = "0.95",
     .meaning = "How far two points may come nearer than the distance at which they touch, as a part of "
                "it; in explicit steps."});

const RealKey passing(
    {.name = "Passing",
     .range = {.low = 0, .high = 1},
     .fallback = "0.01",
     .meaning = "How many points of two bodies between which there is contact may be inside the other one, in those of "
                "the smaller body, wherever points touch; looked at 200 times in a run. 1: never."});

}  // namespace

Section watch_section() {
  return {.name = name,
          .meaning =
              "What ends a run that has gone wrong, with the point, the likely cause and a last frame. A number "
              "that is not finite always does.",
          .keys = {stops, stops_inverted, balance_error, smallest_step, penetration, passing}};
}

Watch read_watch(const Values& deck) {
  const Values& values = deck.section(name);
  return {.stops = values[stops],
          .stops_inverted = values[stops_inverted],
          .balance_error = values[balance_error],
          .smallest_step = values[smallest_step],
          .penetration = values[penetration],
          .passing = values[passing]};
}

}  // namespace strut::deck

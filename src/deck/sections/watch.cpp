#include "deck/sections/watch.hpp"

#include "deck/values.hpp"

namespace strut::deck {

namespace {

const char* const name = "Watch";

const std::vector<std::pair<std::string, bool>> actions = {{"Stop", true}, {"Continue", false}};

const ChoiceKey<bool> stops({.name = "Beyond Limits", .fallback = "Stop", .meaning = "`Continue`: a warning, once."},
                            actions);

const ChoiceKey<bool> stops_inverted(
    {.name = "Inverted Points",
     .fallback = "Stop",
     .meaning =
         "Points with det F ≤ 0. `Continue`: in explicit steps they have mass but no stress while they are inverted. "
         "Ordinary solids (`Elastic`) go on either way, with a warning, once."},
    actions);

const RealKey balance_error(
    {.name = "Balance Error",
     .range = positive,
     .fallback = "0.5",
     .meaning =
         "Limit of the error of the energy balance over the largest energy; a fifth of this where energy is created. "
         "From 1 % on there is a warning. The first ten checks lead to neither."});

const RealKey smallest_step({.name = "Smallest Step",
                             .range = {.low = 0, .high = 1},
                             .fallback = "1e-3",
                             .meaning = "Limit of the time step over the first one (explicit steps)."});

const RealKey penetration(
    {.name = "Penetration",
     .range = {.low = 0, .high = 1},
     .fallback = "0.95",
     .meaning = "Limit of the overlap of two points over their touching distance (explicit steps)."});

const RealKey interpenetration({.name = "Passing",
                                .range = {.low = 0, .high = 1},
                                .fallback = "0.01",
                                .meaning = "Limit of interpenetration of bodies with declared contact: points inside "
                                           "the other body over the points of the smaller one. 1: no limit."});

}  // namespace

Section watch_section() {
  return {.name = name,
          .meaning =
              "Limits that end a run which has gone wrong, with the point, the likely cause and a last frame. A number "
              "that is not finite always ends it.",
          .keys = {stops, stops_inverted, balance_error, smallest_step, penetration, interpenetration}};
}

Watch read_watch(const Values& deck) {
  const Values& values = deck.section(name);
  return {.stops = values[stops],
          .stops_inverted = values[stops_inverted],
          .balance_error = values[balance_error],
          .smallest_step = values[smallest_step],
          .penetration = values[penetration],
          .interpenetration = values[interpenetration]};
}

}  // namespace strut::deck

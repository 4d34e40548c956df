#include "deck/sections/contact_laws.hpp"

namespace strut::deck {

namespace {

const RealKey radius(
    {.name = "Contact Radius",
     .unit = "m",
     .range = positive,
     .meaning = "r_c: points that are nearer repel each other. For points that start closer than r_c/0.9, 0.9 of "
                "their first distance. One spacing is a good choice."});

const RealKey friction(
    {.name = "Friction Coefficient", .range = not_negative, .fallback = "0", .meaning = "Coulomb's."});

const RealKey penalty({.name = "Spring Constant", .unit = "Pa", .range = positive, .meaning = "K_p."});

Section short_range_force() {
  return {.name = "Short Range Force",
          .meaning = "f = K_c (r_c − d) V₁ V₂ with K_c = 18 K_p/(π δ⁵), d the distance, δ the horizon.",
          .keys = {penalty}};
}

contact::Law make_penalty(const Values& model) {
  return contact::PenaltyLaw{.radius = model[radius], .penalty = model[penalty]};
}

const RealKey effective_modulus({.name = "Effective Modulus",
                                 .unit = "Pa",
                                 .range = positive,
                                 .meaning = "E*: 1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂."});

Section hertz() {
  return {.name = "Hertz",
          .meaning =
              "Elastic spheres: f = 4/3 E* √R* (r_c − d)^(3/2) with 1/R* = 1/R₁ + 1/R₂, R half the edge of a "
              "cube with the volume of the point, d the distance.",
          .keys = {effective_modulus}};
}

contact::Law make_hertz(const Values& model) {
  return contact::HertzLaw{.radius = model[radius], .effective_modulus = model[effective_modulus]};
}

struct Entry {
  Section schema;  // named as "Contact Model" has it
  contact::Law (*make)(const Values& model);
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = {{short_range_force(), make_penalty}, {hertz(), make_hertz}};
  return all;
}

}  // namespace

Key contact_law_key() {
  return {.name = "Contact Model",
          .meaning = "The law; it decides on further keys.",
          .hints = {{"Time-Dependent Short Range Force", "there are no coefficients that depend on time"}}};
}

std::vector<Key> contact_law_keys() { return {radius, friction}; }

std::vector<Section> contact_law_cases() { return schemas_of(entries()); }

// Of the first entry where the choice itself is among the problems.
contact::Model read_contact_law(const Values& model) {
  const Entry* chosen = chosen_of(entries(), model);
  return {chosen ? chosen->make(model) : contact::Law(), model[friction]};
}

}  // namespace strut::deck

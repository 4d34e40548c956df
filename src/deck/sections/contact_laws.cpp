#include "deck/sections/contact_laws.hpp"

namespace strut::deck {

namespace {

const RealKey radius({.name = "Contact Radius",
                      .unit = "m",
                      .range = positive,
                      .meaning = "r_c: points closer than this repel each other, at most the initial distance of a pair, "
                                 "within a body 0.9 of it. A good choice is one spacing."});

const RealKey friction(
    {.name = "Friction Coefficient", .range = not_negative, .fallback = "0", .meaning = "Coulomb friction."});

const RealKey penalty({.name = "Spring Constant", .unit = "Pa", .range = positive, .meaning = "K_p."});

Section short_range_force() {
  return {
      .name = "Short Range Force",
      .meaning = "Force between points f = K_c (r_c − d) V₁ V₂, K_c = 18 K_p/(π δ⁵), d the distance, δ the horizon.",
      .keys = {radius, penalty}};
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
          .keys = {radius, effective_modulus}};
}

contact::Law make_hertz(const Values& model) {
  return contact::HertzLaw{.radius = model[radius], .effective_modulus = model[effective_modulus]};
}

const RealKey stiffness_factor(
    {.name = "Stiffness Factor",
     .range = positive,
     .fallback = "0.25",
     .meaning = "Stiffness over that of a layer one spacing thick: a pressure p makes an overlap of p/(factor M) "
                "spacings, M the longitudinal modulus. 0.25 hardly changes the critical time step."});

const RealKey largest_overlap(
    {.name = "Largest Overlap",
     .unit = "spacings",
     .range = {.low = 0, .high = 1},
     .fallback = "0.5",
     .meaning =
         "The pressure grows like 1/(1 - overlap/limit), from 0.95 of the limit on along its tangent. 0: no limit."});

Section surface() {
  return {.name = "Surface",
          .meaning = "Contact between smooth surfaces at the faces of the cells, without a constant to choose.",
          .keys = {stiffness_factor, largest_overlap}};
}

contact::Law make_surface(const Values& model) {
  return contact::SurfaceLaw{.factor = model[stiffness_factor], .largest_overlap = model[largest_overlap]};
}

struct Entry {
  Section schema;  // named by the values of "Contact Model"
  contact::Law (*make)(const Values& model);
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = {
      {surface(), make_surface}, {short_range_force(), make_penalty}, {hertz(), make_hertz}};
  return all;
}

}  // namespace

Key contact_law_key() {
  return {.name = "Contact Model",
          .meaning = "Constitutive law.",
          .hints = {{"Time-Dependent Short Range Force", "there are no coefficients that depend on time"}}};
}

std::vector<Key> contact_law_keys() { return {friction}; }

std::vector<Section> contact_law_cases() { return schemas_of(entries()); }

// Uses the default law if the selection itself is wrong.
contact::Model read_contact_law(const Values& model) {
  const Entry* chosen = chosen_of(entries(), model);
  return {chosen ? chosen->make(model) : contact::Law(), model[friction]};
}

}  // namespace strut::deck

#include "deck/contact_laws.hpp"

namespace strut::deck {

namespace {

Section short_range_force() {
  return {.name = "Short Range Force",
          .meaning = "f = K_c (r_c − d) V₁ V₂ with K_c = 18 K_p/(π δ⁵), d the distance, δ the horizon.",
          .keys = {{.name = "Spring Constant", .unit = "Pa", .range = positive, .required = true, .meaning = "K_p."}}};
}

contact::Law make_penalty(const Values& model) {
  return contact::PenaltyLaw{.radius = model.real("Contact Radius"), .penalty = model.real("Spring Constant")};
}

Section hertz() {
  return {.name = "Hertz",
          .meaning =
              "Elastic spheres: f = 4/3 E* √R* (r_c − d)^(3/2) with 1/R* = 1/R₁ + 1/R₂, R half the edge of a "
              "cube with the volume of the point, d the distance.",
          .keys = {{.name = "Effective Modulus",
                    .unit = "Pa",
                    .range = positive,
                    .required = true,
                    .meaning = "E*: 1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂."}}};
}

contact::Law make_hertz(const Values& model) {
  return contact::HertzLaw{.radius = model.real("Contact Radius"),
                           .effective_modulus = model.real("Effective Modulus")};
}

}  // namespace

const std::vector<ContactLawEntry>& contact_laws() {
  static const std::vector<ContactLawEntry> entries = {{short_range_force(), make_penalty}, {hertz(), make_hertz}};
  return entries;
}

// Of the first entry where the choice itself is among the problems.
contact::Law make_contact_law(const Values& model) {
  for (const ContactLawEntry& entry : contact_laws()) {
    if (entry.schema.name == model.text("Contact Model")) return entry.make(model);
  }
  return contact_laws().front().make(model);
}

}  // namespace strut::deck

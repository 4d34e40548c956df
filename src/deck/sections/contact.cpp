#include "deck/sections/contact.hpp"

#include <algorithm>

#include "deck/sections/several_sections.hpp"

namespace strut::deck {

namespace {

// ---- Laws: the keys of each, and how it is made from them. A new law is one entry.

const RealKey radius(
    {.name = "Contact Radius",
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
     .meaning =
         "Stiffness over that of a layer one spacing thick: a pressure p makes an overlap of p/(factor M) "
         "spacings, M the longitudinal modulus. 0.25 hardly changes the critical time step, and gives way like four "
         "more layers of cells: in equilibria of elastic bodies take 2.5 or more."});

const RealKey largest_overlap(
    {.name = "Largest Overlap",
     .unit = "spacings",
     .range = {.low = 0, .high = 1},
     .fallback = "0.5",
     .meaning =
         "The pressure grows like 1/(1 - overlap/limit), from 0.95 of the limit on along its tangent. 0: no limit."});

Section surface() {
  return {.name = "Surface",
          .meaning = "Contact between smooth surfaces at the faces of the cells.",
          .keys = {stiffness_factor, largest_overlap}};
}

contact::Law make_surface(const Values& model) {
  return contact::SurfaceLaw{.factor = model[stiffness_factor], .largest_overlap = model[largest_overlap]};
}

const std::vector<Case<contact::Law>>& contact_laws() {
  static const std::vector<Case<contact::Law>> all = {
      {surface(), make_surface}, {short_range_force(), make_penalty}, {hertz(), make_hertz}};
  return all;
}

// ---- Sections

const char* const name = "Contact";
const char* const models_name = "Models";
const char* const interactions_name = "Interactions";

const OptionalKey<std::string> first_block(
    {.name = "First Block",
     .meaning = "A block of the mesh. If both keys are missing: all pairs of blocks, and of a block and itself, that "
                "no other interaction names "
                "(section `General Contact`: only of two blocks, `Self Contact`: only of a block and itself)."});

const OptionalKey<std::string> second_block({.name = "Second Block",
                                             .meaning = "The other block, or the same (self-contact)."});

const TextKey model({.name = "Contact Model", .meaning = "A section of Models."});

Section models_section() {
  Key law{.name = "Contact Model",
          .meaning = "Constitutive law.",
          .hints = {{"Time-Dependent Short Range Force", "there are no coefficients that depend on time"}}};
  Section one{.name = any_name, .required = true, .meaning = "One contact model.", .keys = {friction}};
  return {.name = models_name,
          .required = true,
          .meaning = "Models by name.",
          .sections = {with_cases(std::move(one), std::move(law), schemas_of(contact_laws()))}};
}

Section interactions_section() {
  return {.name = interactions_name,
          .required = true,
          .meaning = "Pairs of blocks, by any name.",
          .sections = {{.name = any_name,
                        .required = true,
                        .meaning = "One pair. Bonded points never touch.",
                        .keys = {first_block, second_block, model}}}};
}

// The blocks of the mesh that an interaction joins, in sorted order.
std::pair<std::string, std::string> parties(const Interaction& interaction) {
  return std::minmax(interaction.first_block, interaction.second_block);
}

void check_interaction(const Interaction& one, const std::vector<Interaction>& earlier, const std::string& path,
                       Problems& problems) {
  if (one.first_block.empty() != one.second_block.empty()) {
    problems.add(path, "one block is named; expected First Block and Second Block, or neither of them for all blocks");
  }
  for (const Interaction& other : earlier) {
    const bool apart =
        one.partners != other.partners && one.partners != Partners::any && other.partners != Partners::any;
    if (parties(one) == parties(other) && !apart)
      problems.add(path, "joins the same blocks as " + other.name + "; expected once");
  }
}

// The names that Peridigm knows; they have no meaning for an interaction that names its blocks.
Partners partners(const Values& interaction) {
  if (interaction.has(first_block)) return Partners::any;
  if (interaction.name() == "General Contact") return Partners::others;
  return interaction.name() == "Self Contact" ? Partners::itself : Partners::any;
}

}  // namespace

Section contact_section() {
  const std::string found = "the program finds out when to search";
  return {
      .name = name,
      .meaning = "Contact between bodies, and of a body with itself; none without this section.",
      .keys = {verbose_without_effect(),
               without_effect({.name = "Search Radius", .unit = "m", .range = positive}, found),
               without_effect({.name = "Search Frequency", .kind = Kind::integer, .unit = "steps", .range = {.low = 1}},
                              found)},
      .sections = {models_section(), interactions_section()}};
}

std::vector<ContactModel> read_contact_models(const Values& deck) {
  std::vector<ContactModel> all;
  for (const Values& section : deck.section(name).section(models_name).sections()) {
    const auto* law = chosen_of(contact_laws(), section);  // the default law if the selection itself is wrong
    all.push_back({section.name(), {law ? law->make(section) : contact::Law(), section[friction]}});
  }
  return all;
}

std::vector<Interaction> read_interactions(const Values& deck, const std::vector<ContactModel>& models,
                                           Problems& problems) {
  std::vector<Interaction> all;
  for (const Values& section : deck.section(name).section(interactions_name).sections()) {
    const Interaction one{.name = section.name(),
                          .first_block = section[first_block].value_or(""),
                          .second_block = section[second_block].value_or(""),
                          .partners = partners(section),
                          .model = find_named(section, model, models, "Contact > Models", problems)};
    check_interaction(one, all, section.path(), problems);
    all.push_back(one);
  }
  return all;
}

}  // namespace strut::deck

#include "deck/sections/contact.hpp"

#include <algorithm>

#include "deck/sections/contact_laws.hpp"
#include "deck/sections/several_sections.hpp"

namespace strut::deck {

namespace {

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
  Section one{.name = any_name, .required = true, .meaning = "One contact model.", .keys = contact_law_keys()};
  return {.name = models_name,
          .required = true,
          .meaning = "Models by name.",
          .sections = {with_cases(std::move(one), contact_law_key(), contact_law_cases())}};
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
    all.push_back({section.name(), read_contact_law(section)});
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

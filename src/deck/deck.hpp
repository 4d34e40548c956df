// A deck as plain structs: the only form of an input file that the rest of the program sees. Units are SI. The struct
// of each section is in sections/; members initialized with {} get their defaults from the section's keys, which also
// document them (and the page made from them).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "deck/problems.hpp"
#include "deck/sections/blocks.hpp"
#include "deck/sections/conditions.hpp"
#include "deck/sections/contact.hpp"
#include "deck/sections/damage_models.hpp"
#include "deck/sections/discretization.hpp"
#include "deck/sections/materials.hpp"
#include "deck/sections/node_sets.hpp"
#include "deck/sections/output.hpp"
#include "deck/sections/restart.hpp"
#include "deck/sections/solver.hpp"
#include "deck/sections/watch.hpp"

namespace strut {
class Communicator;
}

namespace strut::deck {

struct Deck {
  std::filesystem::path file;
  std::string text;  // as it was read, with the numbers of tables in files
  Discretization discretization;
  std::vector<NodeSet> node_sets;
  std::vector<Material> materials;
  std::vector<NamedDamageModel> damage_models;
  std::vector<Block> blocks;
  std::vector<ContactModel> contact_models;
  std::vector<Interaction> interactions;
  std::vector<Condition> conditions;
  std::optional<StartFrom> start_from;
  Solver solver;
  std::optional<Solver> next_solver;  // explicit steps after the equilibria of `solver`
  Output output;
  History history;
  Restart restart;
  Watch watch;
  bool from_peridigm = false;      // written for that program: its meanings hold
  std::vector<std::string> notes;  // accepted input without an effect, or with another one than in another program
};

// Collective. Reads and checks `file`; throws one Error on all ranks that lists every problem, each with its path
// (Blocks > foam > Horizon), the value, what was expected with its unit, and the nearest valid name.
Deck read(const std::filesystem::path& file, const Communicator& communicator);
// The same, but errors are added to `problems`, so that more may be found; the corresponding members are zero, empty or
// false. Throws if the file is no deck at all.
Deck read(const std::filesystem::path& file, const Communicator& communicator, Problems& problems);

// The same for a text, of rank 0, as if it stood in `file`; its mesh may be one in memory, and its history without a
// file.
Deck read_text(std::string text, const std::filesystem::path& file, const Communicator& communicator,
               Problems& problems);

// The schema of a whole deck, assembled from its sections.
const Section& schema();

// The reference page of all keys (Markdown), generated from the schema.
std::string reference_page();

// Describes the keys and sections with this name, ignoring case: their paths, values and meanings. Throws Error with
// the nearest name if there is none.
std::string explanation(const std::string& name);

}  // namespace strut::deck

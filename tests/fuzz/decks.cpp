// The repository's own decks, each with a small mesh that has the blocks and node sets it names, at a spacing that
// suits its horizons. One that is accepted is set up and makes two steps.
#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

#include "advice/advice.hpp"
#include "base/errors.hpp"
#include "deck/deck.hpp"
#include "files.hpp"
#include "meshes.hpp"
#include "mutate.hpp"
#include "output/variables.hpp"
#include "setup/setup.hpp"
#include "subjects.hpp"
#include "unit/deck/deck_under_test.hpp"

namespace strut::fuzz {

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> decks_of_the_repository() {
  std::vector<fs::path> decks;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(STRUT_SOURCE_DIR) / "inputs")) {
    if (entry.path().extension() == ".xml") decks.push_back(entry.path());
  }
  std::sort(decks.begin(), decks.end());
  return decks;
}

io::Mesh mesh_for(const deck::Deck& deck) {
  std::set<std::string> blocks, sets;
  for (const deck::Block& section : deck.blocks) blocks.insert(section.block_names.begin(), section.block_names.end());
  for (const deck::Condition& condition : deck.conditions) sets.insert(condition.node_set);
  for (const std::string& variable : deck.history.variables) {  // "Max_Displacement(foot)"
    const std::size_t open = variable.find('(');
    if (open != std::string::npos) sets.insert(variable.substr(open + 1, variable.size() - open - 2));
  }
  for (const deck::Profile& profile : deck.history.profiles) sets.erase(profile.name);
  for (const deck::NodeSet& set : deck.node_sets) sets.erase(set.name);
  for (const std::string& block : blocks) sets.erase(block);
  std::erase_if(sets, [](const std::string& set) { return set == "all" || set.find(':') != std::string::npos; });
  sets.insert("foot");
  io::Mesh mesh;
  double z = 0;
  for (const deck::Block& section : deck.blocks) {
    for (const std::string& name : section.block_names) {
      const double spacing = section.horizon ? *section.horizon / 2.5 : 1e-3;
      add_box(mesh, name == "all" ? "body" : name, spacing, z, {sets.begin(), sets.end()});
      z += 6 * spacing;
    }
  }
  return mesh;
}

// The same points, as lines of a text file.
std::string lines_of(const io::Mesh& mesh) {
  std::ostringstream text;
  int number = 0;
  for (const io::Mesh::Block& block : mesh.blocks) {
    ++number;
    for (std::size_t n = 0; n < block.nodes.size(); n += 8) {
      const Vector &low = mesh.nodes[block.nodes[n]], &high = mesh.nodes[block.nodes[n + 6]];
      const Vector middle = (low + high) / 2;
      text << middle[0] << " " << middle[1] << " " << middle[2] << " " << number << " " << (high - low).prod() << "\n";
    }
  }
  return text.str();
}

// A deck that names a mesh of its own in the folder.
std::string with_mesh(const fs::path& folder, const std::string& stem, std::string deck, const Communicator& world) {
  static const std::regex mesh_file("(\"Input Mesh File\"[^>]*value=\")[^\"]*");
  deck = std::regex_replace(deck, mesh_file, "$1" + stem + ".g");
  write(folder / (stem + ".g"), "to be written");
  write(folder / "sample.xml", deck);
  const deck::Deck read = deck::read(folder / "sample.xml", world);
  const io::Mesh mesh = mesh_for(read);
  if (read.discretization.type == deck::MeshType::text) {
    write(folder / (stem + ".g"), lines_of(mesh));
  } else {
    io::write_mesh(folder / (stem + ".g"), mesh);
  }
  return deck;
}

void set_up_and_step(const fs::path& file, const Communicator& world) {
  const deck::Deck deck = deck::read(file, world);
  Scene scene = set_up(deck, world);
  advice(deck, scene);
  output_variables_of(deck, scene.body, scene.contact);
  if (scene.quasi_static) return;
  CentralDifference solver(scene.body, std::move(scene.conditions), std::move(scene.contact), scene.control,
                           deck.solver.initial_time, std::move(scene.fracture));
  for (int step = 0; step < 2 && solver.time() < deck.solver.final_time; ++step) {
    solver.advance_velocity(deck.solver.final_time);
    solver.advance_position(false);
  }
}

std::string change(const std::string& sample, const std::string& other, Random& random) {
  if (random.chance(0.8)) return changed_deck(sample, random);
  return random.chance(0.5) ? damaged(sample, other, random) : damaged(changed_deck(sample, random), other, random);
}

}  // namespace

Subject decks(const fs::path& folder, const Communicator& world) {
  Subject subject{"deck", "deck.xml", {}, change, [&world](const fs::path& file) { set_up_and_step(file, world); }};
  subject.samples = {with_mesh(folder, "full", deck::full_deck, world),
                     with_mesh(folder, "small", deck::small_deck, world)};
  for (const fs::path& deck : decks_of_the_repository()) {
    subject.samples.push_back(with_mesh(folder, deck.stem().string(), contents(deck), world));
  }
  return subject;
}

}  // namespace strut::fuzz

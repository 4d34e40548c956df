#include "deck/sections/node_sets.hpp"

#include "deck/problems.hpp"
#include "deck/values.hpp"

namespace strut::deck {

namespace {

const char* const name = "Node Sets";

const AnyKey<Function> where("Points at whose reference position (m) the expression is not zero, e.g. `z &lt; 1e-3`.");

}  // namespace

Section node_sets_section() {
  return {.name = name, .meaning = "Additional sets of points; each key is the name of one.", .any_key = where};
}

std::vector<NodeSet> read_node_sets(const Values& deck, Problems& problems) {
  const Values& values = deck.section(name);
  std::vector<NodeSet> sets;
  for (const auto& [set, points] : values.all(where)) {
    const std::string path = path_to(values.path(), set);
    if (set == "all") problems.add(path, "is the set of all points; expected another name");
    if (points.depends_on_time()) problems.add(path, "depends on t; expected an expression in x, y, z");
    sets.push_back({set, points});
  }
  return sets;
}

}  // namespace strut::deck

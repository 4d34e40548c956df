#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <sstream>
#include <utility>
#include <variant>

#include "advice/checks.hpp"
#include "advice/mesh_nodes.hpp"
#include "base/text.hpp"
#include "setup/blocks.hpp"
#include "setup/found_points.hpp"
#include "topology/pieces.hpp"

namespace strut {

namespace {

bool may_be_bonded(const BlockHorizons& one, const BlockHorizons& other, double gap) {
  return one.body == other.body && gap <= 0.5 * (one.largest + other.largest);
}

// The pairs of blocks with an interaction, the lower one first.
std::set<IndexPair> declared_pairs(const Situation& situation) {
  std::set<IndexPair> pairs;
  for (const contact::Interaction& one : situation.interactions)
    pairs.insert({std::min(one.first, one.second), std::max(one.first, one.second)});
  return pairs;
}

// The first time at which blocks meet, or one of them an image of the other one period away; not where the two may be
// bonded, in the cell or through a side.
std::optional<double> first_meeting(const Situation& situation, int one, int other) {
  const Domain& domain = situation.scene.body.domain;
  const Trajectory& a = situation.trajectories[one];
  const Images images(domain.periods, 0);
  std::optional<double> first;
  std::vector<View> views;  // empty until boxes along the axes of space meet
  for (int image = 0; image < images.count(); ++image) {
    const Vector shift = images[image].stretched(domain.halo.stretch()).shift;
    const Trajectory b = shifted(situation.trajectories[other], shift);
    if (may_be_bonded(domain.blocks[one], domain.blocks[other], a.places.exteriorDistance(b.places))) continue;
    auto time = meeting_time(a, b, situation.duration);
    if (time) {
      if (views.empty()) views = views_of(situation.scene.body, situation.trajectories, one, other);
      time = meeting_time(views, situation.duration, shift);
    }
    if (time) first = std::min(*time, first.value_or(*time));
  }
  return first;
}

}  // namespace

std::string undeclared_contacts(const Situation& situation) {
  const std::vector<std::string>& names = situation.scene.body.domain.cloud.block_names;
  const std::set<IndexPair> declared = declared_pairs(situation);
  std::ostringstream text;
  for (int a = 0; a < std::ssize(names); ++a) {
    for (int b = a + 1; b < std::ssize(names); ++b) {
      if (declared.contains({a, b})) continue;
      const auto time = first_meeting(situation, a, b);
      if (!time) continue;
      text << "WARNING: blocks " << names[a] << " and " << names[b] << " meet at about t = " << situation.start + *time
           << " s, if they go on as at the start, and will pass through each other: no contact between them is "
           << "declared (Contact > Interactions)\n";
    }
  }
  return text.str();
}

namespace {

Vector bond(const Domain& domain, int i, int j) { return domain.reference(j) - domain.reference(i); }

// Largest distances of points that touch, in spacings: of elements, which lie on one lattice or on two that match; of
// nodes, which touch only at one place; and of points whose elements are unknown, which need no lattice.
constexpr double gap_of_elements = 1.02, gap_of_nodes = 0.1, gap_of_points = 1.25;

// For points of known elements.
double known_gap(const Domain& domain) { return domain.cloud.at == PointsAt::nodes ? gap_of_nodes : gap_of_elements; }

// The edges of the cell of an owned point along the axes, m, if it is one of a lattice along these, whose steps then
// have its volume; else 0.
Vector edges_on_lattice(const Domain& domain, int i) {
  constexpr double narrow = 0.8;  // the cosine of the cone around an axis that holds the next point
  constexpr double alike = 1e-3;  // the relative difference of volumes
  Vector steps = Vector::Constant(std::numeric_limits<double>::infinity());
  domain.families.for_each(i, [&](int j) {
    const Vector along = bond(domain, i, j).cwiseAbs();
    for (int c = 0; c < 3; ++c) {
      if (along[c] > narrow * along.norm()) steps[c] = std::min(steps[c], along[c]);
    }
  });
  const double whole = std::pow(domain.cloud.spacings[i], 3);
  return std::abs(steps.prod() - whole) < alike * whole ? steps : Vector(Vector::Zero());
}

// True if the cells of a bond's ends touch, so that it bridges no gap: they are within `gap` spacings, or edges along
// each axis, whose cells need not be cubes nor stand in line.
bool touch(const Vector& xi, double spacing, const Vector& edges, double gap) {
  return xi.norm() <= gap * spacing || (xi.cwiseAbs().array() <= gap * edges.array()).all();
}

// True if bonds may join blocks: two of them are of one body.
bool may_join_blocks(const Domain& domain) {
  std::set<int> bodies;
  for (const BlockHorizons& block : domain.blocks) bodies.insert(block.body);
  return bodies.size() < domain.blocks.size();
}

// Number of bonds between two blocks, both ends counted as one, how many ends are between elements with a node in
// common, and between cells that touch.
struct BondsBetween {
  double count = 0, joined = 0, touching = 0;
  bool are_across_a_gap() const { return count > 0 && joined == 0 && touching == 0; }
};
using BondsOfPairs = std::map<IndexPair, BondsBetween>;

// Collective. The pairs of blocks that are bonded to each other, the lower one first. `unknown`: the gap, in spacings,
// from which on points of unknown elements do not touch.
BondsOfPairs bonds_of_pairs(const Domain& domain, const std::vector<int>& blocks, const MeshNodes& nodes,
                            double unknown) {
  BondsOfPairs mine;
  if (!may_join_blocks(domain)) return mine;
  for (int i = 0; i < domain.owned; ++i) {
    const int here = domain.cloud.blocks[i];
    std::optional<Vector> edges;
    domain.families.for_each(i, [&](int j) {
      if (blocks[j] == here) return;
      if (!edges) edges = edges_on_lattice(domain, i);
      const double spacing = std::max(domain.blocks[here].spacing, domain.blocks[blocks[j]].spacing);
      const bool of_both = nodes.of_both(i, j);
      BondsBetween& bonds = mine[{std::min(here, blocks[j]), std::max(here, blocks[j])}];
      bonds.count += here < blocks[j] ? 1 : 0;
      bonds.joined += of_both && nodes.may_join(i, j) ? 1 : 0;
      bonds.touching += touch(bond(domain, i, j), spacing, *edges, of_both ? known_gap(domain) : unknown) ? 1 : 0;
    });
  }
  std::vector<IndexPair> pairs;
  for (const auto& [pair, bonds] : mine) pairs.push_back(pair);
  pairs = on_all_ranks(std::move(pairs), domain.communicator);
  std::vector<double> sums;
  for (const IndexPair& pair : pairs) {
    for (const double one : {mine[pair].count, mine[pair].joined, mine[pair].touching}) sums.push_back(one);
  }
  domain.communicator.sum(sums);
  BondsOfPairs all;
  for (std::size_t n = 0; n < pairs.size(); ++n) all[pairs[n]] = {sums[3 * n], sums[3 * n + 1], sums[3 * n + 2]};
  return all;
}

// The pairs of blocks that are bonded to each other across a gap only, and not joined by other blocks.
std::vector<IndexPair> bonded_across_gaps(const BondsOfPairs& bonded, std::size_t blocks) {
  std::vector<int> piece(blocks);
  std::iota(piece.begin(), piece.end(), 0);
  for (const auto& [pair, bonds] : bonded) {
    if (!bonds.are_across_a_gap()) std::ranges::replace(piece, int(piece[pair[1]]), int(piece[pair[0]]));
  }
  std::vector<IndexPair> pairs;
  for (const auto& [pair, bonds] : bonded) {
    if (bonds.are_across_a_gap() && piece[pair[0]] != piece[pair[1]]) pairs.push_back(pair);
  }
  return pairs;
}

// For owned points and ghosts the part of the mesh that elements with a common node make, or those that touch without.
// Both ends of a bond must find the same, so distances are compared with means of both.
std::vector<std::int64_t> parts_of(const Domain& domain, const std::vector<int>& blocks, const MeshNodes& nodes,
                                   bool is_whole) {
  std::vector<std::int64_t> parts(domain.sites.size(), 0);
  if (!nodes.any() || !is_whole) return parts;
  std::vector<Vector> edges;
  for (int i = 0; i < domain.owned; ++i) edges.push_back(edges_on_lattice(domain, i));
  edges.resize(domain.sites.size());
  domain.halo.exchange<reflect_direction>(edges);
  const auto mean_of = [](const Vector& one, const Vector& other) -> Vector {
    if (one.isZero(0) || other.isZero(0)) return Vector::Zero();
    return 0.5 * (one.cwiseAbs() + other.cwiseAbs());  // planes of symmetry turn their signs
  };
  parts = piece_ids(domain, [&](int i, int j) {
    return nodes.may_join(i, j) ||
           touch(bond(domain, i, j), 0.5 * (domain.blocks[blocks[i]].spacing + domain.blocks[blocks[j]].spacing),
                 mean_of(edges[i], edges[j]), known_gap(domain));
  });
  parts.resize(domain.sites.size());
  domain.halo.exchange(parts);
  return parts;
}

// Collective. The bonds of each block from one part to another, which bridge a gap.
std::vector<double> bonds_of_parts(const Domain& domain, const std::vector<int>& blocks,
                                   const std::vector<std::int64_t>& parts) {
  std::vector<double> bonds(domain.blocks.size(), 0);
  for (int i = 0; i < domain.owned; ++i) {
    double& of_block = bonds[domain.cloud.blocks[i]];
    domain.families.for_each(i, [&](int j) { of_block += blocks[j] == blocks[i] && parts[i] != parts[j] ? 0.5 : 0; });
  }
  domain.communicator.sum(bonds);
  return bonds;
}

// Collective. False if bonds have broken in the run before: those that are left tell nothing of gaps in the mesh.
bool is_whole(const Body& body) {
  bool lost = false;
  for (int i = 0; i < body.owned(); ++i) lost = lost || body.has_lost_bonds(i);
  return !body.domain.communicator.any(lost);
}

std::string remedy(const deck::Deck& deck, const std::string& first, const std::string& second) {
  const std::string one = section_of(deck, first)->name, other = section_of(deck, second)->name;
  if (one == other) return "a section of Blocks for each of them (both are in '" + one + "'), with Separate Body true";
  return "Blocks > " + one + " > Separate Body true, or Blocks > " + other + " > Separate Body true";
}

// The interaction of the deck that lets two blocks meet, or a block itself; nullptr without one.
const deck::Interaction* interaction_of(const deck::Deck& deck, const std::vector<std::string>& names, int a, int b) {
  const auto is_meant = [&](const deck::Interaction& one) {
    return one.first_block.empty() ? one.partners != (a == b ? deck::Partners::others : deck::Partners::itself)
                                   : std::minmax(one.first_block, one.second_block) == std::minmax(names[a], names[b]);
  };
  const auto one = std::ranges::find_if(deck.interactions, is_meant);
  return one == deck.interactions.end() ? nullptr : &*one;
}

}  // namespace

std::string bonded_contacts(const Situation& situation) {
  const deck::Deck& deck = situation.deck;
  const Domain& domain = situation.scene.body.domain;
  if (deck.interactions.empty()) return "";
  const std::vector<std::string>& names = domain.cloud.block_names;
  const std::vector<int> blocks = blocks_of(domain);
  const MeshNodes nodes(domain);
  const bool whole = is_whole(situation.scene.body);
  std::map<IndexPair, std::string> lines;
  const std::vector<double> across = bonds_of_parts(domain, blocks, parts_of(domain, blocks, nodes, whole));
  for (int a = 0; a < std::ssize(names); ++a) {
    const deck::Interaction* one = across[a] > 0 ? interaction_of(deck, names, a, a) : nullptr;
    if (!one) continue;
    lines[{a, a}] = text_of("WARNING: Contact > Interactions > ", one->name, ": parts of block ", names[a],
                            " that share no node are bonded to each other by ", static_cast<std::int64_t>(across[a]),
                            " bonds across gaps, between whose ends contact never acts; expected, for bodies that "
                            "meet, a block of the mesh for each of them, with Separate Body true\n");
  }
  for (const auto& [pair, bonds] : bonds_of_pairs(domain, blocks, nodes, gap_of_elements)) {
    const auto& [a, b] = pair;
    const deck::Interaction* one = interaction_of(deck, names, a, b);
    if (!one || (one->first_block.empty() && !(whole && bonds.are_across_a_gap()))) continue;
    lines[pair] = text_of("WARNING: Contact > Interactions > ", one->name, ": blocks ", names[a], " and ", names[b],
                          " are bonded to each other by ", static_cast<std::int64_t>(bonds.count),
                          " bonds, between whose ends contact never acts; expected, for bodies that meet, ",
                          remedy(deck, names[a], names[b]), "\n");
  }
  std::string text;
  for (const auto& [pair, line] : lines) text += line;
  return text;
}

// Where contact is declared, bonded_contacts() tells of them.
std::string bonded_gaps(const Situation& situation) {
  const Domain& domain = situation.scene.body.domain;
  // Cells of a grid leave no gap.
  if (situation.deck.discretization.type == deck::MeshType::grid || !is_whole(situation.scene.body)) return "";
  std::string text;
  const std::vector<std::string>& names = domain.cloud.block_names;
  const std::set<IndexPair> declared = declared_pairs(situation);
  const std::vector<int> blocks = blocks_of(domain);
  const MeshNodes nodes(domain);
  const std::vector<double> across = bonds_of_parts(domain, blocks, parts_of(domain, blocks, nodes, true));
  for (int a = 0; a < std::ssize(names); ++a) {
    if (across[a] == 0 || declared.contains({a, a})) continue;
    text += text_of("WARNING: parts of block ", names[a], " that share no node are bonded to each other by ",
                    static_cast<std::int64_t>(across[a]),
                    " bonds across gaps, as one body; expected, for bodies that meet, a block of the mesh for each of "
                    "them, with Separate Body true\n");
  }
  if (!may_join_blocks(domain)) return text;
  const BondsOfPairs bonded = bonds_of_pairs(domain, blocks, nodes, gap_of_points);
  for (const auto& [a, b] : bonded_across_gaps(bonded, names.size())) {
    if (declared.contains({a, b})) continue;
    text += "WARNING: blocks " + names[a] + " and " + names[b] +
            " are bonded to each other across the gap between them, as one body; expected, for bodies that meet, " +
            remedy(situation.deck, names[a], names[b]) + " and contact between them (Contact > Interactions)\n";
  }
  return text;
}

// Two blocks that are bonded and meet a third, or one of themselves.
std::string surfaces_at_seams(const Situation& situation) {
  const Domain& domain = situation.scene.body.domain;
  std::map<int, std::set<int>> met;  // blocks that a block meets by surfaces
  for (const contact::Interaction& one : situation.interactions) {
    if (!std::holds_alternative<contact::SurfaceLaw>(one.model.law)) continue;
    met[one.first].insert(one.second), met[one.second].insert(one.first);
  }
  if (met.empty() || !may_join_blocks(domain)) return "";
  const std::vector<std::string>& names = domain.cloud.block_names;
  std::string text;
  for (const auto& [pair, bonds] : bonds_of_pairs(domain, blocks_of(domain), MeshNodes(domain), gap_of_points)) {
    const auto& [a, b] = pair;
    const std::set<int>& others = met[b];
    if (std::ranges::none_of(met[a], [&](int block) { return others.contains(block); })) continue;
    text += "WARNING: blocks " + names[a] + " and " + names[b] +
            " are bonded to each other, but each has a surface of its own, and contact by 'Surface' is softer along "
            "their seam (half of the pressure, to two spacings from it); expected one block of the mesh where this "
            "counts, or contact between points\n";
  }
  return text;
}

std::string contact_at_mirrors(const Situation& situation) {
  const Domain& domain = situation.scene.body.domain;
  std::set<int> concerned;  // a plane has a mirror for each body
  for (const Mirror& mirror : domain.mirrors) {
    const auto concerns = [&](const contact::Interaction& one) {
      return domain.blocks[one.first].body == mirror.body || domain.blocks[one.second].body == mirror.body;
    };
    if (std::ranges::any_of(situation.interactions, concerns)) concerned.insert(mirror.number);
  }
  std::string text;
  for (const int number : concerned) {
    text += "WARNING: Boundary Conditions > " + situation.deck.conditions[number].name +
            ": contact does not see mirror images: bodies that come to the plane from one side go through it, and "
            "contact within a contact radius of it is that of an edge\n";
  }
  return text;
}

}  // namespace strut

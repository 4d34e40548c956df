#include "mechanics/serialize.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "mechanics/formulation/quadratic_fits.hpp"
#include "mechanics/passes.hpp"

namespace strut {

namespace {

std::uint64_t mixed(std::uint64_t word, std::uint64_t other) {
  const std::uint64_t first = (word + 1) * 0x9e3779b97f4a7c15u;
  return (first ^ (first >> 31) ^ other) * 0xbf58476d1ce4e5b9u;
}

std::uint64_t word_of(const std::string& name) {
  std::uint64_t word = 0;
  for (const char c : name) word = mixed(word, static_cast<unsigned char>(c));
  return word;
}

std::vector<std::uint64_t> words_of(const std::vector<std::string>& names) {
  std::vector<std::uint64_t> words;
  for (const std::string& name : names) words.push_back(word_of(name));
  return words;
}

// Collective. A hash of what word(i) says of each owned point, independent of their distribution over the ranks.
template <class Word>
double mark_of(const Body& body, const Word& word) {
  constexpr std::uint64_t digits = (std::uint64_t{1} << 52) - 1;  // that a double holds exactly
  const Domain& domain = body.domain;
  std::uint64_t sum = 0;
  for (int i = 0; i < body.owned(); ++i) {
    sum += mixed(word(i), static_cast<std::uint64_t>(domain.cloud.ids[i])) >> 20;
  }
  const std::int64_t all = domain.communicator.sum(static_cast<std::int64_t>(sum));
  return static_cast<double>(static_cast<std::uint64_t>(all) & digits);
}

double mark_of_blocks(const Body& body) {
  const std::vector<std::uint64_t> names = words_of(body.domain.cloud.block_names);
  return mark_of(body, [&](int i) { return names[body.domain.cloud.blocks[i]]; });
}

// The bonds of the set-up, the broken ones included, in any order. An image counts as its original.
double mark_of_bonds(const Body& body) {
  const Domain& domain = body.domain;
  return mark_of(body, [&](int i) {
    std::uint64_t count = 0, sum = 0;
    const auto add = [&](int j) {
      ++count, sum += mixed(static_cast<std::uint64_t>(Images::original(domain.id(j))), 0);
    };
    domain.families.for_each(i, add);
    if (body.has_lost_bonds(i)) std::ranges::for_each(domain.families.broken[i], add);
    return mixed(sum, count);
  });
}

// Without their surfaces, which are sums over faces. 0: the mesh has no shapes, or nothing needs them.
double mark_of_cells(const Body& body) {
  const std::vector<CellShape>& shapes = body.domain.cloud.shapes;
  if (!body.domain.communicator.any(!shapes.empty())) return 0;
  return mark_of(body, [&](int i) {
    std::uint64_t word = 0;
    for (const double x : shapes[i].offset) word = mixed(word, std::bit_cast<std::uint64_t>(x));
    for (const double x : shapes[i].moments) word = mixed(word, std::bit_cast<std::uint64_t>(x));
    return word;
  });
}

// A check sum of data that the checkpoint has no column for, and the message if the checkpoint has another sum.
struct Mark {
  const char* name;
  double own;
  const char* text;
  bool may_be_none = false;
  double kept = own;

  bool differs() const { return kept != own && !(may_be_none && (kept == 0 || own == 0)); }
};

// Either run may need shapes that the other does not, as profiles of the history do: then there is none to compare.
std::vector<Mark> marks_of(const Body& body) {
  return {
      {"blocks", mark_of_blocks(body), "in blocks of other names"},
      {"bonds", mark_of_bonds(body), "bonded to others (by a mesh of Bond Filters, or the nodes that elements share)"},
      {"cells", mark_of_cells(body), "of other shapes", true}};
}

// Collective. `others`: what the points are that they were not.
void expect_same_mesh(const Body& body, const std::vector<std::string>& others) {
  raise_together(body.domain.communicator, others.empty()
                                               ? ""
                                               : "the mesh is not the one with which the run began: points are " +
                                                     joined(others) + "; a run can go on with the same one only");
}

// Collective. Compares the mesh with that of the checkpoint; nothing of it is restored.
void compare_reference(Archive& archive, const Body& body) {
  std::vector<Mark> marks = marks_of(body);
  for (Mark& mark : marks) archive.number(mark.name, mark.kept);
  std::vector<Eigen::Array4d> kept;
  for (int i = 0; i < body.owned(); ++i) kept.push_back(body.domain.sites[i].reference);
  archive.field("reference", 4, [&](std::size_t i, int c) -> double& { return kept[i][c]; });
  bool same = true;
  for (int i = 0; i < body.owned(); ++i) same = same && (kept[i] == body.domain.sites[i].reference).all();
  std::vector<std::string> others;
  if (body.domain.communicator.any(!same)) others.emplace_back("at other places, or of other volumes");
  for (const Mark& mark : marks) {
    if (mark.differs()) others.push_back(mark.text);
  }
  expect_same_mesh(body, others);
}

FieldIndices indices_of(const MaterialBlock& block) {
  return {block.points_per_cell(), [&block](std::size_t k, int q) { return block.index(k, q); }};
}

}  // namespace

std::vector<std::int64_t> ids_of(const Body& body, const std::vector<int>& points) {
  std::vector<std::int64_t> ids;
  ids.reserve(points.size());
  for (const int i : points) ids.push_back(body.domain.cloud.ids[i]);
  return ids;
}

void serialize(Archive& archive, Body& body) {
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    archive.number("rigid_motion_" + std::to_string(b), body.blocks[b].in_rigid_motion);
    MaterialBlock& block = body.blocks[b];
    archive.points("block " + std::to_string(b) + " (" + block.name + ")", ids_of(body, block.points));
    block.fields.serialize(archive, indices_of(block));
  }
  archive.points("all points", owned_ids(body));
  compare_reference(archive, body);
  archive.field("position", 3, [&](std::size_t i, int c) -> double& { return body.domain.sites[i].current[c]; });
  body.fields.serialize(archive);
  Vector stretch = body.domain.halo.stretch();
  for (const Period& period : body.domain.periods) {
    archive.number(std::string("stretch_") + "xyz"[period.axis], stretch[period.axis]);
  }
  if (!archive.loading()) return;
  body.domain.halo.set_stretch(stretch);  // before ghosts get their places
  body.domain.halo.exchange_positions(body.domain.sites);
  refit_flowed(body);
}

// By their names, which conditions use; the order of the sets is free.
double mark_of_sets(const Body& body, const std::set<std::string>& without) {
  const std::vector<std::string>& all = body.domain.cloud.set_names;
  std::vector<std::uint64_t> names = words_of(all);
  for (std::size_t k = 0; k < all.size(); ++k) names[k] = without.contains(all[k]) ? 0 : names[k];
  return mark_of(body, [&](int i) {
    std::uint64_t sum = 0;
    for (std::size_t k = 0; k < names.size(); ++k) sum += (body.domain.cloud.sets[i] >> k & 1) * names[k];
    return sum;
  });
}

void serialize_sets(Archive& archive, const Body& body, const std::set<std::string>& without) {
  Mark mark = {mark_of_sets_name, mark_of_sets(body, without), "in other node sets"};
  archive.number(mark.name, mark.kept);
  expect_same_mesh(body, mark.differs() ? std::vector<std::string>{mark.text} : std::vector<std::string>());
}

}  // namespace strut

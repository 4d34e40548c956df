#include "mechanics/fracture/fragments.hpp"

#include <algorithm>
#include <map>
#include <span>

#include "base/union_find.hpp"

namespace strut {

namespace {

UnionFind joined_on_this_rank(const Body& body) {
  UnionFind sets(body.domain.sites.size());
  for (int i = 0; i < body.owned(); ++i) {
    body.domain.families.for_each(i, [&](int j) { sets.join(i, j); });
  }
  return sets;
}

struct Sums {
  std::int64_t id = 0, points = 0;
  double mass = 0, momentum[3] = {0, 0, 0};
};

std::vector<Sums> sums_of_this_rank(const Body& body) {
  const std::vector<std::int64_t> ids = fragment_ids(body);
  std::map<std::int64_t, Sums> pieces;
  for (int i = 0; i < body.owned(); ++i) {
    Sums& piece = pieces[ids[i]];
    piece.id = ids[i], piece.points += 1, piece.mass += body.mass(i);
    for (int c = 0; c < 3; ++c) {
      piece.momentum[c] += 0.5 * body.mass(i) * (body.previous_velocity[i][c] + body.velocity[i][c]);
    }
  }
  std::vector<Sums> all;
  for (const auto& [id, piece] : pieces) all.push_back(piece);
  return all;
}

}  // namespace

// Each rank joins what it sees, and takes the least id that its ghosts have heard of, until nothing changes.
std::vector<std::int64_t> fragment_ids(const Body& body) {
  const Domain& domain = body.domain;
  const int count = static_cast<int>(domain.sites.size());
  UnionFind sets = joined_on_this_rank(body);
  std::vector<double> of_point(count), least(count, 0);  // least: of a set, by its first point
  for (int i = 0; i < count; ++i) of_point[i] = static_cast<double>(domain.id(i));
  for (bool changed = true; changed;) {
    for (int i = 0; i < count; ++i) least[sets.first(i)] = of_point[sets.first(i)];
    for (int i = 0; i < count; ++i) least[sets.first(i)] = std::min(least[sets.first(i)], of_point[i]);
    double any = 0;
    for (int i = 0; i < count; ++i) {
      any = std::max(any, of_point[i] != least[sets.first(i)] ? 1.0 : 0.0);
      of_point[i] = least[sets.first(i)];
    }
    changed = domain.communicator.max(any) > 0;
    domain.halo.exchange(of_point.data(), 1, 1);
  }
  std::vector<std::int64_t> ids;
  for (int i = 0; i < domain.owned; ++i) ids.push_back(static_cast<std::int64_t>(of_point[i]));
  return ids;
}

std::vector<Fragment> fragments(const Body& body) {
  const std::vector<Sums> mine = sums_of_this_rank(body);
  std::map<std::int64_t, Fragment> pieces;
  for (const Sums& sums : body.domain.communicator.gather(std::span(mine))) {
    Fragment& piece = pieces[sums.id];
    piece.id = sums.id, piece.points += sums.points, piece.mass += sums.mass;
    piece.velocity += Vector(sums.momentum[0], sums.momentum[1], sums.momentum[2]);
  }
  std::vector<Fragment> all;
  for (auto& [id, piece] : pieces) {
    piece.velocity /= piece.mass;
    all.push_back(piece);
  }
  std::stable_sort(all.begin(), all.end(), [](const Fragment& a, const Fragment& b) { return a.mass > b.mass; });
  return all;
}

}  // namespace strut

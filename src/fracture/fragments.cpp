#include "fracture/fragments.hpp"

#include <algorithm>
#include <map>
#include <span>

#include "base/parallel/gather_scatter.hpp"
#include "topology/pieces.hpp"

namespace strut {

namespace {

struct Sums {
  std::int64_t id = 0, points = 0;
  double mass = 0, momentum[3] = {0, 0, 0};
};

std::vector<Sums> sums_of_this_rank(const Body& body) {
  const std::vector<std::int64_t> ids = piece_ids(body.domain);
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

std::vector<Fragment> fragments(const Body& body) {
  const std::vector<Sums> mine = sums_of_this_rank(body);
  std::map<std::int64_t, Fragment> pieces;
  for (const Sums& sums : gather(body.domain.communicator, std::span(mine))) {
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

#include "fracture/fragments.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <span>
#include <utility>

#include "base/parallel/gather_scatter.hpp"
#include "topology/pieces.hpp"

namespace strut {

std::vector<Fragment> fragments(const Body& body) {
  std::map<std::int64_t, Fragment> pieces;  // with their momenta in place of velocities
  const auto add = [&pieces](std::int64_t id, std::int64_t points, double mass) -> std::array<double, 3>& {
    Fragment& piece = pieces[id];
    piece.id = id, piece.points += points, piece.mass += mass;
    return piece.velocity;
  };
  const auto take_all = [&pieces] {
    std::vector<Fragment> all;
    for (const auto& [id, piece] : std::exchange(pieces, {})) all.push_back(piece);
    return all;
  };
  const std::vector<std::int64_t> ids = piece_ids(body.domain);
  for (int i = 0; i < body.owned(); ++i) {
    std::array<double, 3>& momentum = add(ids[i], 1, body.mass(i));
    for (int c = 0; c < 3; ++c) {
      momentum[c] += 0.5 * body.mass(i) * (body.previous_velocity[i][c] + body.velocity[i][c]);
    }
  }
  const std::vector<Fragment> mine = take_all();
  for (const Fragment& one : gather(body.domain.communicator, std::span(mine))) {
    std::array<double, 3>& momentum = add(one.id, one.points, one.mass);
    for (int c = 0; c < 3; ++c) momentum[c] += one.velocity[c];
  }
  std::vector<Fragment> all = take_all();
  for (Fragment& piece : all) {
    for (double& v : piece.velocity) v /= piece.mass;
  }
  std::ranges::stable_sort(all, std::greater(), &Fragment::mass);
  return all;
}

}  // namespace strut

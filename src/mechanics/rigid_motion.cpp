#include "mechanics/rigid_motion.hpp"

#include <algorithm>
#include <limits>

#include "mechanics/passes.hpp"

namespace strut {

namespace {

// The largest v and −v of each component of the velocities of a body's points, and of their images by symmetry planes.
using Extremes = Eigen::Array<double, 6, 1>;
constexpr double infinity = std::numeric_limits<double>::infinity();

bool are_one(const Extremes& most) { return (most.head<3>() == -most.tail<3>()).all(); }

// The extremes over a block's points on this rank; infinite if the velocity of a point differs from that of the others,
// or is about to.
Extremes extremes(const Body& body, const MaterialBlock& block, int number, const std::vector<std::uint8_t>& met) {
  Extremes most = Extremes::Constant(-infinity);
  if (block.points.empty()) return most;
  const Vector& v = body.velocity[block.points.front()];
  const bool move_otherwise =
      std::ranges::any_of(block.points, [&](int i) { return body.velocity[i] != v || (!met.empty() && met[i] != 0); });
  const auto is_constant = [](const Period& period) { return period.stretch.is_constant(); };
  if (move_otherwise || !std::ranges::all_of(body.domain.periods, is_constant)) return Extremes::Constant(infinity);
  const auto add = [&](const Vector& one) { most = most.max((Extremes() << one, -one).finished()); };
  add(v);
  for (const Mirror& mirror : body.domain.mirrors) {
    if (mirror.body == number) add(Reflection::by(mirror).turn * v);
  }
  return most;
}

// The first block of the body to which block b belongs.
std::size_t first_of(const Body& body, std::size_t b) {
  const std::vector<BlockHorizons>& blocks = body.domain.blocks;
  return std::ranges::find(blocks, blocks[b].body, &BlockHorizons::body) - blocks.begin();
}

bool is_in_place(const Body& body, const MaterialBlock& block) {
  if (body.domain.halo.stretch() != Vector::Ones()) return false;
  return std::all_of(block.points.begin(), block.points.end(), [&](int i) {
    return (body.domain.sites[i].current.head<3>() == body.domain.sites[i].reference.head<3>()).all();
  });
}

// Metal that was put back where it came from has residual stress. An ordinary solid, without memory, has none.
bool has_stress(const Body& body, const MaterialBlock& block) {
  if (block.is_ordinary()) return false;
  for (std::size_t k = 0; k < block.points.size(); ++k) {
    for (int q = 0; q < block.points_per_cell(); ++q) {
      if (body.integration_point(block, k, q).stress != Symmetric::Zero()) return true;
    }
  }
  return false;
}

}  // namespace

bool all_move_rigidly(const Body& body) {
  return std::all_of(body.blocks.begin(), body.blocks.end(), [](const MaterialBlock& b) { return b.in_rigid_motion; });
}

void find_rigid_motion(Body& body) {
  std::vector<double> moved(body.blocks.size(), 0);  // at the first block of each body
  for (std::size_t b = 0; b < moved.size(); ++b) {
    const MaterialBlock& block = body.blocks[b];
    // A library is called from the start: its time is that of the run.
    const bool is_called = std::holds_alternative<materials::UserLaw>(block.material.law);
    if (is_called || !is_in_place(body, block) || expands(body, b) || has_stress(body, block))
      moved[first_of(body, b)] = 1;
  }
  body.domain.communicator.max(moved);
  for (std::size_t b = 0; b < moved.size(); ++b) body.blocks[b].in_rigid_motion = moved[first_of(body, b)] == 0;
}

void update_rigid_motion(Body& body, const std::vector<std::uint8_t>& met) {
  std::vector<MaterialBlock>& blocks = body.blocks;
  if (std::ranges::none_of(blocks, &MaterialBlock::in_rigid_motion)) return;
  const bool all_did = all_move_rigidly(body);
  std::vector<double> most(6 * blocks.size(), -infinity);  // at the first block of each body
  const auto of_body = [&](std::size_t b) { return Eigen::Map<Extremes>(&most[6 * first_of(body, b)]); };
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (blocks[b].in_rigid_motion)
      of_body(b) = of_body(b).max(extremes(body, blocks[b], body.domain.blocks[b].body, met));
  }
  body.domain.communicator.max(most);
  for (std::size_t b = 0; b < blocks.size(); ++b) blocks[b].in_rigid_motion &= are_one(of_body(b));
  // While all bodies were in rigid motion, ranks did not exchange positions; bonds that break need those at the start
  // of the step.
  if (all_did && !all_move_rigidly(body)) body.domain.halo.exchange_positions(body.domain.sites);
}

}  // namespace strut

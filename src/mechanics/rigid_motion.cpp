#include "mechanics/rigid_motion.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "mechanics/passes.hpp"

namespace strut {

namespace {

// The range of the points' velocities along the axes: the largest v and −v of each component.
class VelocityRange {
 public:
  void add(const Vector& v) {
    for (int c = 0; c < 3; ++c) {
      most[2 * c] = std::max(most[2 * c], v[c]);
      most[2 * c + 1] = std::max(most[2 * c + 1], -v[c]);
    }
  }
  void spoil() { most.fill(std::numeric_limits<double>::infinity()); }
  bool is_one() const { return most[0] == -most[1] && most[2] == -most[3] && most[4] == -most[5]; }

  std::array<double, 6> most = [] {
    std::array<double, 6> none;
    none.fill(-std::numeric_limits<double>::infinity());
    return none;
  }();
};

// Adds the velocities of a block's points and of their images by symmetry planes; stops at the first that differs from
// the others.
void add(const Body& body, const MaterialBlock& block, int number, VelocityRange& range) {
  for (const int i : block.points) {
    const Vector& v = body.velocity[i];
    if (v != body.velocity[block.points.front()]) return range.spoil();
  }
  if (block.points.empty()) return;
  const Vector& v = body.velocity[block.points.front()];
  range.add(v);
  for (const Period& period : body.domain.periods) {
    if (!period.stretch.is_constant()) range.spoil();  // images move otherwise
  }
  for (const Mirror& mirror : body.domain.mirrors) {
    if (mirror.body == number) range.add(Reflection::by(mirror).turn * v);
  }
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
  const std::vector<BlockHorizons>& blocks = body.domain.blocks;
  std::vector<double> moved(blocks.size(), 0);  // at the first block of each body
  const auto first_of = [&](std::size_t b) {
    std::size_t first = 0;
    while (blocks[first].body != blocks[b].body) ++first;
    return first;
  };
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const MaterialBlock& block = body.blocks[b];
    // A library is called from the start: its time is that of the run.
    const bool is_called = std::holds_alternative<materials::UserLaw>(block.material.law);
    if (is_called || !is_in_place(body, block) || expands(body, b) || has_stress(body, block)) moved[first_of(b)] = 1;
  }
  body.domain.communicator.max(moved);
  for (std::size_t b = 0; b < blocks.size(); ++b) body.blocks[b].in_rigid_motion = moved[first_of(b)] == 0;
}

void update_rigid_motion(Body& body) {
  std::vector<int> bodies;  // in rigid motion
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    if (body.blocks[b].in_rigid_motion) bodies.push_back(body.domain.blocks[b].body);
  }
  if (bodies.empty()) return;
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  std::vector<double> most;
  for (const int one : bodies) {
    VelocityRange range;
    for (std::size_t b = 0; b < body.blocks.size(); ++b) {
      if (body.domain.blocks[b].body == one) add(body, body.blocks[b], one, range);
    }
    most.insert(most.end(), range.most.begin(), range.most.end());
  }
  body.domain.communicator.max(most);
  const bool all_did = all_move_rigidly(body);
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    VelocityRange range;
    std::copy_n(most.begin() + 6 * n, 6, range.most.begin());
    if (range.is_one()) continue;
    for (std::size_t b = 0; b < body.blocks.size(); ++b) {
      if (body.domain.blocks[b].body == bodies[n]) body.blocks[b].in_rigid_motion = false;
    }
  }
  // While all bodies were in rigid motion, ranks did not exchange positions; bonds that break need those at the start
  // of the step.
  if (all_did && !all_move_rigidly(body)) body.domain.halo.exchange_places(body.domain.sites);
}

}  // namespace strut

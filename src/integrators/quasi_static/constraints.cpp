#include "integrators/quasi_static/constraints.hpp"

namespace strut {

namespace {

// Least length of the part of a held direction that is orthogonal to the other held directions of its point. Below it
// the direction depends on them and adds nothing.
constexpr double smallest_part = 1e-8;

}  // namespace

Constraints::Constraints(const std::vector<HeldDirection>& held, const Body& body)
    : free_projection_(body.owned(), Tensor::Identity()), places_(body.owned(), Vector::Zero()) {
  for (const HeldDirection& one : held) hold(one);
}

// Adds y·d = target in the directions still free: y·(F d) = target − (d − F d)·y; the rest of d is held already.
void Constraints::hold(const HeldDirection& held) {
  Tensor& free_projection = free_projection_[held.point];
  const Vector free = free_projection * held.direction;
  const double length = free.norm();
  if (length < smallest_part) return;
  const Vector along = free / length;
  const double left = held.target - held.direction.dot(places_[held.point]);
  places_[held.point] += left / length * along;
  free_projection -= along * along.transpose();
  directions_.push_back({held.reaction_index, held.point, along});
}

void Constraints::remove(Field& field) const {
  for (std::size_t i = 0; i < field.size(); ++i) field[i] = free_projection_[i] * field[i];
}

void Constraints::keep_constrained(Field& field) const {
  for (std::size_t i = 0; i < field.size(); ++i) field[i] -= free_projection_[i] * field[i];
}

void Constraints::add_reactions(const Field& forces, std::vector<Vector>& by_condition) const {
  for (const auto& [reaction_index, point, along] : directions_) {
    if (static_cast<std::size_t>(reaction_index) >= by_condition.size()) continue;  // no_reaction, too
    by_condition[reaction_index] -= along.dot(forces[point]) * along;
  }
}

Field Constraints::remaining_displacement(const Body& body) const {
  Field left(body.owned());
  for (int i = 0; i < body.owned(); ++i) left[i] = places_[i] - body.current(i);
  keep_constrained(left);
  return left;
}

bool is_a_motion(const Field& displacements, const Body& body) {
  double farthest = 0;  // in spacings
  for (std::size_t i = 0; i < displacements.size(); ++i) {
    farthest = std::max(farthest, displacements[i].norm() / body.domain.cloud.spacings[i]);
  }
  return body.domain.communicator.max(farthest) > 1e-9;
}

}  // namespace strut

#include "solvers/quasi_static/constraints.hpp"

namespace strut {

namespace {

// Of the length of a direction: what others at its point hold already leaves no more than this of it.
constexpr double smallest_part = 1e-8;

// Where the motion takes its component of the place of point i, m.
double place_of(const PrescribedMotion& motion, const Body& body, int i, double t, double dt) {
  const Vector X = body.domain.reference(i);
  const auto value = [&](double time) { return motion.value(X[0], X[1], X[2], time); };
  if (motion.is_velocity) return body.current(i)[motion.component] + dt * value(t + 0.5 * dt);
  return X[motion.component] + value(t + dt);
}

}  // namespace

Constraints::Constraints(const Conditions& conditions, const Body& body, double t, double dt)
    : free_projection_(body.owned(), Tensor::Identity()), places_(body.owned(), Vector::Zero()) {
  for (const PrescribedMotion& motion : conditions.motions) {
    const Vector along = Vector::Unit(motion.component);
    for (const int i : motion.points) hold(motion.condition, i, along, place_of(motion, body, i, t, dt));
  }
  for (const SymmetryPlane& plane : conditions.symmetry_planes) {
    for (const int i : plane.points) hold(plane.condition, i, plane.normal, plane.normal.dot(body.current(i)));
  }
}

// With y·d = place, in the directions that are still free: y·(F d) = place − (d − F d)·y, and the rest of d is held.
void Constraints::hold(int condition, int point, const Vector& direction, double place) {
  Tensor& free_projection = free_projection_[point];
  const Vector free = free_projection * direction;
  const double length = free.norm();
  if (length < smallest_part) return;
  const Vector along = free / length;
  const double left = place - direction.dot(places_[point]);
  places_[point] += left / length * along;
  free_projection -= along * along.transpose();
  directions_.push_back({condition, point, along});
}

void Constraints::remove(Field& field) const {
  for (std::size_t i = 0; i < field.size(); ++i) field[i] = free_projection_[i] * field[i];
}

void Constraints::keep(Field& field) const {
  for (std::size_t i = 0; i < field.size(); ++i) field[i] -= free_projection_[i] * field[i];
}

void Constraints::add_reactions(const Field& forces, std::vector<Vector>& by_condition) const {
  for (const auto& [condition, point, along] : directions_) {
    if (static_cast<std::size_t>(condition) >= by_condition.size()) continue;  // −1, too
    by_condition[condition] -= along.dot(forces[point]) * along;
  }
}

Field Constraints::way_left(const Body& body) const {
  Field left(body.owned());
  for (int i = 0; i < body.owned(); ++i) left[i] = places_[i] - body.current(i);
  keep(left);
  return left;
}

}  // namespace strut

// How far the forces of a trial are from balance, for each separate part.
#include <algorithm>
#include <cmath>
#include <utility>

#include "integrators/quasi_static/equilibrium.hpp"
#include "mechanics/mirror_forces.hpp"

namespace strut {

namespace {

// Reactions below this fraction of the largest so far are no scale for the imbalance: the rest of an unloaded body is
// round-off of its loading.
constexpr double smallest_scale = 1e-4;

}  // namespace

// The forces of the body's bonds through the sides, of all pieces and of each.
void Equilibrium::take_side_forces() {
  const std::vector<Period>& periods = body_.domain.periods;
  if (periods.empty()) {
    mirror_forces_ = mirror_forces(body_);
    return;
  }
  mirror_forces_.assign(periods.size(), Vector::Zero());
  side_forces_.assign(parts_.pieces() * periods.size(), 0);
  for_each_period_force(body_, 0, nullptr, [&](int i, std::size_t m, double force) {
    mirror_forces_[m][periods[m].axis] += force;
    side_forces_[parts_.piece_of(i) * periods.size() + m] += force;
  });
}

void Equilibrium::add_contact_through_sides() {
  const std::vector<Period>& periods = body_.domain.periods;
  const std::vector<Vector> without = mirror_forces_;
  contact_.add_mirror_reactions(body_.domain, mirror_forces_);
  for (std::size_t m = 0; m < periods.size(); ++m) {
    side_forces_[parts_.contact_through_sides() * periods.size() + m] += (mirror_forces_[m] - without[m]).sum();
  }
}

// Upper bound by Σ f·u ≤ ‖f‖ ‖u‖. A free body that expands has no forces but those that the search has left.
double Equilibrium::work_of_errors() const {
  const std::vector<double> norms = parts_.of_parts(parts_.norms(step_displacement(), body_.domain.communicator));
  const std::vector<double> round_off = parts_.of_parts(round_off_), expansion = parts_.of_parts(expansion_scale_);
  double sum = 0;
  for (std::size_t p = 0; p < norms.size(); ++p) {
    sum += (round_off[p] + tolerance_.relative * expansion[p]) * norms[p];
  }
  return sum;
}

// The reactions balance the forces in held directions.
Imbalance Equilibrium::measure(bool failed) {
  Field of_tools(body_.owned(), Vector::Zero());
  tools_.add_forces(body_, of_tools);
  const std::size_t pieces = parts_.pieces();
  std::vector<double> sums(2 * pieces, 0);  // of residuals and scales of the pieces; of side forces, then of failures
  sums.insert(sums.end(), side_forces_.begin(), side_forces_.end());
  sums.push_back(failed ? 1 : 0);
  for (int i = 0; i < body_.owned(); ++i) {
    forces_[i] += of_tools[i];
    residual_[i] = constraints_->free_projection(i) * forces_[i];
    outer_[i] -= forces_[i] - residual_[i];
    sums[parts_.piece_of(i)] += residual_[i].squaredNorm();
    sums[pieces + parts_.piece_of(i)] += (outer_[i] + of_tools[i]).squaredNorm();
  }
  body_.domain.communicator.sum(sums);
  if (std::exchange(begins_, false)) {
    for (std::size_t p = 0; p < pieces; ++p) first_residual_[p] = std::sqrt(sums[p]);
  }
  return worst_of(imbalances(sums, sums.back() > 0));
}

// Returns the imbalance of each part at the index of its first piece. `sums`: per piece, over all ranks, as in
// measure().
std::vector<Imbalance> Equilibrium::imbalances(const std::vector<double>& sums, bool failed) {
  const std::size_t pieces = parts_.pieces(), periods = body_.domain.periods.size();
  struct Part {
    double norm2 = 0, scale2 = 0, largest = 0, points = 0;
    std::vector<double> through_sides;
  };
  std::vector<Part> parts(pieces, {.through_sides = std::vector<double>(periods, 0)});
  for (std::size_t p = 0; p < pieces; ++p) {
    Part& part = parts[parts_.part_of_piece(static_cast<int>(p))];
    part.norm2 += sums[p], part.scale2 += sums[pieces + p] + expansion_scale_[p] * expansion_scale_[p];
    part.largest = std::max(part.largest, largest_scale_[p]), part.points += parts_.points(static_cast<int>(p));
    for (std::size_t m = 0; m < periods; ++m) part.through_sides[m] += sums[2 * pieces + p * periods + m];
  }
  const std::vector<double> round_off = parts_.of_parts(round_off_), first = parts_.of_parts(first_residual_);
  std::vector<Imbalance> all(pieces);
  for (std::size_t p = 0; p < pieces; ++p) {
    const Part& part = parts[p];
    if (part.points == 0) continue;
    double of_sides = 0;
    for (const double force : part.through_sides) of_sides += force * force / part.points;
    double scale = std::sqrt(part.scale2 + of_sides);
    if (scale == 0) scale = first[p];
    all[p] = {std::sqrt(part.norm2), std::max(scale, smallest_scale * part.largest), round_off[p], failed};
    if (!std::isfinite(all[p].norm + scale)) all[p].failed = true;
    last_scale_[p] = scale;
  }
  for (std::size_t p = 0; p < pieces; ++p) last_scale_[p] = last_scale_[parts_.part_of_piece(static_cast<int>(p))];
  return all;
}

// Parts that are balanced wait for the others, without forces: their round-off may be more than the forces of those.
Imbalance Equilibrium::worst_of(const std::vector<Imbalance>& of_parts) {
  const auto rating = [&](const Imbalance& one) {
    if (one.failed) return HUGE_VAL;
    const double allowed = std::max(tolerance_.relative * one.scale, one.round_off);
    return one.norm > 0 ? std::min(one.norm / allowed, std::numeric_limits<double>::max()) : 0;
  };
  const auto by_rating = [&](const Imbalance& a, const Imbalance& b) { return rating(a) < rating(b); };
  const Imbalance worst = *std::ranges::max_element(of_parts, by_rating);
  if (!parts_.several() || worst.failed || is_balanced(worst, tolerance_)) return worst;
  double squares[3] = {};
  for (const Imbalance& one : of_parts) {
    if (is_balanced(one, tolerance_)) continue;
    squares[0] += one.norm * one.norm, squares[1] += one.scale * one.scale, squares[2] += one.round_off * one.round_off;
  }
  for (int i = 0; i < body_.owned(); ++i) {
    if (is_balanced(of_parts[parts_.of(i)], tolerance_)) residual_[i].setZero();
  }
  return {std::sqrt(squares[0]), std::sqrt(squares[1]), std::sqrt(squares[2])};
}

}  // namespace strut

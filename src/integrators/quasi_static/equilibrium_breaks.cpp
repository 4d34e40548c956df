// Bonds and cells that give way between two equilibria.
#include <algorithm>
#include <cmath>
#include <utility>

#include "integrators/quasi_static/equilibrium.hpp"
#include "mechanics/formulation/quadratic_fits.hpp"
#include "mechanics/hindered_breaks.hpp"

namespace strut {

namespace {

// Part of the largest excess over the strength that a round of softening leaves: cells soften one after another, else a
// body under uniform tension would soften everywhere. Cells with less of their strength left have no part in it.
constexpr double part_in_round = 0.5, nearly_open = 0.1;

}  // namespace

// The deck's check (deck/sections/combinations.cpp) refuses the others, unless explicit steps follow, in which they
// break.
bool Equilibrium::may_break() const {
  return fracture_ && hindrance_of_breaks(body_).empty() && !tools_.any() && !contact_.any();
}

// Damage that is held makes the search for an equilibrium an elastic one, and damage that grows between two of them
// dissipates what the body then no longer stores, however far a crack runs (docs/theory.md).
GaveWay Equilibrium::give_way() {
  if (!breaks_) return {};
  const std::int64_t before = broken_bonds(body_);
  const double spent = stored_energies(body_).fracture;
  fracture_->start_rest(body_);
  const Field inner = inner_, with_loads = body_.force_density;
  set_strengths(1 + part_in_round * (largest_load() - 1));
  advance(dt_, t_ + dt_, true);
  set_strengths(HUGE_VAL);
  const GaveWay gave{body_.domain.communicator.sum(broken_bonds(body_) - before) / 2,
                     stored_energies(body_).fracture > spent};
  if (!gave.any()) {
    committed_.restore_materials(body_);  // to the last bit, whether a checkpoint is written here or not
    put_back(with_loads, body_);
    return gave;
  }
  if (body_.domain.communicator.any(begin_flow(body_))) advance(0, t_ + dt_, true);
  left_.resize(body_.owned());
  for (int i = 0; i < body_.owned(); ++i) left_[i] = inner[i] - body_.domain.volume(i) * body_.force_density[i];
  committed_.take(body_);
  constraints_.emplace(held_directions(conditions_, body_, t_ + dt_, 0), body_);
  return gave;
}

void Equilibrium::set_strengths(double factor) {
  for (std::size_t b = 0; b < strengths_.size(); ++b) {
    if (auto* law = std::get_if<materials::Brittle>(&body_.blocks[b].material.law))
      law->strength = factor * strengths_[b];
  }
}

double Equilibrium::largest_load() const {
  double largest = 1;
  for (std::size_t b = 0; breaks_ && b < strengths_.size(); ++b) {
    const MaterialBlock& block = body_.blocks[b];
    const auto* law = std::get_if<materials::Brittle>(&block.material.law);
    for (std::size_t n = 0; law && n < 4 * block.points.size(); ++n) {
      const std::size_t index = block.index(static_cast<int>(n / 4), static_cast<int>(n % 4));
      const double left = 1 - block.state_of<materials::Brittle>(index).dissipated * law->width / law->fracture_energy;
      if (left < nearly_open) continue;
      const double most = materials::CockcroftLatham::largest_principal(block.cells->stress_at(index));
      largest = std::max(largest, most / (strengths_[b] * left));
    }
  }
  return body_.domain.communicator.max(largest);
}

std::optional<Fracture> Equilibrium::take_fracture() {
  if (fracture_) set_strengths(1);
  return std::move(fracture_);
}

double Equilibrium::work_of_jump() const {
  double sum = 0;
  for (int i = 0; i < body_.owned(); ++i) sum -= 0.5 * left_[i].dot(body_.current(i) - committed_.position(i));
  return sum;
}

}  // namespace strut

#include "integrators/ledger.hpp"

#include <algorithm>
#include <cmath>

namespace strut {

void Ledger::take(const Energies& stored) {
  elastic = stored.elastic, dissipated = stored.dissipated, stabilization = stored.stabilization;
  fracture = stored.fracture, heat = stored.heat, expansion = stored.expansion;
}

void Ledger::balance(double held, double put_in, double& largest_so_far) {
  largest_so_far = std::max({largest_so_far, held, std::abs(put_in)});
  gained = held - put_in, largest = largest_so_far;
  balance_error = largest > 0 ? std::abs(gained) / largest : 0;
}

double energy_of_round_off(const Body& body) {
  constexpr double strain = 1e-12, of_quadratic = 1e-11;  // its canceling terms are larger
  double sum = 0;
  for (const MaterialBlock& block : body.blocks) {
    const double modulus = materials::moduli_of(block.material.law).longitudinal();
    const double squared = std::pow(block.is_quadratic() ? of_quadratic : strain, 2);
    for (const int i : block.points) sum += squared * modulus * body.domain.volume(i);
  }
  return 0.5 * body.domain.communicator.sum(sum);
}

namespace {

// The displacement of the upper side of a period relative to the lower one, from t over dt (s), m.
Vector relative_displacement(const Domain& domain, const Period& period, double t, double dt) {
  const Vector more = stretch_at(domain.periods, t + dt) - stretch_at(domain.periods, t);
  return period.length * more[period.axis] * Vector::Unit(period.axis);
}

}  // namespace

void add_period_work(const Domain& domain, const std::vector<Vector>& forces, const TimeOfImpulse& at,
                     ImpulseWork& work) {
  for (std::size_t p = 0; p < domain.periods.size(); ++p) {
    const Period& period = domain.periods[p];
    if (period.stretch.is_constant()) continue;
    const Vector half = 0.5 * at.impulse * forces[p];
    const double after = half.dot(relative_displacement(domain, period, at.t, at.after)) / at.after;
    const double before = at.before > 0
                              ? half.dot(relative_displacement(domain, period, at.t - at.before, at.before)) / at.before
                              : after;
    work.before.external += before, work.after.external += after;
  }
}

double period_work(const Domain& domain, const std::vector<Vector>& before, const std::vector<Vector>& after, double t,
                   double dt) {
  double work = 0;
  for (std::size_t p = 0; p < domain.periods.size(); ++p) {
    const Vector displacement = relative_displacement(domain, domain.periods[p], t, dt);
    work += 0.5 * (before[p] + after[p]).dot(displacement);
  }
  return work;
}

}  // namespace strut

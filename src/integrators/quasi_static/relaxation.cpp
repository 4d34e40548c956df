#include "integrators/quasi_static/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace strut {

namespace {

constexpr int ramp = 40;      // iterations over which held points are moved
constexpr int renewal = 200;  // iterations after which the masses are adapted to the deformation

// Unit step over stable step, which shrinks until the masses are renewed.
constexpr double safety = 0.8;

constexpr double most_damping = 1.9;  // 2 would stop a point within a step

double dot(const Field& a, const Field& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

}  // namespace

// m = ω²_max/(2 safety)² times the factor that equalizes all frequency bounds: for the body by its elastic tangent, for
// contact by its springs; two points of equal mass in contact have twice the stiffness of one.
void Relaxation::renew_masses() {
  Body& body = equilibrium_.body();
  const std::vector<double> density = body.density;
  for (const MaterialBlock& block : body.blocks) {
    for (std::size_t k = 0; k < block.points.size(); ++k) {
      const double omega = frequency_bound(body, block, static_cast<int>(k));
      body.density[block.points[k]] *= omega * omega;  // 1/s², so that frequency bounds are 1
    }
  }
  // Points without stiffness get a mass, too.
  const double heaviest = body.domain.communicator.max(std::accumulate(
      body.density.begin(), body.density.end(), 0.0, [](double a, double b) { return std::max(a, b); }));
  for (double& d : body.density) d = std::max(d, 1e-6 * heaviest);
  const double limit = critical_time_step_.estimate(body);
  const std::vector<Tensor> springs = equilibrium_.contact_springs();
  masses_.resize(body.owned());
  for (int i = 0; i < body.owned(); ++i) {
    const double stiffness = 4 / (limit * limit) * body.mass(i) + 2 * springs[i].trace();
    masses_[i] = stiffness / (4 * safety * safety);
  }
  body.density = density;
}

EquilibriumSearch Relaxation::solve(const Tolerance& tolerance, int most) {
  Body& body = equilibrium_.body();
  const Communicator& ranks = body.domain.communicator;
  const Constraints& held = equilibrium_.constraints();
  EquilibriumSearch search;
  search.left = equilibrium_.evaluate();
  search.converged = is_balanced(search.left, tolerance) && !is_a_motion(held.remaining_displacement(body), body);
  if (search.converged) return search;
  Field velocity(body.owned(), Vector::Zero()), before;
  double damping = 0;
  for (int n = 0; n < most && !search.left.failed; ++n) {
    if (n % renewal == 0) {
      renew_masses();
      search.interrupted = ranks.any(observer_.stop_requested());
      if (search.interrupted) return search;
    }
    const Field remaining = n < ramp ? held.remaining_displacement(body) : Field(body.owned(), Vector::Zero());
    for (int i = 0; i < body.owned(); ++i) {
      const Vector push = equilibrium_.residual()[i] / masses_[i];
      velocity[i] = ((2 - damping) * velocity[i] + 2 * push) / (2 + damping);
      const Vector move = velocity[i] + remaining[i] / std::max(1, ramp - n);
      body.domain.sites[i].current.head<3>() += move.array();
    }
    before = equilibrium_.residual();
    search.left = equilibrium_.evaluate();
    ++search.iterations, ++search.evaluations;
    if (n >= ramp && is_balanced(search.left, tolerance)) {
      search.converged = true;
      break;
    }
    // Damping: twice the frequency of the present motion, by its Rayleigh quotient with the stiffness along the motion.
    double sums[] = {dot(velocity, before) - dot(velocity, equilibrium_.residual()), 0};
    for (int i = 0; i < body.owned(); ++i) sums[1] += masses_[i] * velocity[i].squaredNorm();
    ranks.sum(sums);
    damping = sums[1] > 0 ? std::min(most_damping, 2 * std::sqrt(std::max(0.0, sums[0] / sums[1]))) : 0;
  }
  return search;
}

}  // namespace strut

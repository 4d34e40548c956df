#include "integrators/quasi_static/newton.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/timing.hpp"
#include "integrators/quasi_static/tangent_factor.hpp"

namespace strut {

namespace {

// Relative accuracies of the linear systems. Near the solution, Newton's own convergence limits the useful accuracy:
// the residual after a step is of the order of its square (Eisenstat & Walker 1996, choice 2).
constexpr double of_first = 1e-3, coarsest = 3e-2, finest = 1e-4;

// Relative accuracy when a point begins to touch a tool: the residual is then mostly that of a stiff spring, and the
// force on the body a small part of it.
constexpr double of_touch = 1e-2;
constexpr int most_products = 400;

// Damping (over the stiffness of a point) begins at first_damping and ends below least_damping. It is multiplied by
// where_unstable if the tangent is not positive along the step, by where_short if the line search takes only a short
// part of the step, and by where_quick or where_slow as the forces decrease quickly or slowly.
constexpr double first_damping = 1e-2, least_damping = 1e-5;
constexpr double where_unstable = 10, where_short = 4, where_quick = 0.1, where_slow = 0.4;
constexpr double short_part = 0.1, long_part = 0.5;  // of a step
constexpr int most_damped = 8;                       // iterations; beyond these relaxation takes over
constexpr int most_products_damped = 200;            // more would cost more than a better direction saves

// Number of multigrid products for one system after which thin bodies use factors for the rest of the run: the springs
// of multigrid do not represent a strut that flows or slides. Below it multigrid is faster (docs/decisions.md).
constexpr int most_of_multigrid = 200;

// A multigrid hierarchy is renewed once a system takes this many times the products of the first one after it was made;
// factors are renewed once a system takes this many times the products that new factors are worth.
constexpr double wear = 1.5;

// ---- Line search along a step, by the power of the residual forces --------------------------------------------------

constexpr double enough = 0.5;      // fraction of the power at the start, of either sign, that ends the search
constexpr int most_places = 12;     // evaluations at most; one costs a hundredth of the step
constexpr double margin = 0.02;     // fraction of the remaining interval: least distance from its ends
constexpr double of_failure = 1e3;  // if a point inverts, the power counts as minus this multiple of that at the start

// The interval of the step in which the power changes its sign.
struct Bracket {
  double low, high, power_low, power_high;

  // The zero of the secant; every third time the middle, because a kink keeps the secant on one side.
  double next(bool middle) const {
    const double secant = low + (high - low) * power_low / (power_low - power_high);
    const double wanted = middle ? 0.5 * (low + high) : secant;
    return std::clamp(wanted, low + margin * (high - low), high - margin * (high - low));
  }
  void cut(double at, double power) {
    if (power > 0) {
      low = at, power_low = power;
    } else {
      high = at, power_high = power;
    }
  }
};

// Collective. The power of the search: work of the present residual forces over the displacement `step`, J.
double power_along(const Equilibrium& equilibrium, const Body& body, const Field& step) {
  double sum = 0;
  for (std::size_t i = 0; i < step.size(); ++i) sum += step[i].dot(equilibrium.residual()[i]);
  return body.domain.communicator.sum(sum);
}

struct Stop {
  double fraction = 1;  // of the step
  Imbalance left;
};

// Collective. Call it at the end of the whole step, with the imbalance `left` there; `power`: at the start of the step,
// positive. Stays if the power less `drag` · fraction is not negative there; else moves back, in at most 12
// evaluations, to a fraction at which it is at most half of `power` in size. The norm of the forces is no measure
// beyond a kink, where a point begins to touch or to flow: stiff springs dominate it.
Stop search_downhill(Equilibrium& equilibrium, const Field& step, double power, double drag, const Imbalance& left) {
  Body& body = equilibrium.body();
  Stop stop{1, left};
  const auto power_now = [&] {
    return stop.left.failed ? -of_failure * power : power_along(equilibrium, body, step) - stop.fraction * drag;
  };
  double now = power_now();
  if (now >= 0) return stop;
  Bracket bracket{0, 1, power, now};
  for (int n = 0; n < most_places && std::abs(now) > enough * power; ++n) {
    const double to = bracket.next(n % 3 == 2 || stop.left.failed);
    move_by(body, to - stop.fraction, step);
    stop = {to, equilibrium.evaluate()};
    now = power_now();
    bracket.cut(to, now);
  }
  return stop;
}

}  // namespace

Newton::Newton(Equilibrium& equilibrium, const Observer& observer)
    : equilibrium_(equilibrium),
      observer_(observer),
      krylov_(equilibrium.body().domain.communicator.teuchos(), equilibrium.body().owned()) {}

// The mean stiffness of a point alone, N/m.
double Newton::mean_spring(const BlockRows& matrix) const {
  double sums[] = {0, static_cast<double>(matrix.start.size() - 1)};
  for (std::size_t i = 0; i + 1 < matrix.start.size(); ++i) sums[0] += matrix.blocks[matrix.start[i]].trace() / 3;
  equilibrium_.body().domain.communicator.sum(sums);
  return sums[0] / sums[1];
}

// Damping takes the stiffness of the body alone: with the stiffness of contact it would prevent sliding, too.
void Newton::renew_drag(const BlockRows& matrix, const std::vector<Tensor>& extra) {
  drag_.resize(extra.size());
  for (std::size_t i = 0; i < extra.size(); ++i) {
    const Tensor& free_projection = equilibrium_.constraints().free_projection(static_cast<int>(i));
    const Tensor own = free_projection * (matrix.blocks[matrix.start[i]] - extra[i]) * free_projection;
    drag_[i] = own.trace() / std::max(1.0, free_projection.trace());
  }
}

void Newton::damp_less(double factor) {
  damping_ *= factor;
  if (damping_ < least_damping) damping_ = 0;
}

void Newton::damp_more(double factor) { damping_ = std::max(first_damping, factor * damping_); }

void Newton::warn_once(const std::string& trouble) {
  if (trouble.empty() || has_warned_) return;
  has_warned_ = true;
  if (observer_.load_steps) observer_.load_steps("WARNING: " + trouble);
}

void Newton::precondition(const BlockRows& matrix, const std::vector<Tensor>& extra) {
  Body& body = equilibrium_.body();
  if (wants_factors_ && !factor_) factor_.emplace(body);
  is_factorized_ = wants_factors_ && factor_->is_worthwhile() &&
                   factor_->factorize(body, equilibrium_.tangents(), equilibrium_.constraints(), extra, matrix);
  if (is_factorized_) {
    return krylov_.precondition_by([this](const Field& right, Field& x) { factor_->solve(right, x); });
  }
  warn_once(krylov_.precondition(matrix, rigid_motions(body)));
}

void Newton::renew_preconditioner() {
  static Teuchos::Time& timer = phase("Preconditioner");
  const Timed timed(timer);
  Body& body = equilibrium_.body();
  std::vector<Tensor> extra = equilibrium_.contact_springs();
  if (damping_ > 0) {
    for (std::size_t i = 0; i < extra.size(); ++i) extra[i] += damping_ * drag_[i] * Tensor::Identity();
  }
  const BlockRows matrix =
      preconditioner_matrix(body, equilibrium_.tangents(), equilibrium_.constraints(), extra, krylov_.first());
  precondition(matrix, extra);
  spring_ = mean_spring(matrix);
  renew_drag(matrix, extra);
  damping_when_new_ = damping_;
  preconditioner_pending_ = false;
  products_when_new_ = 0;
}

// Solves once, and again with factors if multigrid took too long.
Krylov::Outcome Newton::with_another_preconditioner(const std::function<Krylov::Outcome()>& solve) {
  const Krylov::Outcome first = solve();
  if (wants_factors_ || first.iterations < most_of_multigrid) return first;
  wants_factors_ = true;
  renew_preconditioner();
  if (!is_factorized_) return first;
  const Krylov::Outcome second = solve();
  return {first.iterations + second.iterations, second.converged};
}

void Newton::serialize(Archive& archive) { archive.number("with_factors", wants_factors_); }

// Solves for the step v + u (m) that cancels the residual r (N) by the tangent K (N/m). u is `remaining`, the rest of
// the prescribed motion; v is along free directions, to which Π projects: Π K Π v = Π (r − K u). Returns the number of
// iterations.
int Newton::correct(const Field& remaining, bool moves, double accuracy, Field& step) {
  equilibrium_.linearize();
  const bool changed = equilibrium_.contact_has_changed();
  const bool is_damped_anew = damping_ > 5 * damping_when_new_ || damping_ < 0.2 * damping_when_new_;
  if (preconditioner_pending_ || (changed && !is_factorized_) || is_damped_anew) renew_preconditioner();
  const Constraints& held = equilibrium_.constraints();
  Field right = equilibrium_.residual();
  if (moves) {
    Field pull(remaining.size());
    equilibrium_.apply(remaining, pull);
    for (std::size_t i = 0; i < right.size(); ++i) right[i] -= pull[i];
    held.remove(right);
  }
  const auto product = [&](const Field& in, Field& out) {
    Field free = in;
    held.remove(free);
    equilibrium_.apply(free, out);
    if (damping_ > 0) {
      for (std::size_t i = 0; i < in.size(); ++i) out[i] += damping_ * drag_[i] * free[i];
    }
    held.remove(out);
    for (std::size_t i = 0; i < in.size(); ++i) out[i] += spring_ * (in[i] - free[i]);
  };
  // No stiffness couples separate parts of the body. Each part has its own unit of force, so that small forces in one
  // part are found as accurately as large ones in another.
  const SeparateParts& parts = equilibrium_.parts();
  std::vector<double> units(parts.pieces(), 1);
  if (parts.several()) units = parts.of_parts(parts.norms(right, equilibrium_.body().domain.communicator));
  for (double& unit : units) unit = unit > 0 ? unit : 1;
  for (std::size_t i = 0; i < right.size(); ++i) right[i] /= units[parts.of(static_cast<int>(i))];
  const int most = damping_ > 0 ? most_products_damped : most_products;
  const Krylov::Outcome outcome = with_another_preconditioner([&] {
    static Teuchos::Time& timer = phase("Linear solver");
    const Timed timed(timer);
    return changed ? krylov_.solve(product, right, Krylov::Measure::error, of_touch, most, step)
                   : krylov_.solve(product, right, Krylov::Measure::residual, accuracy, most, step);
  });
  if (!outcome.converged) damp_more(where_unstable);
  held.remove(step);
  for (std::size_t i = 0; i < step.size(); ++i) step[i] = units[parts.of(static_cast<int>(i))] * step[i] + remaining[i];
  if (products_when_new_ == 0) products_when_new_ = std::max(10, outcome.iterations);
  preconditioner_pending_ =
      outcome.iterations > wear * (is_factorized_ ? factor_->products_worth() : products_when_new_);
  return outcome.iterations;
}

// Takes the whole step if it reduces the forces, else the part of it that is downhill, or none if its start is uphill.
// A step that moves held points is taken whole, because there is nothing to compare with. Damping suppresses motion
// that the tangent finds soft or unstable (Levenberg and Marquardt; or an implicit step through a viscous medium).
Imbalance Newton::advance(const Imbalance& now, const Field& step, bool moves) {
  Body& body = equilibrium_.body();
  const double power = power_along(equilibrium_, body, step);
  move_by(body, 1, step);
  const Imbalance next = equilibrium_.evaluate();
  if (moves) return next;
  if (damping_ > 0) ++damped_;
  if (!next.failed && next.norm < (1 - 1e-4) * now.norm) {
    damp_less(next.norm < 0.5 * now.norm ? where_quick : where_slow);
    return next;
  }
  if (power <= 0) {
    damp_more(where_unstable);
    move_by(body, -1, step);
    return equilibrium_.evaluate();
  }
  double drag = 0;
  for (std::size_t i = 0; i < step.size(); ++i) drag += damping_ * drag_[i] * step[i].squaredNorm();
  const Stop stop = search_downhill(equilibrium_, step, power, body.domain.communicator.sum(drag), next);
  if (stop.fraction < short_part) damp_more(where_short);
  if (stop.fraction > long_part) damp_less(where_slow);
  return stop.left;
}

void Newton::report(const EquilibriumSearch& search, int products) const {
  if (!observer_.iterations) return;
  char line[160];
  std::snprintf(line, sizeof line, "  iteration %2d  %3d products  %.3e N left of %.3e N, damping %.0e%s",
                search.iterations + 1, products, search.left.norm, search.left.scale, damping_,
                search.left.failed ? "  failed" : "");
  observer_.iterations(line);
}

EquilibriumSearch Newton::solve(const Tolerance& tolerance) {
  EquilibriumSearch search;
  search.left = equilibrium_.evaluate();
  Field remaining = equilibrium_.constraints().remaining_displacement(equilibrium_.body()), step;
  bool moves = is_a_motion(remaining, equilibrium_.body());
  double before = search.left.norm;
  damping_ = 0, damped_ = 0;
  for (; search.iterations < tolerance.most_iterations && !search.left.failed; ++search.iterations) {
    if (damped_ == most_damped) break;
    if (!moves && is_balanced(search.left, tolerance)) break;
    const double gain = search.left.norm / before;
    const double enough = 0.3 * tolerance.relative * search.left.scale / search.left.norm;
    const double accuracy = moves ? of_first : std::clamp(std::max(0.5 * gain * gain, enough), finest, coarsest);
    before = search.left.norm;
    const int products = correct(remaining, moves, accuracy, step);
    search.evaluations += products;
    search.left = advance(search.left, step, moves);
    report(search, products);
    search.interrupted = equilibrium_.body().domain.communicator.any(observer_.stop_requested());
    if (search.interrupted) return search;
    std::fill(remaining.begin(), remaining.end(), Vector::Zero());
    moves = false;
  }
  search.converged = is_balanced(search.left, tolerance);
  return search;
}

}  // namespace strut

#include "solvers/newton.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/timing.hpp"
#include "solvers/near_matrix.hpp"

namespace strut {

namespace {

// Of the linear systems. Near the solution Newton's own convergence is the limit of what is worth solving for: the
// residual after a step is of the order of its square (Eisenstat & Walker 1996, choice 2).
constexpr double of_first = 1e-3, coarsest = 3e-2, finest = 1e-4;

// Of the error, where a point begins to touch a tool: the residual is then that of a stiff spring, and what the body
// will carry a small part of it.
constexpr double of_touch = 1e-2;
constexpr int most_products = 800;

// Of a step, in the search along it. Beyond a kink, a point that begins to touch or to flow, more force may be left
// than before; close to it there is always less. An evaluation costs a hundredth of the step.
constexpr int most_halvings = 10;

// A hierarchy is kept until systems take so much longer than just after it was made.
constexpr double wear = 1.5;

// Whether anything of the way is left but the round-off of times.
bool is_a_way(const Field& way, const Body& body) {
  double farthest = 0;  // in spacings
  for (std::size_t i = 0; i < way.size(); ++i) {
    farthest = std::max(farthest, way[i].norm() / body.domain.cloud.spacings[i]);
  }
  return body.domain.communicator.max(farthest) > 1e-9;
}

void move_by(Body& body, double factor, const Field& step) {
  for (int i = 0; i < body.owned(); ++i) body.sites[i].current.head<3>() += factor * step[i].array();
}

}  // namespace

Newton::Newton(Equilibrium& equilibrium, const Audience& audience)
    : equilibrium_(equilibrium),
      audience_(audience),
      krylov_(equilibrium.body().domain.communicator.teuchos(), equilibrium.body().owned()) {}

// Of a point alone.
double Newton::mean_spring(const BlockRows& matrix) const {
  double sums[] = {0, static_cast<double>(matrix.start.size() - 1)};
  for (std::size_t i = 0; i + 1 < matrix.start.size(); ++i) sums[0] += matrix.blocks[matrix.start[i]].trace() / 3;
  equilibrium_.body().domain.communicator.sum(sums);
  return sums[0] / sums[1];
}

void Newton::renew_preconditioner() {
  static Teuchos::Time& timer = phase("Preconditioner");
  const Timed timed(timer);
  Body& body = equilibrium_.body();
  const BlockRows matrix =
      near_matrix(body, equilibrium_.tangents(), equilibrium_.held(), equilibrium_.contact_springs(), krylov_.first());
  krylov_.precondition(matrix, rigid_motions(body));
  spring_ = mean_spring(matrix);
  preconditioner_due_ = false;
  products_when_new_ = 0;
}

// The step that takes the forces away by the tangent, with `way` along held directions: Π K Π v = Π (r − K way).
int Newton::correct(const Field& way, bool moves, double accuracy, Field& step) {
  equilibrium_.linearise();
  const bool changed = equilibrium_.contact_has_changed();
  if (preconditioner_due_ || changed) renew_preconditioner();
  const Held& held = equilibrium_.held();
  Field right = equilibrium_.residual();
  if (moves) {
    Field pull(way.size());
    equilibrium_.apply(way, pull);
    for (std::size_t i = 0; i < right.size(); ++i) right[i] -= pull[i];
    held.remove(right);
  }
  const auto product = [&](const Field& in, Field& out) {
    Field free = in;
    held.remove(free);
    equilibrium_.apply(free, out);
    held.remove(out);
    for (std::size_t i = 0; i < in.size(); ++i) out[i] += spring_ * (in[i] - free[i]);
  };
  const Krylov::Outcome outcome =
      changed ? krylov_.solve(product, right, Krylov::Measure::error, of_touch, most_products, step)
              : krylov_.solve(product, right, Krylov::Measure::residual, accuracy, most_products, step);
  held.remove(step);
  for (std::size_t i = 0; i < step.size(); ++i) step[i] += way[i];
  if (products_when_new_ == 0) products_when_new_ = std::max(10, outcome.iterations);
  preconditioner_due_ = outcome.iterations > wear * products_when_new_;
  return outcome.iterations;
}

// Along the step to where fewer forces are left: the whole of it, or a half, a quarter … ; where none of these leaves
// fewer, to the least found. A step that moves what is held is taken whole: there is nothing to compare with.
Imbalance Newton::advance(const Imbalance& now, const Field& step, bool moves) {
  Body& body = equilibrium_.body();
  double taken = 1;
  move_by(body, taken, step);
  Imbalance next = equilibrium_.evaluate();
  double best = taken;
  Imbalance least = next;
  for (int n = 0; n < most_halvings && !moves; ++n) {
    if (!next.failed && next.norm < (1 - 1e-4 * taken) * now.norm) return next;
    move_by(body, -0.5 * taken, step);
    taken *= 0.5;
    next = equilibrium_.evaluate();
    if (least.failed || (!next.failed && next.norm < least.norm)) least = next, best = taken;
  }
  if (best == taken) return next;
  move_by(body, best - taken, step);
  return equilibrium_.evaluate();
}

void Newton::tell(const Search& search, int products) const {
  if (!audience_.iterations) return;
  char line[120];
  std::snprintf(line, sizeof line, "  iteration %2d  %3d products  %.3e N left of %.3e N%s", search.iterations + 1,
                products, search.left.norm, search.left.scale, search.left.failed ? "  failed" : "");
  audience_.iterations(line);
}

Search Newton::solve(const Tolerance& tolerance) {
  Search search;
  search.left = equilibrium_.evaluate();
  Field way = equilibrium_.held().way_left(equilibrium_.body()), step;
  bool moves = is_a_way(way, equilibrium_.body());
  double before = search.left.norm;
  for (; search.iterations < tolerance.most_iterations && !search.left.failed; ++search.iterations) {
    if (!moves && is_balanced(search.left, tolerance)) break;
    const double gain = search.left.norm / before;
    const double enough = 0.3 * tolerance.relative * search.left.scale / search.left.norm;
    const double accuracy = moves ? of_first : std::clamp(std::max(0.5 * gain * gain, enough), finest, coarsest);
    before = search.left.norm;
    const int products = correct(way, moves, accuracy, step);
    search.evaluations += products;
    search.left = advance(search.left, step, moves);
    tell(search, products);
    search.interrupted = equilibrium_.body().domain.communicator.max(audience_.leaves() ? 1.0 : 0.0) > 0;
    if (search.interrupted) return search;
    std::fill(way.begin(), way.end(), Vector::Zero());
    moves = false;
  }
  search.converged = is_balanced(search.left, tolerance);
  return search;
}

}  // namespace strut

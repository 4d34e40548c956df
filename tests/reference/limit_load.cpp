#include "limit_load.hpp"

#include <cmath>

#include "../verification/loading.hpp"
#include "thin_members.hpp"

namespace strut::reference {

namespace {

// Yield so early that the strut neither stretches nor leans: at the last deflection its stretch is 2 % of that at
// yield.
constexpr double E = 1, sigma_y = 3e-5;               // Pa
constexpr int length = 8;                             // m, from one held layer of points to the other; a = 1 m
constexpr double limit = 2 * (sigma_y / 4) / length;  // N
constexpr double elastic_limit = sigma_y * length * length / (2 * E);  // m

materials::AnyLaw ideally_plastic() {
  const auto moduli = std::get<materials::Elastic>(elastic(E, 0.3));
  return materials::J2{moduli.bulk, moduli.shear, {sigma_y, materials::NoHardening{}, {}}};
}

// Leaves the inner half of the cell of a point in the middle of an element at an end.
void halve(PointCloud& cloud, std::size_t i, double h) {
  CellShape& shape = cloud.shapes[i];
  cloud.volumes[i] /= 2;
  shape.offset[2] = cloud.positions[i][2] > 0 ? -h / 4 : h / 4;
  shape.moments[2] = h * h / 48;
  shape.surface.head<2>() /= 2;
  shape.surface_moments.topLeftCorner<2, 2>() /= 2;
  shape.surface_moments.col(2) << shape.surface.head<2>() * shape.offset[2], 0;  // the end goes through the point
}

// From one held layer to the other. Points at elements stand half a spacing inside of the ends: one element more brings
// the layers apart by the length, and of the cells of these what is between the layers is kept.
PointCloud strut_points(int across, PointsAt at) {
  if (at == PointsAt::nodes) return square_prism(across, length * across, at);
  PointCloud cloud = square_prism(across, length * across + 1, at);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (std::abs(cloud.positions[i][2]) > 0.5 * length - 1e-6) halve(cloud, i, 1.0 / across);
  }
  return cloud;
}

std::vector<int> end_layer(const Body& body, double end) {
  return points_where(body, [&](const Vector& X) { return std::abs(X[2] - end) < 1e-6; });
}

// The condition 0 is the one that pushes.
Conditions clamped_and_guided(const Body& body, double deflection) {
  Conditions conditions;
  const std::vector<int> foot = end_layer(body, -0.5 * length), top = end_layer(body, 0.5 * length);
  const auto move = [&](const std::vector<int>& points, int component, double end, int condition) {
    conditions.add(PrescribedMotion{points, {component}, Function::parse(ramp(end)), false, condition});
  };
  move(top, 0, deflection, 0);
  move(top, 1, 0, 1), move(top, 2, 0, 2);
  for (int c = 0; c < 3; ++c) move(foot, c, 0, 3 + c);
  return conditions;
}

}  // namespace

void bend_to_limit(const Scheme& scheme, PointsAt points, int across, double furthest, int steps,
                   const std::function<void(double, double, double)>& at) {
  const Communicator world;
  Body body = body_by(scheme, strut_points(across, points), ideally_plastic(), world);
  const Conditions conditions = clamped_and_guided(body, furthest * elastic_limit);
  QuasiStatic solver(body, conditions, {}, {.load_steps = steps}, 0, 1, nobody());
  while (solver.time() < 1) {
    solver.advance();
    at(furthest * solver.time(), solver.reactions(6).forces[0][0] / limit, solver.ledger().balance_error);
  }
}

}  // namespace strut::reference

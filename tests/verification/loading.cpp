#include "verification/loading.hpp"

#include <cmath>
#include <sstream>

namespace strut {

materials::AnyLaw elastic_plastic(double slope) {
  const auto moduli = std::get<materials::Elastic>(elastic(young, poisson));
  return materials::J2{moduli.bulk, moduli.shear, {yield, materials::LinearHardening{slope}, materials::NoRate{}}};
}

LatticeSpec lattice_of(const Eigen::Array3i& cells, materials::AnyLaw law, double size) {
  LatticeSpec spec{cells, size, horizon};
  spec.material = {.density = 1000, .law = std::move(law), .stabilization = MeanGradientStabilization{0.01}};
  return spec;
}

std::vector<int> points_where(const Body& body, const Where& where) {
  std::vector<int> points;
  for (int i = 0; i < body.owned(); ++i) {
    if (where(body.domain.reference(i))) points.push_back(i);
  }
  return points;
}

std::vector<int> layer(const Body& body, const LatticeSpec& spec, int axis, bool upper) {
  const double place = spec.spacing * (upper ? spec.cells[axis] - 0.5 : 0.5);
  return points_where(body, [&](const Vector& X) { return std::abs(X[axis] - place) < 0.1 * spec.spacing; });
}

Observer nobody() {
  return {[](const std::string&) {}, {}, [] { return false; }};
}

Loaded::Loaded(const LatticeSpec& lattice, Make make) : spec(lattice), body(make(spec, world)) {}
Loaded::~Loaded() = default;

int Loaded::move(std::vector<int> points, int component, const std::string& value) {
  conditions.add(PrescribedMotion{std::move(points), {component}, Function::parse(value), false, count});
  return count++;
}

int Loaded::hold(std::vector<int> points, const Vector& normal) {
  conditions.add(SymmetryPlane{std::move(points), normal, count});
  return count++;
}

int Loaded::press(Shape shape, int axis, const std::string& travel, double friction) {
  RigidTool tool{points_where(body, [](const Vector&) { return true; }), std::move(shape), {}, friction, count};
  tool.travel[axis] = Function::parse(travel);
  conditions.add(std::move(tool));
  return count++;
}

void Loaded::guide() {
  hold(layer(body, spec, 0, false), Vector::UnitX());
  hold(layer(body, spec, 1, false), Vector::UnitY());
}

QuasiStatic Loaded::solver(const QuasiStaticControl& control) {
  return QuasiStatic(body, conditions, std::move(contact), control, 0, 1, nobody());
}

Bar::Bar(const LatticeSpec& lattice, double strain) : Loaded(lattice) {
  guide();
  low = move(layer(body, spec, 2, false), 2, "0");
  high = move(layer(body, spec, 2, true), 2, ramp(strain * length()));
}

void Gauge::step() {
  if (point_ < 0) return;
  const Vector now = body_.points[point_].deformation_gradient.diagonal();
  for (int c = 0; c < 3; ++c) strain_[c] += 2 * (now[c] - stretch_[c]) / (now[c] + stretch_[c]);
  stretch_ = now;
}

int point_at(const Body& body, const Vector& place) {
  for (int i = 0; i < body.owned(); ++i) {
    if ((body.domain.reference(i) - place).norm() < 1e-3 * spacing) return i;
  }
  return -1;
}

std::string number(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

Ledger load(QuasiStatic& solver, const Look& look) {
  while (solver.time() < 1) {
    solver.advance();
    look(solver);
  }
  return solver.ledger();
}

double left_over(const Loaded& loaded, const Tolerance& tolerance, double scale) {
  const double points = static_cast<double>(loaded.world.sum(static_cast<std::int64_t>(loaded.body.owned())));
  return tolerance.relative * std::sqrt(points) * scale;
}

std::vector<Vector> displacements(const Body& body) {
  std::vector<Vector> all(body.owned());
  for (int i = 0; i < body.owned(); ++i) all[i] = body.displacement(i);
  return all;
}

double largest_difference(const Body& one, const Body& other) {
  return largest_over(one, [&](int i) { return (one.displacement(i) - other.displacement(i)).norm(); });
}

}  // namespace strut

// Bodies on a lattice under slow loads, for the tests of equilibria.
#pragma once

#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "integrators/quasi_static/quasi_static.hpp"
#include "lattice.hpp"

namespace strut {

constexpr double young = 1e9, poisson = 0.3, yield = 5e6, hardening = 1e8;  // Pa
constexpr double spacing = 1e-3;                                            // m
constexpr double horizon = 1.75;                                            // spacings

inline materials::AnyLaw elastic_plastic(double slope = hardening) {
  const auto moduli = std::get<materials::Elastic>(elastic(young, poisson));
  return materials::J2{moduli.bulk, moduli.shear, {yield, materials::LinearHardening{slope}, materials::NoRate{}}};
}

inline LatticeSpec lattice_of(const Eigen::Array3i& cells, materials::AnyLaw law, double size = spacing) {
  LatticeSpec spec{cells, size, horizon};
  spec.material = {.density = 1000, .law = std::move(law), .stabilization = MeanGradientStabilization{0.01}};
  return spec;
}

using Where = std::function<bool(const Vector&)>;

inline std::vector<int> points_where(const Body& body, const Where& where) {
  std::vector<int> points;
  for (int i = 0; i < body.owned(); ++i) {
    if (where(body.domain.reference(i))) points.push_back(i);
  }
  return points;
}

// The layer of points at one end of a lattice along an axis.
inline std::vector<int> layer(const Body& body, const LatticeSpec& spec, int axis, bool upper) {
  const double place = spec.spacing * (upper ? spec.cells[axis] - 0.5 : 0.5);
  return points_where(body, [&](const Vector& X) { return std::abs(X[axis] - place) < 0.1 * spec.spacing; });
}

inline Observer nobody() {
  return {[](const std::string&) {}, {}, [] { return false; }};
}

// A body and its conditions, numbered as they are added; loads run from t = 0 to 1.
struct Loaded {
  using Make = Body (*)(const LatticeSpec&, const Communicator&);
  explicit Loaded(const LatticeSpec& lattice, Make make = lattice_body) : spec(lattice), body(make(spec, world)) {}

  int move(std::vector<int> points, int component, const std::string& value) {
    conditions.add(PrescribedMotion{std::move(points), {component}, Function::parse(value), false, count});
    return count++;
  }
  int hold(std::vector<int> points, const Vector& normal) {
    conditions.add(SymmetryPlane{std::move(points), normal, count});
    return count++;
  }
  // Adds a tool that all points may meet.
  int press(Shape shape, int axis, const std::string& travel, double friction = 0) {
    RigidTool tool{points_where(body, [](const Vector&) { return true; }), std::move(shape), {}, friction, count};
    tool.travel[axis] = Function::parse(travel);
    conditions.add(std::move(tool));
    return count++;
  }
  // Holds the lower faces across x and y along their normals: this prevents rigid translation across z, and a bar in
  // uniaxial stress feels no force.
  void guide() {
    hold(layer(body, spec, 0, false), Vector::UnitX());
    hold(layer(body, spec, 1, false), Vector::UnitY());
  }
  QuasiStatic solver(const QuasiStaticControl& control = {}) {
    return QuasiStatic(body, conditions, std::move(contact), control, 0, 1, nobody());
  }

  Communicator world;
  LatticeSpec spec;
  Body body;
  Conditions conditions;
  contact::Contact contact;
  int count = 0;
};

// The owned point nearest to a place, or −1 where another rank has it.
inline int point_at(const Body& body, const Vector& place) {
  for (int i = 0; i < body.owned(); ++i) {
    if ((body.domain.reference(i) - place).norm() < 1e-3 * spacing) return i;
  }
  return -1;
}

// A number with all digits, for expressions of a deck.
inline std::string number(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}
inline std::string ramp(double end) { return number(end) + " * t"; }

// A bar along z between its end layers: the lower one stays, the upper one is moved.
struct Bar : Loaded {
  Bar(const LatticeSpec& lattice, double strain) : Loaded(lattice) {
    guide();
    low = move(layer(body, spec, 2, false), 2, "0");
    high = move(layer(body, spec, 2, true), 2, ramp(strain * length()));
  }
  double length() const { return spec.spacing * (spec.cells[2] - 1); }
  double section() const { return spec.spacing * spec.spacing * spec.cells[0] * spec.cells[1]; }
  Vector middle() const { return 0.5 * spec.spacing * spec.cells.cast<double>().matrix(); }

  int low, high;
};

// The strain of a point as laws in rate form integrate it: the sum of 2 (λ − λ₀)/(λ + λ₀) over steps. It differs from
// ln λ by a twelfth of the cube of the strain of each step.
class Gauge {
 public:
  Gauge(const Body& body, const Vector& place) : body_(body), point_(point_at(body, place)) {}
  void step() {
    if (point_ < 0) return;
    const Vector now = body_.points[point_].deformation_gradient.diagonal();
    for (int c = 0; c < 3; ++c) strain_[c] += 2 * (now[c] - stretch_[c]) / (now[c] + stretch_[c]);
    stretch_ = now;
  }
  // Collective, as those below.
  double strain(int c) const { return body_.domain.communicator.sum(strain_[c]); }
  double stretch(int c) const {
    return of_point([&] { return stretch_[c]; });
  }
  double stress(int c) const {  // Pa, Cauchy's
    return of_point([&] { return body_.points[point_].stress[c]; });
  }
  // Pa, over the undeformed section across z.
  double nominal_stress() const { return stress(2) * stretch(0) * stretch(1); }

 private:
  template <class Value>
  double of_point(Value&& value) const {
    return body_.domain.communicator.sum(point_ < 0 ? 0.0 : static_cast<double>(value()));
  }

  const Body& body_;
  int point_;
  Vector stretch_ = Vector::Ones(), strain_ = Vector::Zero();
};

using Look = std::function<void(QuasiStatic&)>;

// Runs to the end of the loads, and calls `look` after every load step.
inline Ledger load(
    QuasiStatic& solver, const Look& look = [](QuasiStatic&) {}) {
  while (solver.time() < 1) {
    solver.advance();
    look(solver);
  }
  return solver.ledger();
}

// Largest sum over all points (N) of the forces that a search with this tolerance may leave, as for random directions.
inline double left_over(const Loaded& loaded, const Tolerance& tolerance, double scale) {
  const double points = static_cast<double>(loaded.world.sum(static_cast<std::int64_t>(loaded.body.owned())));
  return tolerance.relative * std::sqrt(points) * scale;
}

inline std::vector<Vector> displacements(const Body& body) {
  std::vector<Vector> all(body.owned());
  for (int i = 0; i < body.owned(); ++i) all[i] = body.displacement(i);
  return all;
}

// The largest difference of two bodies made alike.
inline double largest_difference(const Body& one, const Body& other) {
  return largest_over(one, [&](int i) { return (one.displacement(i) - other.displacement(i)).norm(); });
}

}  // namespace strut

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

materials::AnyLaw elastic_plastic(double slope = hardening);

LatticeSpec lattice_of(const Eigen::Array3i& cells, materials::AnyLaw law, double size = spacing);

using Where = std::function<bool(const Vector&)>;

std::vector<int> points_where(const Body& body, const Where& where);

// The layer of points at one end of a lattice along an axis.
std::vector<int> layer(const Body& body, const LatticeSpec& spec, int axis, bool upper);

Observer nobody();

// A body and its conditions, numbered as they are added; loads run from t = 0 to 1.
struct Loaded {
  using Make = Body (*)(const LatticeSpec&, const Communicator&);
  explicit Loaded(const LatticeSpec& lattice, Make make = lattice_body);
  ~Loaded();

  int move(std::vector<int> points, int component, const std::string& value);
  int hold(std::vector<int> points, const Vector& normal);
  // Adds a tool that all points may meet.
  int press(Shape shape, int axis, const std::string& travel, double friction = 0);
  // Holds the lower faces across x and y along their normals: this prevents rigid translation across z, and a bar in
  // uniaxial stress feels no force.
  void guide();
  QuasiStatic solver(const QuasiStaticControl& control = {});

  Communicator world;
  LatticeSpec spec;
  Body body;
  Conditions conditions;
  contact::Contact contact;
  int count = 0;
};

// The owned point nearest to a place, or −1 where another rank has it.
int point_at(const Body& body, const Vector& place);

// A number with all digits, for expressions of a deck.
std::string number(double value);
inline std::string ramp(double end) { return number(end) + " * t"; }

// A bar along z between its end layers: the lower one stays, the upper one is moved.
struct Bar : Loaded {
  Bar(const LatticeSpec& lattice, double strain);
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
  void step();
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
Ledger load(
    QuasiStatic& solver, const Look& look = [](QuasiStatic&) {});

// Largest sum over all points (N) of the forces that a search with this tolerance may leave, as for random directions.
double left_over(const Loaded& loaded, const Tolerance& tolerance, double scale);

std::vector<Vector> displacements(const Body& body);

// The largest difference of two bodies made alike.
double largest_difference(const Body& one, const Body& other);

}  // namespace strut

// A rigid sphere on an elastic half-space in equilibrium, through contact between surfaces, against Hertz (Johnson
// 1985, ch. 4). The half-space is a box of points; its bottom and sides move as those of a half-space under the same
// force at one point do (Boussinesq; Johnson 1985, 3.4), from which a force spread over the contact differs by some 0.1
// (a/r)² there, r the distance: 1 % of a tenth of the approach. Then the sphere is dragged along: Cattaneo and Mindlin
// (Johnson 1985, 7.2), and Cerruti for what is far.
#include <gtest/gtest.h>

#include <numbers>

#include "verification/loading.hpp"

namespace strut {
namespace {

// Lengths in spacings.
struct Indentation {
  double contact_radius = 5;
  double sphere = 10 * contact_radius;  // R
  int half_width = 15;                  // of the box, and its depth
  double friction = 0;
  double drag = 0;  // of the way that makes all slide

  double approach() const { return contact_radius * contact_radius / sphere; }
};

constexpr double shear = young / (2 * (1 + poisson)), effective = young / (1 - poisson * poisson);  // G, E*, Pa

double hertz(double sphere, double approach) {
  return 4.0 / 3 * effective * std::sqrt(sphere) * std::pow(approach, 1.5);
}

void add_point(const Vector& place, int block, PointCloud& cloud) {
  cloud.ids.push_back(static_cast<std::int64_t>(cloud.ids.size()));
  cloud.element_ids.push_back(cloud.ids.back() + 1);
  cloud.positions.push_back(place);
  cloud.volumes.push_back(std::pow(spacing, 3));
  cloud.spacings.push_back(spacing);
  cloud.blocks.push_back(block);
  cloud.sets.push_back(0);
}

// The box below z = 0, and of the sphere what is near: three layers that follow its surface, which touches the origin.
Body box_and_sphere(const Indentation& spec, const Communicator& world) {
  PointCloud cloud;
  cloud.block_names = {"box", "sphere"};
  const int w = spec.half_width;
  for (int k = -w; k < 3 && world.rank() == 0; ++k) {
    for (int j = -w; j < w; ++j) {
      for (int i = -w; i < w; ++i) {
        const Vector middle(i + 0.5, j + 0.5, k + 0.5);
        const double from_axis = middle.head<2>().norm(),
                     rise = spec.sphere - std::sqrt(spec.sphere * spec.sphere - from_axis * from_axis);
        if (k < 0) add_point(spacing * middle, 0, cloud);
        if (k >= 0 && from_axis < 1.4 * spec.contact_radius)
          add_point(spacing * (middle + rise * Vector::UnitZ()), 1, cloud);
      }
    }
  }
  const BlockMaterial material{
      .density = 1000, .law = elastic(young, poisson), .stabilization = MeanGradientStabilization{0.01}};
  const std::vector<BlockBonds> bonds{{horizon * spacing, 0}, {horizon * spacing, 1}};
  return make_body(make_domain(partitioned(std::move(cloud), world), bonds, world), Influence::one,
                   {material, material});
}

// The sphere is down at t = 1/3, then dragged until t = 1: both as expressions of the deck, from 0 to 1.
const std::string pressed = "(3*t*(t < 1/3) + (t >= 1/3))", dragged = "((t > 1/3)*(t - 1/3)*1.5)";

// Displacement of a half-space below z = 0 by a force, along x, y or z, m: downwards at the origin, or along x there
// (Johnson 1985, 3.4 and 3.6). `force`: N, an expression.
const std::string r = "sqrt(x*x + y*y + z*z)", factor = number(1 / (4 * std::numbers::pi * shear)) + "*";
std::string boussinesq(int component, const std::string& force) {
  const std::string along = component == 0 ? "x" : "y";
  if (component == 2)
    return "-" + force + "*" + factor + "(" + number(2 * (1 - poisson)) + " + z*z/(x*x + y*y + z*z))/" + r;
  return force + "*" + factor + along + "/" + r + "*(-z/(x*x + y*y + z*z) - " + number(1 - 2 * poisson) + "/(" + r +
         " - z))";
}

std::string cerruti(int component, const std::string& force) {
  const std::string below = "(" + r + " - z)",
                    in_plane = number(1 - 2 * poisson) + "/(" + r + "*" + below + "*" + below + ")";
  const std::string along = component == 0 ? "x*x" : "x*y";
  const std::string of_plane = along + "*(1/pow(" + r + ", 3) - " + in_plane + ")";
  if (component == 2)
    return "-" + force + "*" + factor + "x*(-z/pow(" + r + ", 3) + " + number(1 - 2 * poisson) + "/(" + r + "*" +
           below + "))";
  if (component == 1) return force + "*" + factor + of_plane;
  return force + "*" + factor + "(1/" + r + " + " + number(1 - 2 * poisson) + "/" + below + " + " + of_plane + ")";
}

// Displacement of the surface of the half-space along itself under the pressure, m (Johnson 1985, 4.2): inwards by (1 −
// 2ν)/(1 − ν) 2a³/(3π R r) (1 − (1 − r²/a²)^(3/2)), the last power 0 where r > a.
std::string drawn_in(const Indentation& spec, int component) {
  const double a = spec.contact_radius * spacing, most = (1 - 2 * poisson) / (1 - poisson) * 2 * std::pow(a, 3) /
                                                         (3 * std::numbers::pi * spec.sphere * spacing);
  const std::string r2 = "(x*x + y*y)", left = "(1 - " + r2 + "/(" + number(a * a) + "*(" + pressed + " + 1e-9)))",
                    inside = "(0.5*(" + left + " + fabs" + left + "))";
  return number(-most) + "*pow(" + pressed + ", 1.5)*" + (component == 0 ? "x" : "y") + "/" + r2 + "*(1 - pow(" +
         inside + ", 1.5))";
}

// Q/(μP) after this part of the way that makes all slide (Mindlin 1949).
double mindlin(double drag) { return 1 - std::pow(1 - drag, 1.5); }

struct Indented {
  explicit Indented(const Indentation& spec) : body(box_and_sphere(spec, world)) {
    const double approach = spec.approach() * spacing, force = hertz(spec.sphere * spacing, approach);
    const double all_slides = spec.friction * approach * (2 - poisson) / (2 * (1 - poisson));
    const double inside = (spec.half_width - 1) * spacing;
    const auto is_far = [&](const Vector& X) { return X.minCoeff() < -inside || X.head<2>().maxCoeff() > inside; };
    std::vector<int> far, sphere;
    for (int i = 0; i < body.owned(); ++i) {
      if (body.domain.cloud.blocks[i] == 1)
        sphere.push_back(i);
      else if (is_far(body.domain.reference(i)))
        far.push_back(i);
    }
    const std::string load = number(force) + "*pow(" + pressed + ", 1.5)";
    const std::string drag =
        number(spec.friction * force) + "*(1 - pow(1 - " + number(spec.drag) + "*" + dragged + ", 1.5))";
    const std::string way[] = {number(spec.drag * all_slides) + "*" + dragged, "0", number(-approach) + "*" + pressed};
    for (int axis = 0; axis < 3; ++axis) {
      move(sphere, axis, axis < 2 && spec.friction > 0 ? way[axis] + " + " + drawn_in(spec, axis) : way[axis]);
      move(far, axis, boussinesq(axis, load) + " + " + cerruti(axis, drag));
    }
    contact = contact::Contact({{0, 1, {surface_law(), spec.friction}}}, body.domain);
  }

  // Half a cell of the box is not strained, since forces act on points. Its compliance is what such a contact has.
  static contact::SurfaceLaw surface_law() {
    const double longitudinal = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));
    return {.factor = 2, .modulus = longitudinal, .radius = contact::reach_in_spacings * spacing, .spacing = spacing};
  }
  void move(const std::vector<int>& points, int axis, const std::string& way) {
    conditions.add(PrescribedMotion{points, {axis}, Function::parse(way), false, count++});
  }

  Communicator world;
  Body body;
  Conditions conditions;
  contact::Contact contact;
  int count = 0;
};

// The forces that the sphere takes, along x and downwards, N.
std::pair<double, double> forces_of(const Indentation& spec) {
  Indented half_space(spec);
  constexpr double tolerance = 1e-4;
  QuasiStatic solver(half_space.body, half_space.conditions, std::move(half_space.contact),
                     {.load_steps = spec.drag > 0 ? 3 : 1, .tolerance = {.relative = tolerance}}, 0, 1, nobody());
  load(solver);
  const Reactions reactions = solver.reactions(half_space.count);
  return {reactions.forces[0][0], -reactions.forces[4][2]};  // of the sphere's conditions and of what is far, in turn
}

double of_hertz(const Indentation& spec) {
  return forces_of(spec).second / hertz(spec.sphere * spacing, spec.approach() * spacing);
}

// Measured: 1.017; with Stiffness Factor 10, which leaves out the half cell, 1.09.
TEST(Hertz, ForceWithFivePointsInTheContactRadius) { EXPECT_NEAR(of_hertz({}), 1, 0.03); }

// Measured: 1.016; 1.006 with a sphere twice as large, whose strains are half as large; 1.049 with a factor of 10.
TEST(Hertz, DISABLED_ForceWithTenPointsInTheContactRadius) {
  EXPECT_NEAR(of_hertz({.contact_radius = 10, .half_width = 30}), 1, 0.03);
}

// The sticking circle is c/a = (1 − Q/μP)^⅓; by the displacement of the sphere it is √(1 − drag). Both neglect the
// displacement along the surface by the pressure, which is zero for equal bodies, since the sphere is drawn in as the
// half-space is. Measured: 2.7 % less of c/a. 5.8 % more where friction follows the turning of the surface.
TEST(Mindlin, StickingCircleUnderADrag) {
  const Indentation spec{.friction = 0.3, .drag = 0.6};
  const auto [along, down] = forces_of(spec);
  const double sticks = std::cbrt(1 - along / (spec.friction * down)), expected = std::sqrt(1 - spec.drag);
  EXPECT_NEAR(along / (spec.friction * down), mindlin(spec.drag), 0.03);
  EXPECT_NEAR(sticks, expected, 0.05 * expected);
}

}  // namespace
}  // namespace strut

// A rigid sphere on an elastic half-space in equilibrium, through contact between surfaces, against Hertz (Johnson
// 1985, ch. 4). The half-space is a box of points; its bottom and sides move as those of a half-space under the same
// force at one point do (Boussinesq; Johnson 1985, 3.4), from which a force spread over the contact differs by some 0.1
// (a/r)² there, r the distance: 1 % of a tenth of the approach.
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

// What a force F that comes with t^1.5 does to a half-space below z = 0 that it pushes downwards at the origin, as
// expressions of the deck; along x, y or z, m.
std::string boussinesq(int component, double force) {
  const std::string factor = number(force / (4 * std::numbers::pi * shear)) + "*pow(t, 1.5)*";
  const std::string r = "sqrt(x*x + y*y + z*z)", along = component == 0 ? "x" : "y";
  if (component == 2) return "-" + factor + "(" + number(2 * (1 - poisson)) + " + z*z/(x*x + y*y + z*z))/" + r;
  return factor + along + "/" + r + "*(-z/(x*x + y*y + z*z) - " + number(1 - 2 * poisson) + "/(" + r + " - z))";
}

struct Indented {
  explicit Indented(const Indentation& spec) : body(box_and_sphere(spec, world)) {
    const double approach = spec.approach() * spacing, inside = (spec.half_width - 1) * spacing;
    const auto is_far = [&](const Vector& X) { return X.minCoeff() < -inside || X.head<2>().maxCoeff() > inside; };
    std::vector<int> far, sphere;
    for (int i = 0; i < body.owned(); ++i) {
      if (body.domain.cloud.blocks[i] == 1)
        sphere.push_back(i);
      else if (is_far(body.domain.reference(i)))
        far.push_back(i);
    }
    for (int axis = 0; axis < 3; ++axis) {
      move(sphere, axis, axis == 2 ? ramp(-approach) : "0");
      move(far, axis, boussinesq(axis, hertz(spec.sphere * spacing, approach)));
    }
    contact = contact::Contact({{0, 1, {surface_law()}}}, body.domain);
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

// What a sphere takes to come down by its approach, of Hertz' force.
double force_of(const Indentation& spec) {
  Indented half_space(spec);
  constexpr double tolerance = 1e-4;
  QuasiStatic solver(half_space.body, half_space.conditions, std::move(half_space.contact),
                     {.load_steps = 1, .tolerance = {.relative = tolerance}}, 0, 1, nobody());
  load(solver);
  constexpr int down = 4;  // of the sphere's conditions and those of what is far, in turn
  const double force = -solver.reactions(half_space.count).forces[down][2];
  return force / hertz(spec.sphere * spacing, spec.approach() * spacing);
}

// Measured: 1.017; with Stiffness Factor 10, which leaves out the half cell, 1.09.
TEST(Hertz, ForceWithFivePointsInTheContactRadius) { EXPECT_NEAR(force_of({}), 1, 0.03); }

// Measured: 1.016; 1.006 with a sphere twice as large, whose strains are half as large.
TEST(Hertz, DISABLED_ForceWithTenPointsInTheContactRadius) {
  EXPECT_NEAR(force_of({.contact_radius = 10, .half_width = 30}), 1, 0.03);
}

}  // namespace
}  // namespace strut

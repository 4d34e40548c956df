// Contact between the surfaces of lattices that stand as they are told to: forces alone, nothing moves.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "contact/search/search.hpp"
#include "contact/surfaces.hpp"
#include "topology/partition.hpp"
#include "verification/larger.hpp"

namespace strut::contact {
namespace {

constexpr double h = 1e-3, modulus = 1e11;

// Middles of cubes, or nodes, of a box on a lattice.
struct Box {
  int nx, ny, nz;
  PointsAt at = PointsAt::elements;
};

// The box's points in its own frame, its bottom face in the plane z = 0, its middle axis x = y = 0, and their volumes.
std::vector<std::pair<Vector, double>> points_of(const Box& box) {
  const bool nodes = box.at == PointsAt::nodes;
  const int n[3] = {box.nx + nodes, box.ny + nodes, box.nz + nodes};
  std::vector<std::pair<Vector, double>> points;
  for (int i = 0; i < n[0] * n[1] * n[2]; ++i) {
    const int c[3] = {i % n[0], i / n[0] % n[1], i / (n[0] * n[1])};
    Vector X;
    double volume = h * h * h;
    for (int k = 0; k < 3; ++k) {
      X[k] = h * (c[k] + (nodes ? 0 : 0.5));
      if (nodes && (c[k] == 0 || c[k] == n[k] - 1)) volume /= 2;
    }
    X -= 0.5 * h * Vector(box.nx, box.ny, 0);
    points.emplace_back(X, volume);
  }
  return points;
}

constexpr double far = 1;  // from where the second body is placed, m

// Points of two bodies, each on the rank that the partition gives it to.
Domain domain_of(const std::vector<std::vector<std::pair<Vector, double>>>& bodies, PointsAt at,
                 const Communicator& world) {
  PointCloud cloud;
  cloud.at = at;
  cloud.block_names = {"lower", "upper"};
  std::int64_t id = 0;
  for (int b = 0; b < 2; ++b) {
    for (const auto& [X, volume] : bodies[b]) {
      if (id++ % world.size() != world.rank()) continue;
      cloud.ids.push_back(id - 1);
      cloud.element_ids.push_back(id);
      cloud.positions.push_back(X + Vector(0, 0, far * b));
      cloud.volumes.push_back(volume);
      cloud.spacings.push_back(h);
      cloud.blocks.push_back(b);
      cloud.sets.push_back(0);
    }
  }
  return make_domain(partitioned(std::move(cloud), world), {{1.75 * h, 0}, {1.75 * h, 1}}, world);
}

// The contact forces of two bodies at their present positions.
class Scene {
 public:
  Scene(const std::vector<std::vector<std::pair<Vector, double>>>& bodies, PointsAt at = PointsAt::elements,
        SurfaceLaw law = {})
      : domain_(domain_of(bodies, at, world_)), law_(law) {
    law_.modulus = modulus;
    law_.radius = reach_in_spacings * h;
    law_.spacing = h;
    for (const auto& [X, volume] : bodies[0]) height_ = std::max(height_, X[2] + (at == PointsAt::nodes ? 0 : h / 2));
    for (int i = 0; i < domain_.owned; ++i) blocks_.points.push_back(i);
    surfaces_.emplace(domain_, blocks_, law_);
    velocities_.assign(domain_.owned, Vector::Zero());
    densities_.assign(domain_.owned, 8000);
  }

  // The second body turned by R about its origin, which comes to `origin`, seen from the middle of the first one's top.
  ForceResult place(const Vector& origin, const Tensor& R = Tensor::Identity()) {
    for (int i = 0; i < domain_.owned; ++i) {
      if (domain_.cloud.blocks[i] == 0) continue;
      const Vector X = domain_.reference(i) - Vector(0, 0, far);
      domain_.sites[i].current.head<3>() = (R * X + origin + Vector(0, 0, height_)).array();
    }
    const Kinematics kinematics{domain_, velocities_, densities_};
    SkinDistances none{std::vector<float>(blocks_.points.size(), 0), 0};
    pairs_ = find_pairs(kinematics, blocks_, law_.radius, none);
    surfaces_->take(domain_, blocks_, {}, {}, pairs_);
    density_.assign(domain_.owned, Vector::Zero());
    ForceResult result = surfaces_->add_normal_forces(kinematics, law_, false, pairs_, density_);
    result.energy = world_.sum(result.energy);
    result.deepest.penetration = world_.max(result.deepest.penetration);
    result.stiffness = world_.max(result.stiffness);
    return result;
  }

  // Adds the friction of a step of velocities about `speed` that differ from point to point, and returns its power, W.
  double rub(double speed, double coefficient) {
    for (int i = 0; i < domain_.owned; ++i) {
      const double x = static_cast<double>(domain_.id(i));
      velocities_[i] = speed * Vector(domain_.cloud.blocks[i] + 0.2 * std::sin(x), std::cos(3 * x), std::sin(7 * x));
    }
    return rub(coefficient);
  }
  // The same where the second body goes as a rigid one, at `speed` at a place above the first one's top, and turns.
  double rub(double speed, double above, double turn, double coefficient) {
    for (int i = 0; i < domain_.owned; ++i) {
      const double z = domain_.current(i)[2] - height_ - above, x = domain_.current(i)[0];
      velocities_[i] = domain_.cloud.blocks[i] * Vector(speed + turn * z, 0, -turn * x);
    }
    return rub(coefficient);
  }

  // The largest difference of the friction of a trial that sticks, all along `displacements`, from what the tangent
  // makes of them, and the largest friction, N.
  std::pair<double, double> sticking(double size) {
    std::vector<Vector> displacements(domain_.owned), friction, with(domain_.owned, Vector::Zero()), without = with,
                                                                                                     forces = with;
    for (int i = 0; i < domain_.owned; ++i) {
      const double x = static_cast<double>(domain_.id(i));
      displacements[i] = size * Vector(std::sin(x), std::cos(3 * x), std::sin(7 * x));
    }
    surfaces_->add_stiffness(pairs_, displacements, without);
    Couples none;
    surfaces_->add_friction({domain_, velocities_, densities_}, {.of = displacements, .is_trial = true}, law_, 1e3,
                            pairs_, none, forces, friction);
    surfaces_->add_stiffness(pairs_, displacements, with);
    double largest = 0, difference = 0;
    for (int i = 0; i < domain_.owned; ++i) {
      const Vector force = forces[i] * domain_.volume(i);
      largest = larger(largest, force.norm());
      difference = larger(difference, (force + with[i] - without[i]).norm());
    }
    return {world_.max(difference), world_.max(largest)};
  }

  // The tangent force along the second body's motion by a unit vector, N/m.
  double stiffness(const Vector& along) {
    std::vector<Vector> field(domain_.owned, Vector::Zero()), result = field;
    for (int i = 0; i < domain_.owned; ++i)
      if (domain_.cloud.blocks[i] == 1) field[i] = along;
    surfaces_->add_stiffness(pairs_, field, result);
    return sum([&](int i) { return Vector(field[i].dot(result[i]), 0, 0); })[0];
  }

  // Force on a body at the last positions, N, and its moment about 0, N m.
  Vector force(int body) const {
    return sum([&](int i) { return domain_.cloud.blocks[i] == body ? force_on(i) : Vector(Vector::Zero()); });
  }
  Vector torque() const {
    return sum([&](int i) { return Vector(domain_.current(i).cross(force_on(i))); });
  }

 private:
  double rub(double coefficient) {
    std::vector<Vector> friction;
    Couples couples;
    couples.take(domain_, pairs_.owned);
    surfaces_->add_friction({domain_, velocities_, densities_}, {velocities_, 1}, law_, coefficient, pairs_, couples,
                            density_, friction);
    double power = 0;
    for (std::size_t k = 0; k < friction.size(); ++k) power += friction[k].dot(velocities_[pairs_.owned[k]]);
    couples.for_each_force([&](int i, const Vector& force) { power += force.dot(velocities_[i]); });
    return world_.sum(power);
  }
  Vector force_on(int i) const { return domain_.volume(i) * density_[i]; }
  template <class Of>
  Vector sum(const Of& of) const {
    Vector all = Vector::Zero();
    for (int i = 0; i < domain_.owned; ++i) all += of(i);
    world_.sum(std::span(all.data(), 3));
    return all;
  }

  Communicator world_;
  Domain domain_;
  SurfaceLaw law_;
  double height_ = 0;  // of the first body, m
  BlockPair blocks_{0, 1, false, true, {}};
  std::optional<Surfaces> surfaces_;
  Pairs pairs_;
  std::vector<Vector> velocities_, density_;
  std::vector<double> densities_;
};

Tensor turned(double degrees, const Vector& axis) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis.normalized()).toRotationMatrix();
}

constexpr double epsilon = std::numeric_limits<double>::epsilon();
const PointsAt kinds[] = {PointsAt::elements, PointsAt::nodes};

Scene two_boxes(PointsAt at) { return Scene({points_of({18, 18, 4, at}), points_of({6, 6, 4, at})}, at); }

// Offsets that are no multiples of each other, over two spacings.
Vector offset(int k) { return {0.37 * h * k / 6 + 0.01 * h, 0.61 * h * k / 6, 0}; }

// The lattices are hardly felt: the largest slope seen is 0.92 % (cells, parallel lattices, 10 % overlap).
TEST(Surfaces, EqualLatticesSlideAtAnyOffsetAndAngle) {
  for (const PointsAt at : kinds) {
    Scene scene = two_boxes(at);
    for (const double angle : {0.0, 10.0, 45.0}) {
      for (const double overlap : {0.005, 0.02, 0.1}) {
        for (int k = 0; k < 12; ++k) {
          scene.place(offset(k) - overlap * h * Vector::UnitZ(), turned(angle, Vector::UnitZ()));
          const Vector force = scene.force(1);
          EXPECT_GT(force[2], 0);
          EXPECT_LT(std::hypot(force[0], force[1]), 0.01 * force[2]) << word(at) << angle << " " << overlap;
        }
      }
    }
  }
}

// The first touch, as a part of a spacing above the face; measured: between 0 and −0.01.
TEST(Surfaces, TouchWhereTheCellsEnd) {
  for (const PointsAt at : kinds) {
    Scene scene = two_boxes(at);
    for (const double angle : {0.0, 10.0, 45.0}) {
      for (const double x : {0.0, 0.25, 0.5}) {
        const auto touches = [&](double gap) {
          return scene.place(Vector(x * h, 0.3 * x * h, gap), turned(angle, Vector::UnitZ())).energy > 0;
        };
        EXPECT_FALSE(touches(0.02 * h)) << word(at) << angle << " " << x;
        EXPECT_TRUE(touches(-0.03 * h)) << word(at) << angle << " " << x;
      }
    }
  }
}

// A round strut made of cubes, on a plate: it touches where its lowest cells end.
TEST(Surfaces, StrutsTouchWhereTheirCellsEnd) {
  for (const int radius : {2, 3}) {
    std::vector<std::pair<Vector, double>> strut;
    for (const auto& [X, volume] : points_of({16, 8, 8})) {
      const Vector from_axis = X - Vector(0, 0, 4 * h);
      if (std::hypot(from_axis[1], from_axis[2]) < radius * h) strut.emplace_back(from_axis, volume);
    }
    Scene scene({points_of({26, 18, 4}), strut});
    EXPECT_EQ(scene.place(Vector(0, 0, (radius + 0.1) * h)).energy, 0) << radius;
    EXPECT_GT(scene.place(Vector(0, 0, (radius - 0.1) * h)).energy, 0) << radius;
  }
}

// K g: with p/(factor M) spacings of overlap under the pressure p. The boxes are large, so that their edges, where the
// faces feel half, count little: the middle bears the additional force of a box of two more cells.
TEST(Surfaces, PressureIsThatOfALayer) {
  for (const PointsAt at : kinds) {
    const double overlap = 0.02 * h;
    const auto force_of = [&](int n) {
      Scene scene({points_of({22, 22, 4, at}), points_of({n, n, 4, at})}, at);
      scene.place(Vector(0.3 * h, 0.2 * h, -overlap));
      return scene.force(1)[2];
    };
    // n² p + 4 n q + 4 r for any n.
    const double pressure = (force_of(12) - 2 * force_of(10) + force_of(8)) / (8 * h * h);
    EXPECT_NEAR(pressure, 0.25 * modulus * overlap / h, 0.1 * 0.25 * modulus * overlap / h) << word(at);
  }
}

// By central differences of the energy over 2 Δ: off by Δ² times a third derivative, and by kinks where a point begins
// to touch, both below 1e-4 of the force here; round-off ε E/Δ is less.
TEST(Surfaces, ForceIsTheSlopeOfTheEnergy) {
  const Tensor R = turned(25, Vector(1, 2, 3));
  for (const PointsAt at : kinds) {
    for (const double limit : {0.0, 0.5}) {
      Scene scene({points_of({10, 10, 4, at}), points_of({4, 4, 4, at})}, at, {.largest_overlap = limit});
      const Vector place(0.3 * h, -0.2 * h, -0.02 * h);
      scene.place(place, R);
      const Vector force = scene.force(1);
      for (int c = 0; c < 3; ++c) {
        const Vector step = 1e-4 * h * Vector::Unit(c);
        const double slope = (scene.place(place + step, R).energy - scene.place(place - step, R).energy) / (2e-4 * h);
        EXPECT_NEAR(-slope, force[c], 1e-4 * force.norm()) << word(at) << c;
      }
    }
  }
}

TEST(Surfaces, ForcesAndTorquesAddUpToNothing) {
  for (const PointsAt at : kinds) {
    Scene scene = two_boxes(at);
    scene.place(Vector(0.3 * h, -0.2 * h, -0.05 * h), turned(3, Vector(1, 2, 3)));
    const double force = scene.force(1).norm();
    ASSERT_GT(force, 0);
    EXPECT_LT((scene.force(0) + scene.force(1)).norm(), 1e3 * epsilon * force);  // of some hundred points
    EXPECT_LT(scene.torque().norm(), 1e3 * epsilon * force * 18 * h);
  }
}

// Whatever rubs: blocks, a block on a plate one cell thick, on a wire of one row of cells; of the latter only what does
// not turn it about itself. From where nothing has slipped friction takes energy.
TEST(Surfaces, FrictionTurnsNothing) {
  for (const Box& lower : {Box{18, 18, 4}, Box{18, 18, 1}, Box{18, 1, 1}}) {
    Scene scene({points_of(lower), points_of({6, 6, 4})});
    scene.place(Vector(0.3 * h, -0.2 * h, -0.05 * h), turned(3, Vector(1, 2, 3)));
    const double before = scene.force(1).norm();
    const double power = scene.rub(1, 0.3), force = scene.force(1).norm();
    EXPECT_GT(force, 1.005 * before) << "it rubs";
    EXPECT_LT(power, 0);
    EXPECT_LT((scene.force(0) + scene.force(1)).norm(), 1e3 * epsilon * force);  // of some hundred points
    EXPECT_LT(scene.torque().norm(), 1e4 * epsilon * force * 18 * h) << lower.ny << " " << lower.nz;
  }
}

// A body that turns about a line in the plane where it touches does not slip there, whichever body's points feel: the
// power of its friction beside that of a body which slides as fast as this one goes half a spacing above. The rest,
// 0.026 and 0.020 (a slip of 0.08 spacings times the turn, root mean square), is that of the rims, where the normal is
// askew.
TEST(Surfaces, WhatRollsDoesNotRub) {
  for (const PointsAt at : kinds) {
    const double overlap = 0.05 * h, speed = 1e-3 * h, rate = speed / (h / 2), sticks = 1e3;
    const auto power = [&](double along, double turn) {
      Scene scene({points_of({18, 18, 4, at}), points_of({6, 6, 4, at})}, at);
      scene.place(Vector(0.3 * h, -0.2 * h, -overlap));
      return scene.rub(along, -overlap / 2, turn, sticks);
    };
    EXPECT_LT(power(speed, 0), 0);
    EXPECT_LT(power(0, rate) / power(speed, 0), 0.04) << word(at);
  }
}

// Friction that sticks is linear in the ways of points: its tangent is the force of equilibria, for blocks and for what
// takes no couple.
TEST(Surfaces, TangentOfStickingFrictionIsItsForce) {
  for (const Box& lower : {Box{18, 18, 4}, Box{18, 1, 1}}) {
    Scene scene({points_of(lower), points_of({6, 6, 4})});
    scene.place(Vector(0.3 * h, -0.2 * h, -0.05 * h), turned(3, Vector(1, 2, 3)));
    const auto [difference, largest] = scene.sticking(1e-5 * h);
    EXPECT_GT(largest, 0);
    EXPECT_LT(difference, 1e3 * epsilon * largest * 1e2) << "of normal forces' tangent, a hundred times as stiff";
  }
}

// Plates one cell thick, and two, push each other apart from where they touch until their middles are level; the work
// to get there is a barrier of pressures near that of their own stiffness.
TEST(Surfaces, ThinPlatesDoNotPassThroughEachOther) {
  for (const int thick : {1, 2}) {
    Scene scene({points_of({14, 14, thick}), points_of({8, 8, thick})});
    double last = 0;
    for (int k = 1; k <= 9 * thick; ++k) {
      const double energy = scene.place(Vector(0.2 * h, 0.1 * h, -0.1 * k * h)).energy;
      EXPECT_GT(energy, last) << thick << " " << k;
      EXPECT_GT(scene.force(1)[2], 0);
      last = energy;
    }
    EXPECT_GT(last / (64 * h * h), 0.02 * modulus * h);
  }
}

// The tangent is the derivative of the forces but for the turning and curving of W, which are in proportion to the
// pressure: at an overlap of 1e-3 spacings some 1e-2.
TEST(Surfaces, StiffnessIsTheDerivativeOfTheForces) {
  for (const PointsAt at : kinds) {
    Scene scene = two_boxes(at);
    const Vector place(0.3 * h, -0.2 * h, -1e-3 * h), step(0, 0, 1e-5 * h);
    scene.place(place + step);
    const double more = scene.force(1)[2];
    scene.place(place - step);
    const double less = scene.force(1)[2];
    scene.place(place);
    const double stiffness = scene.stiffness(Vector::UnitZ());
    EXPECT_NEAR(stiffness, (less - more) / (2e-5 * h), 0.03 * stiffness) << word(at);
  }
}

// The bound of ω² is one: a light cell on a plate that is held has ω² = K/m, which is less than what both may do.
TEST(Surfaces, BoundOfTheFrequencyIsOne) {
  Scene scene({points_of({10, 10, 3}), points_of({1, 1, 1})});
  const ForceResult result = scene.place(Vector(0, 0, -0.01 * h));
  const double exact = scene.stiffness(Vector::UnitZ()) / (8000 * h * h * h);
  EXPECT_GT(exact, 0);
  EXPECT_GE(result.stiffness, exact);
  EXPECT_LT(result.stiffness, 4 * exact);
}

// Energy, pressure and slope as each other's derivatives, by central differences of 1e-6 g_l.
TEST(SurfaceLaw, TheLimitHoldsTheOverlap) {
  const SurfaceLaw law{.factor = 0.25, .largest_overlap = 0.1, .modulus = modulus, .radius = 2.5 * h, .spacing = h};
  const double limit = 0.1 * h, d = 1e-6 * limit;
  for (const double g : {0.1 * limit, 0.5 * limit, 0.9 * limit, 0.99 * limit}) {
    EXPECT_NEAR((law.energy(g + d) - law.energy(g - d)) / (2 * d), law.pressure(g), 1e-5 * law.pressure(g));
    EXPECT_NEAR((law.pressure(g + d) - law.pressure(g - d)) / (2 * d), law.slope(g), 1e-5 * law.slope(g));
  }
  EXPECT_GT(law.pressure(0.9 * limit), 9.9 * 0.25 * modulus * 0.09);
}

}  // namespace
}  // namespace strut::contact

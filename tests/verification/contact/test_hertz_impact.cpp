// The impact of two elastic spheres against Hertz' closed form (Johnson, Contact Mechanics 1985, 11.1): two points
// alone, which nothing but contact moves.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "contact/contact.hpp"
#include "topology/partition.hpp"

namespace strut::contact {
namespace {

constexpr double h = 1e-3, gap = 0.2 * h, speed = 10, density = 8000, modulus = 60e9;
constexpr double reduced_mass = 0.5 * density * h * h * h, effective_radius = 0.25 * h;
const HertzLaw law{.radius = h, .effective_modulus = modulus};

// Johnson's eq. 11.7 and 11.8, with all figures of the constant that he gives as 2.87: 4/5 B(2/5, 1/2) (15/16)^(2/5).
double largest_overlap() {
  return std::pow(15 * reduced_mass * speed * speed / (16 * modulus * std::sqrt(effective_radius)), 0.4);
}
double duration_constant() {
  return 0.8 * std::tgamma(0.4) * std::tgamma(0.5) / std::tgamma(0.9) * std::pow(15.0 / 16, 0.4);
}
double duration() {
  return duration_constant() *
         std::pow(reduced_mass * reduced_mass / (effective_radius * modulus * modulus * speed), 0.2);
}

TEST(HertzImpact, ConstantOfTheDurationIsJohnsons) { EXPECT_NEAR(duration_constant(), 2.87, 0.005); }

// Two points of two bodies; on two ranks one each. The second flies against the first.
class Impact {
 public:
  Impact() : domain_(two_points(world_)), contact_({{0, 1, {law}}}, domain_) {
    for (int i = 0; i < domain_.owned; ++i)
      velocities_.push_back(domain_.cloud.blocks[i] == 1 ? Vector(-speed * axis()) : Vector(Vector::Zero()));
    densities_.assign(domain_.owned, density);
    add_forces(0);
  }

  // By central differences.
  void step(double dt) {
    const double kick = 0.5 * (dt_ + dt);
    for (int i = 0; i < domain_.owned; ++i) {
      before_[i] = velocities_[i];
      velocities_[i] += kick / density * forces_[i];
      domain_.sites[i].current.head<3>() += dt * velocities_[i].array();
    }
    dt_ = dt;
    add_forces(dt);
  }

  double overlap() const {
    return h - sum([&](int i) { return sign(i) * domain_.current(i).dot(axis()); });
  }
  double closing_speed() const {
    return -sum([&](int i) { return sign(i) * velocities_[i].dot(axis()); });
  }
  double bound() const { return contact_.stiffness(); }
  double energy() const { return world_.sum(contact_.energy()); }
  // The kinetic energy of the finished step: at the time of the forces before it, by the mean of the velocities around
  // them.
  double kinetic_energy() const {
    return sum([&](int i) { return 0.125 * density * h * h * h * (before_[i] + velocities_[i]).squaredNorm(); });
  }
  Vector momentum() const {
    Vector p;
    for (int c = 0; c < 3; ++c) p[c] = sum([&](int i) { return velocities_[i][c]; });
    return p;
  }
  // The stiffness of the contact, N/m: the tangent force on the second point for its motion by 1 along the axis.
  double stiffness() {
    std::vector<Vector> field, result(domain_.owned, Vector::Zero());
    for (int i = 0; i < domain_.owned; ++i)
      field.push_back(domain_.cloud.blocks[i] == 1 ? axis() : Vector(Vector::Zero()));
    contact_.add_stiffness(field, result);
    return sum([&](int i) { return result[i].dot(field[i]); });
  }

 private:
  static Vector axis() { return Vector(2, -1, 2) / 3; }
  double sign(int i) const { return domain_.cloud.blocks[i] == 1 ? 1 : -1; }

  template <class Of>
  double sum(const Of& of) const {
    double all = 0;
    for (int i = 0; i < domain_.owned; ++i) all += of(i);
    return world_.sum(all);
  }

  static Domain two_points(const Communicator& world) {
    PointCloud cloud;
    cloud.block_names = {"struck", "flying"};
    for (int i = 0; i < 2; ++i) {
      if (i % world.size() != world.rank()) continue;
      cloud.ids.push_back(i);
      cloud.element_ids.push_back(i + 1);
      cloud.positions.push_back(i * (h + gap) * axis());
      cloud.volumes.push_back(h * h * h);
      cloud.spacings.push_back(h);
      cloud.blocks.push_back(i);
      cloud.sets.push_back(0);
    }
    return make_domain(partitioned(std::move(cloud), world), {{2 * h, 0}, {2 * h, 1}}, world);
  }

  void add_forces(double dt) {
    const Kinematics kinematics{domain_, velocities_, densities_};
    forces_.assign(domain_.owned, Vector::Zero());
    before_.resize(domain_.owned, Vector::Zero());
    contact_.add_forces(kinematics, dt, forces_);
    std::vector<double> agreed;
    contact_.append_to_agree(kinematics, agreed);
    world_.max(agreed);
    contact_.take_agreed(agreed, dt);
  }

  Communicator world_;
  Domain domain_;
  std::vector<Vector> velocities_, before_, forces_;  // forces: densities, N/m³
  std::vector<double> densities_;
  double dt_ = 0;
  Contact contact_;
};

struct Course {
  double duration, largest_overlap, rebound, balance;  // s, m, m/s; energy: the largest error, as a part of the first
};

// A flight of constant speed before and after: so the moments at which the points touch and part are known exactly.
Course course_in(int steps_while_in_touch) {
  Impact impact;
  const double dt = duration() / steps_while_in_touch;
  const double energy = 0.5 * density * h * h * h * speed * speed;
  Course course{0, 0, 0, 0};
  double time = 0;
  for (; time < gap / speed || impact.overlap() > 0; time += dt) {
    const double stored = impact.energy();
    impact.step(dt);
    if (time > 0)
      course.balance = std::max(course.balance, std::abs(impact.kinetic_energy() + stored - energy) / energy);
    course.largest_overlap = std::max(course.largest_overlap, impact.overlap());
  }
  course.rebound = -impact.closing_speed();
  course.duration = time + impact.overlap() / course.rebound - gap / speed;
  return course;
}

// Central differences are off by the second order: ω Δt is at most 4.03/400 here (ω T = 4.03 at the largest overlap,
// from the closed form), its square over 24 is 4e-6. Measured: 3e-6 of duration and overlap, 1e-7 of the velocity, 5e-6
// of the energy.
TEST(HertzImpact, DurationAndLargestOverlapAreThoseOfTheClosedForm) {
  const Course course = course_in(400);
  EXPECT_NEAR(course.duration / duration(), 1, 2e-5);
  EXPECT_NEAR(course.largest_overlap / largest_overlap(), 1, 2e-5);
  EXPECT_NEAR(course.rebound / speed, 1, 2e-5);
  EXPECT_LT(course.balance, 2e-5);
}

TEST(HertzImpact, IsOfTheSecondOrder) {
  const double coarse = course_in(50).balance, fine = course_in(200).balance;
  EXPECT_LT(fine, coarse / 12) << "a sixteenth of it, but for how the first step falls";
}

// Where points have been in touch for a whole step, ω² of the next one is within the bound that its length was chosen
// by, however long it is: a tenth of the impact here.
TEST(HertzImpact, BoundOfTheStiffnessHoldsThroughTheNextStep) {
  Impact impact;
  const double dt = 0.1 * duration();
  int compared = 0;
  bool was_touching = false;
  for (double time = 0; time < gap / speed || impact.overlap() > 0; time += dt) {
    const double bound = impact.bound();
    const bool touches = impact.overlap() > 0;
    impact.step(dt);
    const double omega2 = 2 * impact.stiffness() / (density * h * h * h);
    if (was_touching && touches) {
      EXPECT_LE(omega2, bound) << "overlap " << impact.overlap();
      ++compared;
    }
    was_touching = touches;
  }
  EXPECT_GT(compared, 5);
}

// The tangent that equilibria take is the slope of the force.
TEST(HertzImpact, TangentIsTheSlopeOfTheForce) {
  Impact impact;
  while (impact.overlap() < 0.5 * largest_overlap()) impact.step(duration() / 400);
  const double k = law.tangent_stiffness({{h * h * h, h * h * h}, {2 * h, 2 * h}, h + gap, false}, impact.overlap());
  EXPECT_NEAR(impact.stiffness(), k, 1e-9 * k);  // the overlap is a small difference of places
}

TEST(HertzImpact, KeepsItsMomentum) {
  Impact impact;
  const Vector before = impact.momentum();
  for (int n = 0; n < 1500; ++n) impact.step(duration() / 400);
  EXPECT_LT(impact.overlap(), 0) << "they have met and parted";
  EXPECT_LT((impact.momentum() - before).norm(), 1e-13 * speed);
}

}  // namespace
}  // namespace strut::contact

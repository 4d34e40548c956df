// Equilibria against closed forms, and the tangent against differences of the forces.
#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.hpp"
#include "lattice.hpp"
#include "solvers/quasi_static.hpp"

namespace strut {
namespace {

constexpr double young = 1e9, poisson = 0.3, yield = 5e6;  // Pa

materials::AnyLaw plastic() {
  const auto moduli = std::get<materials::Elastic>(elastic(young, poisson));
  return materials::J2{moduli.bulk, moduli.shear, {yield, materials::LinearHardening{1e8}, materials::NoRate{}}};
}

BlockMaterial material(materials::AnyLaw law) {
  return {.density = 1000, .law = std::move(law), .mean_stabilization = 0.01};
}

std::vector<int> points_where(const Body& body, const std::function<bool(const Vector&)>& where) {
  std::vector<int> points;
  for (int i = 0; i < body.owned(); ++i) {
    if (where(body.domain.positions[i])) points.push_back(i);
  }
  return points;
}

struct Case {
  const char* name;
  bool is_plastic;
  FamilyKind families;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class Tangent : public testing::TestWithParam<Case> {};

TEST_P(Tangent, IsTheDerivativeOfTheForces) {
  const Communicator world;
  LatticeSpec spec{{5, 6, 7}, 1e-3, 1.75};
  spec.material = material(GetParam().is_plastic ? plastic() : elastic(young, poisson));
  spec.families = GetParam().families;
  Body body = lattice_body(spec, world);
  Equilibrium equilibrium(body, {}, {});
  equilibrium.begin(0, 1);
  const auto bent = [](const Vector& X) -> Vector {
    const double turn = 30 * X[2];
    return {X[0] * std::cos(turn) - X[1] * std::sin(turn), X[0] * std::sin(turn) + 1.03 * X[1] * std::cos(turn),
            0.9 * X[2] + 20 * X[0] * X[1]};
  };
  const auto forces_at = [&](double h, const Field& direction) {
    deform(body, bent);
    for (int i = 0; i < body.owned(); ++i) body.sites[i].current.head<3>() += h * direction[i].array();
    EXPECT_FALSE(equilibrium.evaluate().failed);
    return equilibrium.residual();
  };
  Field direction(body.owned()), product(body.owned());
  for (int i = 0; i < body.owned(); ++i) {
    const Vector X = 1e3 * body.domain.positions[i];
    direction[i] = Vector(std::sin(2 * X[1]), std::cos(X[0] + 3 * X[2]), std::sin(X[0] * X[1]));
  }
  // Central differences: the third derivative of the forces over ξ³ times h² is some 1e-8 of the first.
  const double h = 1e-7;
  const Field above = forces_at(h, direction), below = forces_at(-h, direction);
  forces_at(0, direction);
  equilibrium.linearise();
  equilibrium.apply(direction, product);
  const double scale = largest_over(body, [&](int i) { return product[i].norm(); });
  const double error = largest_over(body, [&](int i) { return ((above[i] - below[i]) / (2 * h) + product[i]).norm(); });
  EXPECT_GT(scale, 0);
  EXPECT_LT(error, 1e-5 * scale);
}

INSTANTIATE_TEST_SUITE_P(Laws, Tangent,
                         testing::Values(Case{"elastic_lists", false, FamilyKind::lists},
                                         Case{"elastic_lattice", false, FamilyKind::stencil},
                                         Case{"plastic_lists", true, FamilyKind::lists}),
                         [](const auto& info) { return std::string(info.param.name); });

const Audience to_screen{[](const std::string& line) { std::cout << line << "\n"; }, {}, [] { return false; }};

// A bar along z, its lower end on a plane, its upper end moved.
struct Bar {
  Communicator world;
  LatticeSpec spec{{4, 4, 12}, 1e-3, 1.75};
  Conditions conditions;
  Body body;

  Bar(materials::AnyLaw law, double strain)
      : body(lattice_body((spec.material = material(std::move(law)), spec), world)) {
    const double first = 0.5e-3, last = 11.5e-3;
    const auto low = points_where(body, [=](const Vector& X) { return X[2] < first + 1e-6; });
    const auto high = points_where(body, [=](const Vector& X) { return X[2] > last - 1e-6; });
    const auto middle = [](const Vector& X) { return X[0] < 2e-3 && X[1] < 2e-3; };
    conditions.motions.push_back({low, 2, Function(0), false});
    conditions.motions.push_back({high, 2, Function::parse(std::to_string(strain * (last - first)) + " * t"), false});
    const auto axis = points_where(body, [&](const Vector& X) { return middle(X) && X[0] > 1e-3 && X[1] > 1e-3; });
    conditions.symmetry_planes.push_back({axis, Vector::UnitX()});
    conditions.symmetry_planes.push_back({axis, Vector::UnitY()});
  }
};

TEST(QuasiStaticBar, Stretches) {
  Bar bar(elastic(young, poisson), 0.01);
  QuasiStatic solver(bar.body, bar.conditions, {}, {.load_steps = 2}, 0, 1, to_screen);
  while (solver.time() < 1) solver.advance();
  const double stress = young * std::log(1.01);
  EXPECT_LT(largest_over(bar.body, [&](int i) { return std::abs(bar.body.points[i].stress[2] - stress); }),
            0.2 * stress);
  std::cout << solver.ledger().balance_error << " " << solver.ledger().elastic << "\n";
}

TEST(QuasiStaticBar, Flows) {
  Bar bar(plastic(), 0.05);
  QuasiStatic solver(bar.body, bar.conditions, {}, {.load_steps = 20}, 0, 1, to_screen);
  while (solver.time() < 1) solver.advance();
  std::cout << solver.ledger().balance_error << " " << solver.ledger().elastic << "\n";
}

}  // namespace
}  // namespace strut

#include "hexahedra.hpp"

#include <cmath>
#include <limits>

#include "base/errors.hpp"

namespace strut::reference {

namespace {

using small::lane_count;
using small::Lanes;
using Row = std::array<Lanes, 3>;
using Matrix = std::array<Row, 3>;
using Slopes = std::array<std::array<double, 3>, 8>;  // ∂N/∂ξ, [corner][axis]

constexpr double viscous = 0.06;  // linear bulk viscosity, as codes have it
// The step over edge/c of a cube: 0.71 is stable by the bound of single elements, and seven eighths of that are taken.
constexpr double step_of_cube = 0.62;

double sign_of(int corner, int axis) { return (corner >> axis & 1) == 0 ? -1 : 1; }

// At a place of the cube from −1 to 1.
Slopes slopes_at(const Vector& at) {
  Slopes slopes;
  for (int c = 0; c < 8; ++c) {
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, d = (a + 2) % 3;
      slopes[c][a] = sign_of(c, a) * (1 + sign_of(c, b) * at[b]) * (1 + sign_of(c, d) * at[d]) / 8;
    }
  }
  return slopes;
}

const Slopes& slopes_of_middle() {
  static const Slopes slopes = slopes_at(Vector::Zero());
  return slopes;
}

const std::array<Slopes, 8>& slopes_of_points() {
  static const std::array<Slopes, 8> slopes = [] {
    std::array<Slopes, 8> all;
    for (int p = 0; p < 8; ++p) all[p] = slopes_at(Vector(sign_of(p, 0), sign_of(p, 1), sign_of(p, 2)) / std::sqrt(3));
    return all;
  }();
  return slopes;
}

// Σ_c x_c slopes_c
template <class AtCorner>
Matrix sum(const SideVectors& x, const AtCorner& slopes) {
  Matrix J;
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < 3; ++a) {
      J[i][a] = x[0][i] * slopes[0][a];
      for (int c = 1; c < 8; ++c) J[i][a] += x[c][i] * slopes[c][a];
    }
  }
  return J;
}

// ∂N/∂x into b; the determinant of ∂x/∂ξ.
Lanes gradients(const SideVectors& x, const Slopes& slopes, SideVectors& b) {
  const Matrix J = sum(x, slopes);
  Matrix K;  // K[a][i] = det · ∂ξ_a/∂x_i
  for (int a = 0; a < 3; ++a) {
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3, d = (a + 1) % 3, e = (a + 2) % 3;
      K[a][i] = J[j][d] * J[k][e] - J[j][e] * J[k][d];
    }
  }
  const Lanes det = J[0][0] * K[0][0] + J[0][1] * K[1][0] + J[0][2] * K[2][0], inverse = 1 / det;
  for (auto& row : K) {
    for (Lanes& entry : row) entry *= inverse;
  }
  for (int c = 0; c < 8; ++c) {
    for (int i = 0; i < 3; ++i) {
      b[c][i] = slopes[c][0] * K[0][i] + slopes[c][1] * K[1][i] + slopes[c][2] * K[2][i];
    }
  }
  return det;
}

Lanes sum_of_squares(const SideVectors& b) {
  Lanes sum = Lanes::Zero();
  for (const Row& gradient : b) {
    for (const Lanes& entry : gradient) sum += entry.square();
  }
  return sum;
}

double steepest(const Lanes& squares, const Lanes& det) {
  return (det > 0).all() ? squares.maxCoeff() : std::numeric_limits<double>::infinity();
}

// (1 − W/2)⁻¹ (1 + W/2) of the skew part W.
Matrix rotation_of(const Matrix& L) {
  const Row w = {0.25 * (L[2][1] - L[1][2]), 0.25 * (L[0][2] - L[2][0]), 0.25 * (L[1][0] - L[0][1])};
  const Lanes square = w[0].square() + w[1].square() + w[2].square(), factor = 2 / (1 + square);
  Matrix Q;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    Q[i][i] = 1 + factor * (w[i].square() - square);
    Q[i][j] = factor * (w[i] * w[j] - w[k]);
    Q[j][i] = factor * (w[i] * w[j] + w[k]);
  }
  return Q;
}

Lanes trace(const Matrix& A) { return A[0][0] + A[1][1] + A[2][2]; }

}  // namespace

Hexahedra::Hexahedra(const Impact& impact, const IdealMetal& metal, double hourglass)
    : lambda_(metal.young * metal.poisson / ((1 + metal.poisson) * (1 - 2 * metal.poisson))),
      mu_(metal.young / (2 * (1 + metal.poisson))),
      density_(metal.density),
      yield_(metal.yield_stress),
      hourglass_(hourglass),
      speed_(std::sqrt((lambda_ + 2 * mu_) / density_)),
      held_(impact.held),
      masses_(masses_of(impact.body, metal.density)),
      steepest_(1.5 / std::pow(impact.body.edge, 2)) {
  const VoxelMesh& body = impact.body;
  if (body.voxels.empty()) throw Error("there is no element");
  for (std::size_t n = 0; n < body.nodes.size(); ++n) {
    places_.emplace_back(body.nodes[n][0], body.nodes[n][1], body.nodes[n][2], 0);
    velocities_.emplace_back(impact.velocities[n][0], impact.velocities[n][1], impact.velocities[n][2], 0);
  }
  const auto spare = static_cast<int>(places_.size());  // a cube for lanes without an element
  for (int c = 0; c < 8; ++c) {
    places_.emplace_back(body.edge * Eigen::Array4d(c & 1, c >> 1 & 1, c >> 2, 0));
    velocities_.emplace_back(Eigen::Array4d::Zero());
  }
  forces_.resize(places_.size());
  Matrix none;
  for (Row& row : none) row.fill(Lanes::Zero());
  for (std::size_t first = 0; first < body.voxels.size(); first += lane_count) {
    Group group{{}, std::vector<Tensor>(hourglass > 0 ? 1 : 8, none), {none[0], none[0], none[0], none[0]}};
    for (int c = 0; c < 8; ++c) {
      for (int l = 0; l < lane_count; ++l) {
        group.nodes[c][l] = first + l < body.voxels.size() ? body.voxels[first + l][c] : spare + c;
      }
    }
    groups_.push_back(std::move(group));
  }
}

Lanes Hexahedra::viscosity(const Lanes& volume, const Lanes& dilatation, double dt) const {
  return viscous * density_ * speed_ * volume.pow(1.0 / 3) * dilatation / dt;
}

void Hexahedra::update(Tensor& stress, const Tensor& increment, const Tensor& rotation) const {
  Tensor half, trial;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      half[i][j] = rotation[i][0] * stress[0][j] + rotation[i][1] * stress[1][j] + rotation[i][2] * stress[2][j];
    }
  }
  const Lanes dilatation = trace(increment);
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      trial[i][j] = half[i][0] * rotation[j][0] + half[i][1] * rotation[j][1] + half[i][2] * rotation[j][2] +
                    mu_ * (increment[i][j] + increment[j][i]);
    }
    trial[i][i] += lambda_ * dilatation;
  }
  const Lanes pressure = (trial[0][0] + trial[1][1] + trial[2][2]) / 3;
  for (int i = 0; i < 3; ++i) trial[i][i] -= pressure;
  const Lanes mises_square = 1.5 * (trial[0][0].square() + trial[1][1].square() + trial[2][2].square()) +
                             3 * (trial[0][1].square() + trial[0][2].square() + trial[1][2].square());
  const Lanes factor = yield_ / mises_square.max(yield_ * yield_).sqrt();
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) stress[i][j] = stress[j][i] = factor * trial[i][j];
    stress[i][i] += pressure;
  }
}

double Hexahedra::add_one_point(Group& group, double dt) {
  SideVectors u = taken(velocities_, group.nodes), x = taken(places_, group.nodes), b, f;
  for (int c = 0; c < 8; ++c) {
    for (int i = 0; i < 3; ++i) {
      u[c][i] *= dt;
      x[c][i] -= 0.5 * u[c][i];
    }
  }
  const Lanes volume = 8 * gradients(x, slopes_of_middle(), b);
  const Tensor L = sum(u, b), Q = rotation_of(L);
  Tensor& stress = group.stresses[0];
  update(stress, L, Q);
  const Lanes viscous_pressure = viscosity(volume, trace(L), dt);
  for (int c = 0; c < 8; ++c) {
    for (int i = 0; i < 3; ++i) {
      f[c][i] = volume *
                (stress[i][0] * b[c][0] + stress[i][1] * b[c][1] + stress[i][2] * b[c][2] + viscous_pressure * b[c][i]);
    }
  }
  const Lanes squares = sum_of_squares(b);
  const Lanes stiffness = hourglass_ * mu_ / 8 * volume * squares;
  for (int mode = 0; mode < 4; ++mode) {
    const auto pattern = [&](int c) {
      const double s[3] = {sign_of(c, 0), sign_of(c, 1), sign_of(c, 2)};
      return mode < 3 ? s[(mode + 1) % 3] * s[(mode + 2) % 3] : s[0] * s[1] * s[2];
    };
    Row along = {Lanes::Zero(), Lanes::Zero(), Lanes::Zero()};
    for (int c = 0; c < 8; ++c) {
      for (int i = 0; i < 3; ++i) along[i] += pattern(c) * x[c][i];
    }
    std::array<Lanes, 8> gamma;
    Row change = {Lanes::Zero(), Lanes::Zero(), Lanes::Zero()};
    for (int c = 0; c < 8; ++c) {
      gamma[c] = pattern(c) - along[0] * b[c][0] - along[1] * b[c][1] - along[2] * b[c][2];
      for (int i = 0; i < 3; ++i) change[i] += u[c][i] * gamma[c];
    }
    const Row before = group.hourglass[mode];
    for (int i = 0; i < 3; ++i) {
      Lanes& force = group.hourglass[mode][i];
      force = Q[i][0] * before[0] + Q[i][1] * before[1] + Q[i][2] * before[2] + stiffness * change[i];
      for (int c = 0; c < 8; ++c) f[c][i] += force * gamma[c];
    }
  }
  add_to_nodes(f, group.nodes, forces_);
  return steepest(squares, volume);
}

double Hexahedra::add_eight_points(Group& group, double dt) {
  SideVectors u = taken(velocities_, group.nodes), x = taken(places_, group.nodes), f, mean;
  std::array<SideVectors, 8> b;
  std::array<Lanes, 8> weights;
  for (int c = 0; c < 8; ++c) {
    for (int i = 0; i < 3; ++i) {
      u[c][i] *= dt;
      x[c][i] -= 0.5 * u[c][i];
      mean[c][i] = f[c][i] = Lanes::Zero();
    }
  }
  Lanes volume = Lanes::Zero(), dilatation = Lanes::Zero();
  for (int p = 0; p < 8; ++p) {
    weights[p] = gradients(x, slopes_of_points()[p], b[p]);
    volume += weights[p];
    for (int c = 0; c < 8; ++c) {
      for (int i = 0; i < 3; ++i) mean[c][i] += weights[p] * b[p][c][i];
    }
  }
  const Lanes inverse = 1 / volume;
  for (int c = 0; c < 8; ++c) {
    for (int i = 0; i < 3; ++i) {
      mean[c][i] *= inverse;
      dilatation += mean[c][i] * u[c][i];
    }
  }
  Lanes pull = volume * viscosity(volume, dilatation, dt);  // ∫ pressure dV, of tension
  for (int p = 0; p < 8; ++p) {
    Tensor L = sum(u, b[p]);
    const Lanes missing = (dilatation - trace(L)) / 3;
    for (int i = 0; i < 3; ++i) L[i][i] += missing;
    Tensor& stress = group.stresses[p];
    update(stress, L, rotation_of(L));
    const Lanes pressure = trace(stress) / 3;
    pull += weights[p] * pressure;
    Tensor deviator = stress;
    for (int i = 0; i < 3; ++i) deviator[i][i] -= pressure;
    for (int c = 0; c < 8; ++c) {
      for (int i = 0; i < 3; ++i) {
        f[c][i] +=
            weights[p] * (deviator[i][0] * b[p][c][0] + deviator[i][1] * b[p][c][1] + deviator[i][2] * b[p][c][2]);
      }
    }
  }
  for (int c = 0; c < 8; ++c) {
    for (int i = 0; i < 3; ++i) f[c][i] += pull * mean[c][i];
  }
  add_to_nodes(f, group.nodes, forces_);
  SideVectors middle;
  gradients(x, slopes_of_middle(), middle);
  Lanes least = weights[0];
  for (const Lanes& weight : weights) least = least.min(weight);
  return steepest(sum_of_squares(middle), least);
}

double Hexahedra::step() {
  const double dt = step_of_cube * std::sqrt(1.5 / steepest_) / speed_;
  if (!(dt > 0)) return 0;
  for (const HeldNode& held : held_) velocities_[held.node].head<3>() = held.velocity.array();
  for (std::size_t n = 0; n < places_.size(); ++n) places_[n] += dt * velocities_[n];
  for (Eigen::Array4d& force : forces_) force.setZero();
  steepest_ = 0;
  for (Group& group : groups_) {
    steepest_ = std::max(steepest_, hourglass_ > 0 ? add_one_point(group, dt) : add_eight_points(group, dt));
  }
  for (const HeldNode& held : held_) work_ += dt * held.velocity.dot(forces_[held.node].head<3>().matrix());
  for (Eigen::Index n = 0; n < masses_.size(); ++n) velocities_[n] -= dt / masses_[n] * forces_[n];
  return dt;
}

}  // namespace strut::reference

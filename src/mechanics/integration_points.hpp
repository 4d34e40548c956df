// The state of a material point, or of an integration point of its cell, that is kept between steps.
#pragma once

#include <array>
#include <type_traits>
#include <vector>

#include "base/fields.hpp"
#include "base/math/rotation.hpp"
#include "base/math/tensors.hpp"
#include "base/math/tiles.hpp"

namespace strut {

// Data that only the point itself reads.
struct MaterialPoint {
  Tensor deformation_gradient = Tensor::Identity();  // F
  Rotation rotation;                                 // R
  Symmetric stress = Symmetric::Zero();              // unrotated Cauchy stress, Pa
  double stabilization = 0;                          // C of the stabilization, Pa/m⁵
};

// The numbers of a material point, in the order of its parts.
template <class Point>
requires std::same_as<std::remove_const_t<Point>, MaterialPoint>
auto& number_of(Point& point, int n) {
  if (n < 9) return point.deformation_gradient.data()[n];
  if (n < 15) return point.rotation.number(n - 9);
  return n < 21 ? point.stress[n - 15] : point.stabilization;
}
inline std::vector<FieldPart> parts_of_material_point() {
  return {{.name = "deformation_gradient", .unit = "1", .meaning = "F", .persistent = true, .width = 9},
          {.name = "rotation", .unit = "1", .meaning = "R of F = V R, two columns", .persistent = true, .width = 6},
          {.name = "stress",
           .unit = "Pa",
           .meaning = "Rᵀ σ R",
           .persistent = true,
           .variable = "Unrotated_Cauchy_Stress",
           .width = 6},
          {.name = "stabilization",
           .unit = "Pa/m⁵",
           .meaning = "C of the stabilization; none is left of a failed point",
           .persistent = true,
           .width = 1}};
}

// The integration points of quadratic correspondence, in tiles: U, the six numbers of R, the stress. F = R U.
class CellPoints {
 public:
  static constexpr int rotation = 6, stress = 12, size = 18;  // offsets; count of all numbers
  static std::vector<FieldPart> parts() {
    return {{.name = "cell_stretch", .unit = "1", .meaning = "U of F = R U", .persistent = true, .width = rotation},
            {.name = "cell_rotation", .unit = "1", .meaning = "R", .persistent = true, .width = stress - rotation},
            {.name = "cell_stress", .unit = "Pa", .meaning = "Rᵀ σ R", .persistent = true, .width = size - stress}};
  }

  void resize(std::size_t places) { numbers_.assign(places, numbers_of(MaterialPoint())); }
  std::size_t places() const { return numbers_.size(); }
  MaterialPoint operator[](std::size_t index) const {
    MaterialPoint point;
    Symmetric stretch;
    for (int c = 0; c < 6; ++c) stretch[c] = numbers_.at(index, c);
    point.rotation = rotation_at(index);
    point.stress = stress_at(index);
    point.deformation_gradient = point.rotation.tensor() * to_tensor(stretch);
    return point;
  }
  Rotation rotation_at(std::size_t index) const {
    Rotation R;
    for (int c = 0; c < 6; ++c) R.number(c) = numbers_.at(index, rotation + c);
    return R;
  }
  Symmetric stress_at(std::size_t index) const {
    Symmetric of_point;
    for (int c = 0; c < 6; ++c) of_point[c] = numbers_.at(index, stress + c);
    return of_point;
  }
  void set(std::size_t index, const MaterialPoint& point) {
    const auto numbers = numbers_of(point);
    for (int n = 0; n < size; ++n) numbers_.at(index, n) = numbers[n];
  }
  double& at(std::size_t index, int n) { return numbers_.at(index, n); }
  double at(std::size_t index, int n) const { return numbers_.at(index, n); }
  small::Tiles& tiles() { return numbers_; }
  double bytes() const { return numbers_.bytes(); }

 private:
  static std::array<double, size> numbers_of(const MaterialPoint& point) {
    const Symmetric stretch = symmetric_part(point.rotation.tensor().transpose() * point.deformation_gradient);
    std::array<double, size> numbers;
    for (int c = 0; c < 6; ++c) {
      numbers[c] = stretch[c], numbers[rotation + c] = point.rotation.number(c), numbers[stress + c] = point.stress[c];
    }
    return numbers;
  }

  small::Tiles numbers_;
};

// Additional data of an ordinary point.
struct OrdinaryPoint {
  double weighted_volume = 0;  // m = Σ ω |ξ|² V = tr K, m⁵
  double dilatation = 0;       // θ
  double energy = 0;           // W, J/m³; current after a step with diagnostics

  static constexpr double OrdinaryPoint::*numbers[] = {&OrdinaryPoint::weighted_volume, &OrdinaryPoint::dilatation,
                                                       &OrdinaryPoint::energy};
  static std::vector<FieldPart> parts() {
    return {{.name = "weighted_volume", .unit = "m⁵", .meaning = "m", .width = 1},
            {.name = "dilatation", .unit = "1", .meaning = "θ", .persistent = true, .width = 1},
            {.name = "energy", .unit = "J/m³", .meaning = "W", .persistent = true, .width = 1}};
  }
};

// State of the artificial viscosity at an integration point.
struct ViscousPoint {
  double pressure = 0;  // J q of the last step, Pa
  double work = 0;      // dissipated so far, J per m³ of reference volume
  double damping = 0;   // fraction of the critical damping of the fastest wave between points
  double edge = 0;      // of a cube as large as the whole cell (a node on a symmetry plane has only a part of it), m

  static constexpr double ViscousPoint::*numbers[] = {&ViscousPoint::pressure, &ViscousPoint::work,
                                                      &ViscousPoint::damping, &ViscousPoint::edge};
  static std::vector<FieldPart> parts() {
    return {{.name = "viscous_pressure",
             .unit = "Pa",
             .meaning = "of the artificial viscosity, times J",
             .persistent = true,
             .variable = "Viscous_Pressure",
             .width = 1},
            {.name = "viscous_work",
             .unit = "J/m³",
             .meaning = "what the artificial viscosity has taken",
             .persistent = true,
             .variable = "Viscous_Work_Density",
             .width = 1},
            {.name = "viscous_damping",
             .unit = "1",
             .meaning = "part of the critical damping",
             .persistent = true,
             .width = 1},
            {.name = "edge", .unit = "m", .meaning = "of a cube as large as the cell", .width = 1}};
  }
};

}  // namespace strut

// The door of mechanics: from the places of the points to the force on each, by state-based peridynamics.
#pragma once

#include <optional>
#include <string>

#include "mechanics/body.hpp"

namespace strut {

struct PointTangent;

// A point at which a step went wrong.
struct Failure {
  int point;                                                 // owned, local index
  enum class Kind { not_finite, no_stress, inverted } kind;  // the worst first
};

// Leaves the worse of both in `worst`.
inline void take_worse(const std::optional<Failure>& other, std::optional<Failure>& worst) {
  if (other && (!worst || other->kind < worst->kind)) worst = other;
}

struct StepReport {
  double frequency_bound =
      0;  // 1/s, the largest of any point, as a part of its step: the critical time step shrinks with it
  // ζ, the largest part of the critical damping by viscosity: the critical time step is √(1 + ζ²) − ζ of that without.
  double damping = 0;
  std::optional<Failure> failure;  // the worst on this rank; its stress is the old one
};

// Collective. Advances F, R, stress and state from the last positions to the current ones (owned entries of sites) over
// dt. Halo exchanges run behind interior points. dt = 0 leaves stress and state alone. `with_diagnostics`: also what
// forces do not need but a look at the body does, the energy of the stabilization, and F, R and stress of ordinary
// points, which are a view of their families only. force_density is spoiled: on lattices it holds the pull of springs
// on their own points until the one sum_forces that is to follow.
StepReport advance_stress(Body& body, double dt, bool with_diagnostics);

// Collective; once after advance_stress. force_density, f = Σ {T − T'} V (internal force, N/m³); of a point that is
// stepped alone, the part of its stress that acts at the end of a whole step.
void sum_forces(Body& body, bool with_diagnostics);

// Both.
StepReport advance_stress_and_force(Body& body, double dt, bool with_diagnostics);

// The same for a step of any size, as an implicit solver takes it: rotations to round-off.
StepReport advance_by_any_step(Body& body, double dt, bool with_diagnostics);

// A bound of what the stress of block.points[k] adds to ω, roughly: √(M J V tr K⁻¹/(3ρ)) ‖F⁻¹‖, M = λ + 2μ; 1/s.
double frequency_bound(const Body& body, const MaterialBlock& block, int k);

// Of the points of a block on this rank, as parts of their steps.
double largest_frequency_bound(const Body& body, const MaterialBlock& block);

// Collective. The linearised operator in the current state, applied to a field: result = −f(v) (N/m⁴ times v's unit).
// `directions` holds v in the place of y: a copy of the body's sites, or these themselves where no block is ordinary.
// `tangents`: of the owned points by correspondence (tangent.hpp); if null, those of the elastic moduli, without the
// geometric stiffness (of the order stress/modulus), which is left out of ordinary points in any case.
// `scratch`: a copy of body.force_states, or these themselves: forces and the next stresses do without.
void apply_tangent(const Body& body, Halo& halo, std::vector<Site>& directions,
                   const std::vector<PointTangent>* tangents, ForceStates& scratch, std::vector<Vector>& result);

struct Energies {
  double elastic = 0, dissipated = 0, stabilization = 0;  // J
};

// Collective: sums over all ranks, after a step with_diagnostics.
Energies stored_energies(const Body& body);

// "element 17 of block foam, reference position (…) m, now at (…) m"
std::string locate(const Body& body, int i);

// The same, and what the failure is and its likely cause.
std::string describe(const Failure& failure, const Body& body);

}  // namespace strut

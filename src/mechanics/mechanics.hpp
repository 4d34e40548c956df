// Public header of mechanics: internal forces from the positions of the points, by state-based peridynamics; their
// linearization, frequency bounds and energies.
#pragma once

#include <vector>

#include "mechanics/energies.hpp"
#include "mechanics/step_report.hpp"

namespace strut {

enum class Part;
struct PointTangent;

// Interface by which a stress update breaks bonds; fracture implements it.
class BondBreaking {
 public:
  virtual ~BondBreaking() = default;

  // break_bonds is called before the stress update of a part of the points, count_dissipation after it. The step of dt
  // (s) ends at `time` (s); the neighbors' positions must be current.
  virtual void break_bonds(Body& body, Part part, double time, double dt) = 0;
  virtual void count_dissipation(Body& body, Part part) = 0;
  // Called after the stress update of all points.
  virtual void finish_step() = 0;
  // Called after the sum of forces if there are springs on the gradients of both ends.
  virtual void count_springs(Body& body) = 0;
};

// Collective. Advances F, R, stress and state from the last positions to the current ones (owned entries of sites) over
// dt (s); dt = 0 leaves stress and state unchanged. Halo exchanges overlap with interior points.
// `with_diagnostics`: also computes what only output needs: the energy of the stabilization, and F, R and stress
// of ordinary points. `time`: at the end of the step, s. `breaking`: breaks bonds if dt > 0. On return force_density
// has only the part by the points' own states: exactly one call of sum_forces must follow.
StepReport advance_stress(Body& body, double dt, bool with_diagnostics, double time = 0,
                          BondBreaking* breaking = nullptr);

// Collective; call it once after advance_stress. Completes force_density, f = Σ {T − T'} V (internal force, N/m³). The
// stress of a point with substeps counts with the fraction that acts at the end of a whole step.
void sum_forces(Body& body, bool with_diagnostics, BondBreaking* breaking = nullptr);

// Calls both.
StepReport advance_stress_and_force(Body& body, double dt, bool with_diagnostics, BondBreaking* breaking = nullptr);

// The same for an implicit step of any size: rotations are found to round-off.
StepReport advance_by_any_step(Body& body, double dt, double time, bool with_diagnostics,
                               BondBreaking* breaking = nullptr);

// ---- Linearized forces: for the critical time step and for Newton's iterations ----

// Collective. Applies the linearized operator in the current state to a field v: result = −f(v) (N/m⁴ times v's unit).
// `directions`: a copy of the body's sites that holds v in place of y.
// `tangents`: of the owned points by correspondence (tangent.hpp); null: those of the elastic moduli, without the
// geometric stiffness (of the order stress/modulus), which ordinary points never include.
// `scratch`: overwritten; a copy of body.force_states, or these themselves if no bond may break in the next step:
// breaks read the force states of the last sum of forces.
void apply_tangent(const Body& body, Halo& halo, std::vector<Site>& directions,
                   const std::vector<PointTangent>* tangents, ForceStates& scratch, std::vector<Vector>& result);

// ---- Upper bounds for the frequencies of points, which limit the critical time step ----

// Approximate bound for the part of block.points[k]'s stress in ω: √(M J V tr K⁻¹/(3ρ)) ‖F⁻¹‖, M = λ + 2μ; 1/s.
double frequency_bound(const Body& body, const MaterialBlock& block, int k);

// The bounds of all owned points, 1/s.
std::vector<double> frequency_bounds(const Body& body);

// The largest bound of a block's points on this rank, each times the point's fraction of the step, 1/s.
double largest_frequency_bound(const Body& body, const MaterialBlock& block);

}  // namespace strut

// Internal forces from the positions of the points, by state-based peridynamics.
#pragma once

#include "mechanics/bond_breaking.hpp"
#include "mechanics/step_report.hpp"

namespace strut {

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

}  // namespace strut

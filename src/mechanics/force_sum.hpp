// Inside mechanics: adds the part of each bond's force that depends on the state of its far end. The part by the
// point's own state is already in the force density (advance_stress).
#pragma once

#include <span>

#include "mechanics/formulation/quadratic_fits.hpp"
#include "mechanics/formulation/stress_pass.hpp"
#include "mechanics/kernels/ordinary_bonds.hpp"
#include "mechanics/kernels/quadratic_bonds.hpp"
#include "mechanics/passes.hpp"

namespace strut {

// Adds the forces of the springs on the residual z of both ends' gradients, in one pass over the bonds for each such
// stabilization. Their energy is ½ Σ V_i V_j ω ½ z·t, t the force of a bond. `u`: displacements of y, or of the field
// that replaces y in a tangent.
struct ResidualSum {
  const Body& body;
  Bodies bodies;
  Displacements u;
  ForceStates& states;
  std::vector<Vector>& result;  // N/m³; on entry, the part by the points' own states
  std::span<double> energy;     // of each point; not computed if empty

  void operator()(Part part) const {
    for_each_bond_stabilization([&]<class S>(const S&, std::size_t kind) { pass<S>(part, kind); });
  }

 private:
  template <class S>
  void pass(Part part, std::size_t kind) const {
    const auto sweep = [&](LatticeSums& sums, const LatticeSums::Take& take) {
      sums.residuals(kind, u, states.gradients, take);
    };
    over_blocks(body, bodies, part, sweep, [&](const MaterialBlock& block, const LaneGroups& groups) {
      if (block.material.stabilization.index() != kind) return;
      if (!block.has_springs(ResidualKind::both_gradients)) return;
      over_groups(body, groups, [&](const LaneGroup& group, auto weight) { add<S>(kind, group, weight); });
    });
  }

  template <class S, class Weight>
  void add(std::size_t kind, const LaneGroup& group, Weight weight) const {
    const bonds::Residual<small::Lanes> sums = residuals<S>(kind, group, u.sites, states.gradients, weight);
    for (int l = 0; l < group.count; ++l) {
      const int i = group.i[l];
      add_residual(at(sums.force, l), at(sums.moment, l), body.shape_inverse[i], body.first_moment[i],
                   states.tensors[i], result[i]);
    }
    if (energy.empty()) return;
    const small::Lanes energies = energies_of<S>(kind, group, weight);
    for (int l = 0; l < group.count; ++l) energy[group.i[l]] = energies[l];
  }

  template <class S, class Weight>
  small::Lanes energies_of(std::size_t kind, const LaneGroup& group, Weight weight) const {
    const GradientState* gradients = states.gradients.data();
    if (group.cluster) {
      return bonds::residual_energy<S>(kind, bonds::OfCluster{*group.cluster}, u.sites, gradients, weight);
    }
    small::Lanes energies = small::Lanes::Zero();
    for (int l = 0; l < group.count; ++l) {
      const bonds::OfPoint family{{group.i[l]}, body.domain.families};
      energies[l] = bonds::residual_energy<S>(kind, family, u.sites, gradients, weight);
    }
    return energies;
  }
};

// The force (N/m³) of the far ends of the bonds of a cluster's points, by quadratic correspondence. Whole steps,
// substeps and tangents use it with their own neighbor lists.
template <class Weight>
small::Vector3<small::Lanes> quadratic_far_forces(const Body& body, const Cluster& cluster, const ForceStates& states,
                                                  Weight weight) {
  return bonds::quadratic_far_force(bonds::OfCluster{cluster}, body.domain.sites.data(), body.fits->multipliers(),
                                    states.quadratics.data(), weight);
}

inline void add_to(const LaneGroup& group, const small::Vector3<small::Lanes>& force, std::vector<Vector>& result) {
  for (int l = 0; l < group.count; ++l) result[group.i[l]] += at(force, l);
}

// Adds the forces of the far ends of the bonds to `result` (N/m³; on entry, the part by the points' own states), for
// each formulation of a block's points or their neighbors. `u`: displacements of y, or of the field that replaces y in
// a tangent; `extension_of(family)`: extensions of bonds between ordinary points.
template <class ExtensionOf>
struct ForceSum {
  const Body& body;
  Bodies bodies;
  Displacements u;
  ExtensionOf extension_of;
  ForceStates& states;
  std::vector<Vector>& result;

  void correspondence(Part part) const {
    const bool with_springs = body.has_springs(ResidualKind::own_gradient);
    const auto sweep = [this](LatticeSums& sums, const LatticeSums::Take& take) {
      sums.forces(u, states.tensors, take);
    };
    over_blocks(body, bodies, part, sweep, [&](const MaterialBlock& block, const LaneGroups& groups) {
      if (!block.feels_correspondence) return;
      over_groups(body, groups, [&](const LaneGroup& group, auto weight) {
        add_to(group, far_forces(group, u, states.tensors, with_springs, weight), result);
      });
    });
  }

  void ordinary(Part part) const {
    for (const MaterialBlock& block : body.blocks) {
      if (!is_active(block, bodies) || !block.feels_ordinary) continue;
      over_groups(body, LaneGroups(body, block, part), [&](const LaneGroup& group, auto weight) {
        const bonds::OfCluster family{*group.cluster};
        const auto force = bonds::ordinary_force(family, body.domain.sites.data(), states.scalars.data(), weight,
                                                 extension_of(family));
        add_to(group, force, result);
      });
    }
  }

  void quadratic(Part part) const {
    for (const MaterialBlock& block : body.blocks) {
      if (!is_active(block, bodies) || !block.feels_quadratic) continue;
      over_groups(body, LaneGroups(body, block, part), [&](const LaneGroup& group, auto weight) {
        add_to(group, quadratic_far_forces(body, *group.cluster, states, weight), result);
      });
    }
  }
};

// Sums the forces formulation by formulation: over interior points while its states are exchanged, then over boundary
// points. `timed()`: returns a timer, which runs during one sum.
template <class ExtensionOf, class Timed>
void add_up(Halo& halo, const ForceSum<ExtensionOf>& sum, const Timed& timed) {
  const auto behind = [&]<class State>(std::vector<State>& states, void (ForceSum<ExtensionOf>::*over)(Part) const) {
    if (states.empty()) return;
    const auto run = [&](Part part) {
      [[maybe_unused]] const auto time = timed();
      (sum.*over)(part);
    };
    behind_exchange(halo, states, run);
  };
  behind(sum.states.tensors, &ForceSum<ExtensionOf>::correspondence);
  behind(sum.states.scalars, &ForceSum<ExtensionOf>::ordinary);
  behind(sum.states.quadratics, &ForceSum<ExtensionOf>::quadratic);
}

}  // namespace strut

#include "advice/advice.hpp"

#include "advice/checks.hpp"
#include "advice/lattice_axes.hpp"
#include "mechanics/thin_members.hpp"
#include "setup/blocks.hpp"
#include "setup/contact.hpp"

namespace strut {

namespace {

constexpr Check* checks[] = {  // in the order of their warnings
    without_effect, doubled_numbers, volumes_off_lattices, improbable_materials, unusual_springs,
    improbable_temperatures, improbable_scales, large_elastic_strains, sudden_stretches, overlaps, flat_families,
    unknown_gradients, unequal_horizons, points_off_lattices, contact_at_mirrors, filled_tools, thin_tools, apart_tools,
    meeting_tools, stopped_layers, overruled_motions, held_stretches, held_ends, thin_members, unlike_layers,
    unstrained_ends, cracks_of_plates, uneven_dilatation, oblong_cells, narrow_surfaces_of_nodes, sudden_failure,
    coarse_averages, noisy_cracks, gradual_cracks, late_breaks, soft_faces, breaks_under_pressure, improbable_stretches,
    bonded_contacts, bonded_gaps, surfaces_at_seams, undeclared_contacts, unheld_bodies, weak_contacts};

Situation situation_of(const deck::Deck& deck, const Scene& scene) {
  const PointCloud& cloud = scene.body.domain.cloud;
  const double start = deck.solver.initial_time, duration = deck.solver.final_time - start;
  return {deck,
          scene,
          start,
          duration,
          interactions_of(deck, scene.body),
          mean_spacings(cloud, scene.body.domain.communicator),
          trajectories(scene, start, duration),
          thicknesses(scene.body.domain),
          unevenness_of_lattices(scene.body)};
}

}  // namespace

Advice advice(const deck::Deck& deck, const Scene& scene) {
  const Situation situation = situation_of(deck, scene);
  Advice all{outline(situation), scene.warnings};
  for (Check* const check : checks) all.warnings += check(situation);
  return all;
}

}  // namespace strut

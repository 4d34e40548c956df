#include "mechanics/make_body.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "materials/state_variables.hpp"
#include "mechanics/formulation/quadratic_fits.hpp"
#include "mechanics/kernels/lane_groups.hpp"
#include "mechanics/steepness.hpp"
#include "topology/mirror_planes.hpp"
#include "topology/parallel_for.hpp"

namespace strut {

namespace {

template <class L>
std::vector<FieldPart> parts_of_state() {
  std::vector<FieldPart> parts;
  for (const std::string_view name : L::state_names) {
    const materials::StateVariable known = materials::state_variable(name);
    parts.push_back({.name = std::string(name),
                     .unit = std::string(known.unit),
                     .meaning = std::string(known.meaning),
                     .persistent = true,
                     .variable = std::string(name),
                     .width = 1});
  }
  return parts;
}

std::vector<MaterialBlock> blocks_of(const Domain& domain, const std::vector<BlockMaterial>& materials) {
  std::vector<MaterialBlock> blocks;
  for (std::size_t b = 0; b < materials.size(); ++b) {
    blocks.push_back({.name = domain.cloud.block_names[b], .material = materials[b]});
  }
  for (int i = 0; i < domain.owned; ++i) {
    MaterialBlock& block = blocks[domain.cloud.blocks[i]];
    block.points.push_back(i);
    if (i < domain.interior) ++block.interior;
  }
  std::size_t cells = 0;
  for (MaterialBlock& block : blocks) {
    const auto fresh_state = [&block]<class L>(const L& law) {
      block.state->assign(block.integration_points(), materials::to_columns<L>(materials::virgin_state_of(law)));
      block.state.set_parts(parts_of_state<L>());
    };
    std::visit(fresh_state, block.material.law);
    if (!block.points.empty() && !domain.families.lattice_of.empty()) {
      block.lattice = domain.families.lattice_of[block.points[0]];
    }
    if (block.is_ordinary()) block.ordinary.use(block.points.size());
    if (block.is_quadratic()) {
      block.cells.use(block.integration_points());
      block.flowed.use(block.points.size());
      block.shares_volume = materials::shares_volume(block.material.law);
    }
    block.first_integration_point = cells;
    cells += block.cells->places();
  }
  return blocks;
}

// True if a material has springs on the residual of both ends' gradients.
bool has_springs_in_bonds(const std::vector<BlockMaterial>& materials) {
  return std::any_of(materials.begin(), materials.end(), [](const BlockMaterial& m) {
    return residual_of(m.stabilization) == ResidualKind::both_gradients && coefficient_of(m.stabilization) > 0;
  });
}

// Zero states for the formulations that any block of the scene has, on this rank or another.
ForceStates zero_states(std::size_t points, const std::vector<BlockMaterial>& materials) {
  const auto any = [&materials](Formulation formulation) {
    return std::any_of(materials.begin(), materials.end(),
                       [formulation](const BlockMaterial& m) { return m.formulation == formulation; });
  };
  ForceStates states;
  if (any(Formulation::correspondence)) states.tensors.assign(points, bonds::force_state(Tensor::Zero(), 0));
  if (any(Formulation::ordinary)) states.scalars.resize(points);
  if (any(Formulation::quadratic)) states.quadratics.resize(points);
  if (has_springs_in_bonds(materials)) {  // undeformed, as bodies in rigid motion stay
    states.gradients.assign(points, bonds::gradient_state(Tensor::Identity(), 0, 0, NoStabilization()));
  }
  return states;
}

void set_shape(Body& body, MaterialBlock& block, int k, const Tensor& K, Symmetric& inverse) {
  const double modulus = materials::moduli_of(block.material.law).longitudinal();
  MaterialPoint& point = body.points[block.points[k]];
  inverse = block.is_ordinary() ? inverse_of(K) : symmetric_part(K.inverse());
  if (!inverse.allFinite()) inverse.setZero();  // of a cell that carries no stress
  if (block.lattice >= 0) {
    // Rounded, so that identical families share one entry. It multiplies displacements here, so the error is relative.
    const double size = trace(inverse);
    for (int c = 0; c < 6; ++c) inverse[c] = rounded(inverse[c], size, 44);
  }
  if (block.is_ordinary()) {
    // A point without neighbors has no force, whatever its weight: one that can be divided by.
    const double horizon = body.domain.horizon(block.points[k]),
                 alone = body.domain.volume(block.points[k]) * horizon * horizon;
    block.ordinary[k].weighted_volume = K.trace() > 0 ? K.trace() : alone;
  } else {
    point.stabilization = coefficient_of(block.material.stabilization) * modulus / (K.trace() / 3);
  }
}

// Constants of the families of owned points.
struct FamilySums {
  std::vector<Symmetric> shape_inverses;
  std::vector<Vector> first_moments;
};

void set_shapes(Body& body, MaterialBlock& block, const LaneGroups& groups, FamilySums& sums) {
  bonds::with_influence(body.influence, [&](auto weight) {
    for_each_point(0, groups.count(), [&, weight](int g) {
      const LaneGroup group = groups[g];
      const auto K = shapes(group, body.domain.sites.data(), weight);
      for (int l = 0; l < group.count; ++l) {
        set_shape(body, block, group.k[l], at(K, l), sums.shape_inverses[group.i[l]]);
      }
      if (!group.cluster) return;
      for (int l = 0; l < group.count; ++l) {
        const bonds::OfPoint family{{group.i[l]}, body.domain.families};
        sums.first_moments[group.i[l]] = bonds::first_moment(family, body.domain.sites.data(), weight);
      }
    });
  });
}

void set_shapes(Body& body) {
  const std::size_t owned = body.owned();
  FamilySums sums{std::vector<Symmetric>(owned, Symmetric::Zero()), std::vector<Vector>(owned, Vector::Zero())};
  for (MaterialBlock& block : body.blocks) {
    if (block.lattice >= 0) continue;
    for (const Part part : {Part::interior, Part::boundary}) {
      set_shapes(body, block, LaneGroups(body, block, part), sums);
    }
  }
  for (const LatticeFamilies& lattice : body.domain.families.lattices) {
    const auto set = [&, number = static_cast<int>(body.lattice_sums.size())](const LatticeSums::Chunk& chunk) {
      for (MaterialBlock& block : body.blocks) {
        if (block.lattice == number) set_shapes(body, block, LaneGroups(block, chunk), sums);
      }
    };
    body.lattice_sums.push_back(std::make_shared<LatticeSums>(body, lattice, set));
  }
  for (MaterialBlock& block : body.blocks) {
    if (block.lattice < 0) continue;
    for (const int i : block.points) sums.first_moments[i] = body.lattice_sums[block.lattice]->first_moment(i);
    if (!block.off_stencil.places.empty()) set_shapes(body, block, LaneGroups(block, block.off_stencil), sums);
  }
  body.shape_inverse = Deduplicated<Symmetric>(std::move(sums.shape_inverses));
  body.first_moment = Deduplicated<Vector>(std::move(sums.first_moments));
}

void set_what_blocks_feel(Body& body) {
  const ForceStates& states = body.force_states;
  if (states.scalars.empty() && states.quadratics.empty()) {
    for (MaterialBlock& block : body.blocks) block.feels_correspondence = true;
    return;
  }
  std::vector<Formulation> formulations(body.domain.sites.size());
  for (const MaterialBlock& block : body.blocks) {
    for (const int i : block.points) formulations[i] = block.material.formulation;
  }
  body.domain.halo.exchange(formulations);
  const Families& families = body.domain.families;
  for (MaterialBlock& block : body.blocks) {
    const auto feel = [&block](Formulation formulation) {
      if (formulation == Formulation::ordinary) block.feels_ordinary = true;
      if (formulation == Formulation::quadratic) block.feels_quadratic = true;
      if (formulation == Formulation::correspondence) block.feels_correspondence = true;
    };
    feel(block.material.formulation);
    if (block.lattice >= 0) continue;  // all blocks of its body are by correspondence
    for (const int i : block.points) families.for_each(i, [&](int j) { feel(formulations[j]); });
  }
}

// The part of a cell's edge over which the mean F of a point is measured. A flat family has its own frequencies far
// above those of waves between points, and viscosity by the whole edge would damp them by more than a step can follow.
double part_of_edge(const Domain& domain, const MaterialBlock& block, int i) {
  constexpr double usual = 2;
  const LatticeFamilies* stencil = domain.families.lattice(i);
  if (block.is_quadratic() || (stencil && stencil->spans_space(i))) return 1;
  return 1 / std::sqrt(std::max(1.0, flatness(domain, i) / usual));
}

void set_viscous(const Domain& domain, MaterialBlock& block) {
  block.viscous.use(block.integration_points());
  for (std::size_t k = 0; k < block.points.size(); ++k) {
    const int i = block.points[k];
    const double edge = part_of_edge(domain, block, i) * std::cbrt(coincident_images(domain, i) * domain.volume(i));
    for (int q = 0; q < block.points_per_cell(); ++q) block.viscous[block.index(k, q)].edge = edge;
  }
}

}  // namespace

Body make_body(Domain domain, Influence influence, const std::vector<BlockMaterial>& materials) {
  std::vector<MaterialBlock> blocks = blocks_of(domain, materials);
  Body body{.domain = std::move(domain), .influence = influence, .blocks = std::move(blocks)};
  for (MaterialBlock& block : body.blocks) set_off_stencil(body.domain, block);
  body.force_states = zero_states(body.domain.sites.size(), materials);
  const std::size_t owned = body.owned();
  body.fields.resize(owned);
  for (std::size_t i = 0; i < owned; ++i) body.density[i] = materials[body.domain.cloud.blocks[i]].density;
  if (has_springs_in_bonds(materials)) body.bond_work.use(owned);
  for (MaterialBlock& block : body.blocks) {
    if (block.material.formulation != Formulation::correspondence && block.lattice >= 0) {
      throw std::logic_error("a block that is not by correspondence must ask for lists");
    }
    if (block.material.viscosity.any()) set_viscous(body.domain, block);
  }
  set_shapes(body);
  set_what_blocks_feel(body);
  // Decided by the materials of all blocks, because a rank without points takes part, too.
  const auto is_quadratic = [](const BlockMaterial& m) { return m.formulation == Formulation::quadratic; };
  if (std::any_of(materials.begin(), materials.end(), is_quadratic)) {
    body.fits = std::make_shared<QuadraticFits>(body);
    make_consistent(body, *body.fits);
  }
  return body;
}

double footprint(const Body& body) {
  const Domain& domain = body.domain;
  constexpr std::size_t in_cloud = 2 * sizeof(std::int64_t) + sizeof(double) + sizeof(int) + sizeof(std::uint64_t);
  double bytes = static_cast<double>(sizeof(Site) * domain.sites.size() + in_cloud * domain.owned) +
                 body.force_states.bytes() + body.fields.bytes() + domain.families.bytes();
  for (const MaterialBlock& block : body.blocks) {
    bytes += block.fields.bytes() + static_cast<double>(block.points.size() * sizeof(int));
  }
  for (const auto& sums : body.lattice_sums) bytes += sums->bytes();
  if (body.fits) bytes += body.fits->bytes();
  return bytes;
}

void set_off_stencil(const Domain& domain, MaterialBlock& block) {
  block.off_stencil = {};
  if (block.lattice < 0 || domain.families.off_stencil.empty()) return;
  const ClusterLists& lists = domain.families.lists;
  for (std::size_t k = 0; k < block.points.size();) {
    if (!domain.families.is_off_stencil(block.points[k])) {
      ++k;
      continue;
    }
    const int c = lists.holding(block.points[k]);
    const Cluster cluster = lists[c];
    unsigned members = 0;
    for (; k < block.points.size() && block.points[k] <= cluster.points.back(); ++k) {
      if (!domain.families.is_off_stencil(block.points[k])) continue;
      block.off_stencil.places.push_back(static_cast<int>(k));
      members |= 1u << (block.points[k] - cluster.points[0]);
    }
    block.off_stencil.lists.append(cluster, members);
  }
}

materials::Moduli MaterialBlock::moduli(std::size_t index) const {
  return std::visit([&]<class L>(const L& law) { return materials::moduli_of(law, state_of<L>(index)); }, material.law);
}

template class FieldOf<std::vector<MaterialPoint>>;
template class FieldOf<Deduplicated<Symmetric>>;
template class FieldOf<Deduplicated<Vector>>;
template class FieldOf<std::vector<PointExpansion>>;
template class FieldOf<std::vector<Vector>>;
template class FieldOf<small::Tiles>;
template class FieldOf<CellPoints>;
template class FieldOf<std::vector<OrdinaryPoint>>;
template class FieldOf<std::vector<ViscousPoint>>;

}  // namespace strut

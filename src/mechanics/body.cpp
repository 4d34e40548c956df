#include "mechanics/body.hpp"

#include "mechanics/bonds.hpp"
#include "points/parallel.hpp"

namespace strut {

namespace {

std::vector<MaterialBlock> blocks_of(const Domain& domain, const std::vector<BlockMaterial>& materials) {
  std::vector<MaterialBlock> blocks;
  for (std::size_t b = 0; b < materials.size(); ++b) {
    blocks.push_back({domain.cloud.block_names[b], materials[b], {}, 0, {}});
  }
  for (int i = 0; i < domain.owned; ++i) {
    MaterialBlock& block = blocks[domain.cloud.blocks[i]];
    block.points.push_back(i);
    if (i < domain.interior) ++block.interior;
  }
  for (MaterialBlock& block : blocks) {
    const auto fresh_state = [&block]<class L>(const L&) {
      const auto columns = materials::to_columns<L>({});
      for (const double value : columns) block.state.insert(block.state.end(), block.points.size(), value);
    };
    std::visit(fresh_state, block.material.law);
  }
  return blocks;
}

std::vector<Site> undeformed_sites(const Domain& domain) {
  std::vector<Site> sites(domain.positions.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    sites[i].reference << domain.positions[i].array(), domain.volumes[i];
    sites[i].current << domain.positions[i].array(), domain.horizons[i];
  }
  return sites;
}

// K = Σ ω V ξ⊗ξ is what gather() finds in the undeformed state.
void set_shape(Body& body) {
  bonds::with_influence(body.influence, [&body](auto weight) {
    for_each_point(0, body.owned(), [&body, weight](int i) {
      const Tensor K = bonds::gather<false>(body.domain.families, body.sites.data(), i, weight).moment;
      const BlockMaterial& material = body.blocks[body.domain.cloud.blocks[i]].material;
      const double modulus = std::visit([](const auto& law) { return law.moduli().longitudinal(); }, material.law);
      body.points[i].shape_inverse = symmetric_part(K.inverse());
      body.points[i].stabilization = material.stabilization * modulus / (K.trace() / 3);
    });
  });
}

}  // namespace

Body make_body(Domain domain, Influence influence, const std::vector<BlockMaterial>& materials) {
  std::vector<MaterialBlock> blocks = blocks_of(domain, materials);
  std::vector<Site> sites = undeformed_sites(domain);
  Body body{.domain = std::move(domain),
            .influence = influence,
            .blocks = std::move(blocks),
            .sites = std::move(sites),
            .force_states = {},
            .points = {},
            .density = {},
            .velocity = {},
            .previous_velocity = {},
            .force_density = {},
            .stabilization_work = {}};
  const std::size_t owned = body.owned();
  body.force_states.resize(body.sites.size());
  body.points.resize(owned);
  for (const int block : body.domain.cloud.blocks) body.density.push_back(materials[block].density);
  body.velocity.assign(owned, Vector::Zero());
  body.previous_velocity.assign(owned, Vector::Zero());
  body.force_density.assign(owned, Vector::Zero());
  body.stabilization_work.assign(owned, 0);
  set_shape(body);
  return body;
}

Footprint footprint(const BlockMaterial& material) {
  const std::size_t state = std::visit([]<class L>(const L&) { return materials::state_size<L>; }, material.law);
  constexpr std::size_t mechanics =
      sizeof(Site) + sizeof(ForceState) + sizeof(MaterialPoint) + 3 * sizeof(Vector) + 2 * sizeof(double) + sizeof(int);
  constexpr std::size_t cloud = 2 * sizeof(std::int64_t) + 2 * sizeof(Vector) + 3 * sizeof(double) + sizeof(int) +
                                sizeof(std::uint64_t) + sizeof(std::size_t);
  return {static_cast<double>(mechanics + cloud + state * sizeof(double)), sizeof(int)};
}

}  // namespace strut

#include "topology/domain.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "base/errors.hpp"
#include "base/numbers.hpp"
#include "topology/bounding_box.hpp"
#include "topology/neighbors/stencils.hpp"
#include "topology/partition.hpp"

namespace strut {

namespace {

// Collective.
std::vector<BlockHorizons> block_horizons(const PointCloud& cloud, const std::vector<double>& horizons,
                                          const std::vector<BlockBonds>& bonds, const Communicator& communicator) {
  constexpr double none = -std::numeric_limits<double>::infinity();
  std::vector<double> bounds(3 * bonds.size(), none);  // per block: largest horizon; smallest one, negated; spacing
  for (std::size_t i = 0; i < horizons.size(); ++i) {
    double* of_block = &bounds[3 * cloud.blocks[i]];
    of_block[0] = std::max(of_block[0], horizons[i]);
    of_block[1] = std::max(of_block[1], -horizons[i]);
    of_block[2] = std::max(of_block[2], cloud.spacings[i]);
  }
  communicator.max(bounds);
  std::vector<BlockHorizons> blocks;
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const double* of_block = &bounds[3 * b];
    const bool empty = of_block[0] == none;
    blocks.push_back({empty ? 0 : -of_block[1], empty ? 0 : of_block[0], empty ? 0 : of_block[2], bonds[b].body});
  }
  return blocks;
}

// The cracks of each body: all cracks apply to all bodies, their mirror images only to the mirrored body.
std::vector<std::vector<Crack>> with_images(const std::vector<Crack>& cracks, const std::vector<BlockBonds>& bonds,
                                            const Images& images) {
  std::vector<std::vector<Crack>> all;
  for (const BlockBonds& block : bonds) {
    if (block.body >= static_cast<int>(all.size())) all.resize(block.body + 1, cracks);
  }
  for (int body = 0; body < static_cast<int>(all.size()); ++body) {
    for (const int image : images.of_body(body)) {
      for (const Crack& crack : cracks) all[body].push_back(image_of(crack, images[image]));
    }
  }
  return all;
}

// The order of points and ghosts in memory, as indices in the pool: owned points without ghosts in their family, then
// the other owned points, both by blocks and along the curve or their lattice; then the ghosts that are in a family, by
// id (so that the ranks that own them send runs of ids).
struct Order {
  std::vector<int> points, ghosts;
  std::size_t listed = 0;  // number of bonds of points with lists
  int interior = 0;
};

// Points by blocks; then those on lattices, by their cells.
std::vector<int> by_blocks(const Stencils& stencils, const std::vector<int>& blocks) {
  std::vector<int> points(blocks.size());
  std::iota(points.begin(), points.end(), 0);
  const auto place = [&](int i) {
    const int lattice = stencils.of[i];
    return std::pair(lattice, lattice < 0 ? blocks[i] : stencils.lattices[lattice].cell(i));
  };
  std::stable_sort(points.begin(), points.end(), [&](int a, int b) { return place(a) < place(b); });
  return points;
}

Order order_of(const Stencils& stencils, const Search& search, const CandidatePool& pool,
               const std::vector<int>& blocks) {
  Order order;
  const int owned = static_cast<int>(blocks.size());
  std::vector<char> needs_ghost(owned, 0), used(pool.ids.size(), 0);
  Eigen::AlignedBox3d others;
  for (std::size_t j = owned; j < pool.ids.size(); ++j) others.extend(pool.positions[j]);
  for (int i = 0; i < owned; ++i) {
    if (stencils.of[i] >= 0 && stencils.is_listed(i)) order.listed += stencils.lattices[stencils.of[i]].family_size(i);
    if (stencils.of[i] >= 0 && !(others.squaredExteriorDistance(pool.positions[i]) <= search.reach * search.reach))
      continue;
    for_each_neighbor(stencils, search, pool, i, [&](int j) {
      order.listed += stencils.of[i] < 0;
      if (j >= owned) needs_ghost[i] = used[j] = 1;
    });
  }
  order.points = by_blocks(stencils, blocks);
  const auto boundary =
      std::stable_partition(order.points.begin(), order.points.end(), [&](int i) { return !needs_ghost[i]; });
  order.interior = static_cast<int>(boundary - order.points.begin());
  for (int j = owned; j < static_cast<int>(pool.ids.size()); ++j) {
    if (used[j]) order.ghosts.push_back(j);
  }
  std::sort(order.ghosts.begin(), order.ghosts.end(), [&](int a, int b) { return pool.ids[a] < pool.ids[b]; });
  return order;
}

// The lists of the points that have them, in their order, with neighbors renumbered by local[], from a second pass over
// the grid. A cluster consists of consecutive points of one block, and of the interior or the boundary.
ClusterLists lists_of(const Stencils& stencils, const Search& search, const CandidatePool& pool,
                      const std::vector<int>& blocks, const Order& order, const std::vector<int>& local) {
  ClusterLists lists;
  lists.reserve(order.listed);
  ClusterLists::Builder builder(lists, pool.ids.size());
  const auto family = [&](int i, const auto& visit) { for_each_neighbor(search, pool, i, visit); };
  const std::span<const int> points(order.points);
  for (const auto part : {points.first(order.interior), points.subspan(order.interior)}) {
    for (auto begin = part.begin(); begin != part.end();) {
      const int kind = blocks[*begin];
      const bool is_listed = stencils.is_listed(*begin);
      const auto end = std::find_if(begin, part.end(),
                                    [&](int i) { return blocks[i] != kind || stencils.is_listed(i) != is_listed; });
      if (is_listed) builder.add_all({begin, end}, family, [&](int j) { return pool.ids[j]; });
      begin = end;
    }
  }
  lists.renumber(local);
  return lists;
}

// The points of a domain in their order: owned points and ghosts.
struct Members {
  std::vector<int> in_pool, local, bodies;  // local: of the pool's members, −1 if left out
  std::vector<Site> sites;
  std::vector<std::int64_t> ghost_ids;
  std::vector<int> ghost_owners;
};

Members members_of(const CandidatePool& pool, const Order& order, int owned) {
  Members members{.in_pool = order.points, .local = std::vector<int>(pool.ids.size(), -1)};
  members.in_pool.insert(members.in_pool.end(), order.ghosts.begin(), order.ghosts.end());
  members.sites.reserve(members.in_pool.size());
  for (const int p : members.in_pool) {
    members.local[p] = static_cast<int>(members.sites.size());
    Site& site = members.sites.emplace_back();
    site.reference << pool.positions[p].array(), pool.volumes[p];
    site.current << pool.positions[p].array(), pool.deltas[p];
    members.bodies.push_back(pool.bodies[p]);
    if (p < owned) continue;
    members.ghost_ids.push_back(pool.ids[p]);
    members.ghost_owners.push_back(pool.owners[p - owned]);
  }
  return members;
}

void add_lattices(const std::vector<LatticeFrame>& frames, const CandidatePool& pool, const Members& members, int owned,
                  Families& families) {
  if (frames.empty()) return;
  std::vector<Vector> positions;
  for (const int p : members.in_pool) positions.push_back(pool.positions[p]);
  Stencils own = stencils_of(frames, positions, members.bodies, owned);
  families.lattices = std::move(own.lattices);
  families.lattice_of = std::move(own.of);
  families.lattice_of.resize(owned);
  const auto loses = [](const LatticeFrame& frame) { return frame.loses_bonds; };
  if (std::none_of(frames.begin(), frames.end(), loses)) return;
  families.off_stencil.assign(owned, 0);
  for (int c = 0; c < families.lists.count(); ++c) {
    const Cluster cluster = families.lists[c];
    for (std::size_t l = 0; l < cluster.points.size(); ++l) {
      const int i = cluster.points[l];
      const LatticeFamilies* stencil = families.lattice(i);
      families.off_stencil[i] = stencil && stencil->family_size(i) > cluster.family_size(l);  // because of a crack
    }
  }
}

// The distance within which all neighbors are; blocks get horizons without the factors of searches.
double take_reach(std::vector<BlockHorizons>& blocks, const std::vector<BlockBonds>& bonds) {
  double reach = std::numeric_limits<double>::min();  // for a rank without points
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    reach = std::max(reach, blocks[b].largest * with_round_off);
    blocks[b].smallest /= bonds[b].search_factor(), blocks[b].largest /= bonds[b].search_factor();
  }
  return reach;
}

}  // namespace

Domain make_domain(PointCloud cloud, const std::vector<BlockBonds>& bonds, const Communicator& communicator,
                   const std::vector<Crack>& cracks, std::vector<Mirror> mirrors, std::vector<Period> periods) {
  const std::vector<double> own_horizons = horizons_of(cloud, bonds);
  std::vector<BlockHorizons> blocks = block_horizons(cloud, own_horizons, bonds, communicator);
  const double reach = take_reach(blocks, bonds);
  const int owned = static_cast<int>(cloud.size());
  std::stable_sort(mirrors.begin(), mirrors.end(), [](const Mirror& a, const Mirror& b) { return a.body < b.body; });
  const Mirrored all = mirrored(std::move(mirrors), periods, cloud, bonds, reach, communicator);
  const std::vector<Offered> offers = offered(cloud, bonds, all, reach);
  const CandidatePool pool = candidates_of(cloud, own_horizons, bonds, offers, reach, communicator);
  const std::vector<LatticeFrame> found =
      frames_with_images(lattice_frames(cloud, own_horizons, bonds, communicator), pool, owned, all, communicator);
  Stencils stencils = stencils_of(found, pool.positions, pool.bodies, owned);
  const std::vector<LatticeFrame> frames = chosen_frames(found, stencils, pool, owned, communicator);
  if (frames.size() < found.size()) stencils = stencils_of(frames, pool.positions, pool.bodies, owned);
  bool any_lists = false;
  for (std::size_t i = 0; i < stencils.of.size(); ++i) any_lists = any_lists || stencils.is_listed(static_cast<int>(i));
  const CellGrid grid(any_lists ? pool.positions : std::vector<Vector>(), reach);
  const LeftOut apart = left_out(cloud, bonds, all, offers, pool, grid, reach, communicator);
  const std::vector<std::vector<Crack>> all_cracks = with_images(cracks, bonds, all.images);
  const Search search{grid, apart, all_cracks, reach};
  const Order order = order_of(stencils, search, pool, cloud.blocks);
  PointCloud mine = reordered(cloud, order.points);
  mine.positions = {}, mine.volumes = {};
  Members members = members_of(pool, order, owned);
  Families families{.lists = lists_of(stencils, search, pool, cloud.blocks, order, members.local)};
  add_lattices(frames, pool, members, owned, families);
  Halo halo(communicator, mine.ids, members.ghost_ids, members.ghost_owners, all.images);
  return {communicator,
          std::move(mine),
          order.interior,
          owned,
          static_cast<int>(order.ghosts.size()),
          std::move(members.sites),
          std::move(blocks),
          std::move(families),
          std::move(halo),
          std::move(members.ghost_ids),
          separated_by_cracks(search, pool, order.points),
          all.mirrors,
          std::move(periods)};
}

Vector stretch_at(const std::vector<Period>& periods, double t) {
  Vector stretch = Vector::Ones();
  for (const Period& period : periods) {
    double& now = stretch[period.axis];
    now = period.stretch.evaluate(0, 0, 0, t);
    if (!(now > 0 && std::isfinite(now))) {
      throw Error(period.stretch.path() + ": '" + period.stretch.text() + "' is " + to_text(now) +
                  " at t = " + to_text(t) + " s; expected a stretch > 0");
    }
  }
  return stretch;
}

void Domain::stretch_sides(double t) { halo.set_stretch(stretch_at(periods, t)); }

PointCloud whole_cloud(const Domain& domain) {
  PointCloud cloud = domain.cloud;
  for (int i = 0; i < domain.owned; ++i) {
    cloud.positions.push_back(domain.reference(i));
    cloud.volumes.push_back(domain.volume(i));
  }
  return cloud;
}

double family_volume(const Domain& domain, int i) {
  double volume = 0;
  domain.families.for_each(i, [&](int j) { volume += domain.volume(j); });
  return volume;
}

std::size_t largest_whole_family(const Domain& domain) {
  std::size_t most = 0;
  for (int i = 0; i < domain.owned; ++i) {
    most = std::max(most, domain.families.size(i) + domain.families.broken[i].size());
  }
  return static_cast<std::size_t>(domain.communicator.max(static_cast<double>(most)));
}

Images images_of(const Domain& domain, double reach) {
  if (!domain.periods.empty()) return {domain.periods, reach};
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const Mirror& mirror : domain.mirrors) {
    Eigen::AlignedBox3d box;
    for (int i = 0; i < domain.owned; ++i) {
      if (domain.body_of(i) == mirror.body) box.extend(domain.reference(i));
    }
    boxes.push_back(common_box(box, domain.communicator));
  }
  return {domain.mirrors, boxes, reach};
}

Tensor family_spread(const Domain& domain, int i) {
  Tensor spread = Tensor::Zero();
  domain.families.for_each(i, [&](int j) {
    const Vector xi = domain.reference(j) - domain.reference(i);
    spread += domain.volume(j) * xi * xi.transpose();
  });
  return spread;
}

const char* degeneracy(std::size_t neighbors, const Tensor& spread) {
  if (neighbors < 4) return "fewer than four neighbors";
  const Eigen::SelfAdjointEigenSolver<Tensor> eigen(spread, Eigen::EigenvaluesOnly);
  // A flat family of a lattice has an exact zero; a strut one spacing wide and two long has about 1e-1.
  if (eigen.eigenvalues()[0] <= 1e-6 * eigen.eigenvalues()[2]) return "neighbors in one plane";
  return nullptr;
}

}  // namespace strut

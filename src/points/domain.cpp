#include "points/domain.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "base/errors.hpp"
#include "points/bounding_box.hpp"
#include "points/nearby_ranks.hpp"
#include "points/neighbors/cell_grid.hpp"
#include "points/neighbors/through_material.hpp"
#include "points/partition.hpp"

namespace strut {

namespace {

// A point that another rank may need, as it travels.
struct Candidate {
  double position[3];
  double volume, horizon;
  std::int64_t id;   // of an image: Images::id
  int block, owner;  // the rank
};

// The mirrors, and the images that they make.
struct Mirrored {
  std::vector<Mirror> mirrors;
  std::vector<Eigen::AlignedBox3d> boxes;  // of each mirror: that of its body
  Images images;
};

// Collective.
Mirrored mirrored(std::vector<Mirror> mirrors, const PointCloud& cloud, const std::vector<BlockBonds>& bonds,
                  double reach, const Communicator& communicator) {
  Mirrored result{.mirrors = std::move(mirrors)};
  for (const Mirror& mirror : result.mirrors) {
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (bonds[cloud.blocks[i]].body == mirror.body) box.extend(cloud.positions[i]);
    }
    result.boxes.push_back(common_box(box, communicator));
  }
  result.images = Images(result.mirrors, result.boxes, reach);
  return result;
}

// What others than the owner's own families may need of a point: itself (image 0) and its images.
struct Offered {
  int point, image;
  Vector place;
};

// Of the points of this rank, whose `reach` is the largest horizon.
std::vector<Offered> offered(const PointCloud& cloud, const std::vector<BlockBonds>& bonds, const Mirrored& mirrored,
                             double reach) {
  std::vector<Offered> all;
  for (int i = 0; i < static_cast<int>(cloud.size()); ++i) all.push_back({i, 0, cloud.positions[i]});
  for (std::size_t m = 0; m < mirrored.mirrors.size(); ++m) {
    const int body = mirrored.mirrors[m].body;
    if (m > 0 && mirrored.mirrors[m - 1].body == body) continue;  // they are sorted by bodies
    for (int i = 0; i < static_cast<int>(cloud.size()); ++i) {
      if (bonds[cloud.blocks[i]].body != body) continue;
      for (const int image : mirrored.images.of_body(body)) {
        const Vector place = mirrored.images[image](cloud.positions[i]);
        if (mirrored.boxes[m].squaredExteriorDistance(place) <= reach * reach) all.push_back({i, image, place});
      }
    }
  }
  return all;
}

// The records of what is offered to this rank, each of its place: what other ranks send, then images of its own points.
template <class Record>
std::vector<Record> received(const PointCloud& cloud, std::span<const Vector> places,
                             const std::vector<Record>& records, const std::vector<char>& is_image, double reach,
                             const Communicator& communicator) {
  const Eigen::AlignedBox3d box = box_around(cloud.positions);
  std::vector<Record> all = from_nearby_ranks<Record>(box, places, records, reach, communicator);
  if (box.isEmpty()) return all;
  for (std::size_t k = 0; k < records.size(); ++k) {
    if (is_image[k] && box.squaredExteriorDistance(places[k]) <= reach * reach) all.push_back(records[k]);
  }
  return all;
}

// Points of other ranks, and images, that lie within `reach` of the box of this rank's points.
std::vector<Candidate> candidates(const PointCloud& cloud, const std::vector<double>& horizons,
                                  const std::vector<Offered>& offers, double reach, const Communicator& communicator) {
  std::vector<Candidate> mine;
  std::vector<Vector> places;
  std::vector<char> is_image;
  for (const auto& [i, image, X] : offers) {
    mine.push_back({{X[0], X[1], X[2]},
                    cloud.volumes[i],
                    horizons[i],
                    Images::id(cloud.ids[i], image),
                    cloud.blocks[i],
                    communicator.rank()});
    places.push_back(X);
    is_image.push_back(image > 0);
  }
  return received(cloud, places, mine, is_image, reach, communicator);
}

// Owned points first, then candidates.
struct CandidatePool {
  std::vector<Vector> positions;
  std::vector<double> volumes;
  std::vector<std::int64_t> ids;
  std::vector<double> horizons;
  std::vector<int> bodies;
  std::vector<char> asks;      // for bonds through material, or (2) for those that touch
  std::vector<double> deltas;  // δ, m: horizons are those of the search
  std::vector<int> owners;     // the ranks of the candidates

  // A point on a symmetry plane, which has the half of its cell that is there, is where its image is.
  bool is_own_image(int i, int j, const Vector& xi) const {
    constexpr double round_off = 1e-8;  // of the horizon
    return ids[i] != ids[j] && Images::original(ids[i]) == Images::original(ids[j]) &&
           xi.squaredNorm() < round_off * round_off * horizons[i] * horizons[i];
  }
};

CandidatePool candidates_of(const PointCloud& cloud, const std::vector<double>& horizons,
                            const std::vector<BlockBonds>& bonds, const std::vector<Candidate>& others) {
  CandidatePool pool{cloud.positions, cloud.volumes, cloud.ids, horizons, {}, {}};
  const auto add_block = [&](int block) {
    pool.bodies.push_back(bonds[block].body);
    pool.asks.push_back(bonds[block].touching ? 2 : bonds[block].through_material ? 1 : 0);
    pool.deltas.push_back(pool.horizons[pool.deltas.size()] / bonds[block].search_factor());
  };
  for (const int block : cloud.blocks) add_block(block);
  for (const Candidate& c : others) {
    pool.positions.emplace_back(c.position[0], c.position[1], c.position[2]);
    pool.volumes.push_back(c.volume);
    pool.ids.push_back(c.id);
    pool.horizons.push_back(c.horizon);
    pool.owners.push_back(c.owner);
    add_block(c.block);
  }
  return pool;
}

std::vector<double> horizons_of(const PointCloud& cloud, const std::vector<BlockBonds>& bonds) {
  std::vector<double> horizons;
  horizons.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const BlockBonds& block = bonds[cloud.blocks[i]];
    horizons.push_back(block.search_factor() * block.horizon_at(cloud.spacings[i]));
  }
  return horizons;
}

// Collective.
std::vector<BlockHorizons> block_horizons(const PointCloud& cloud, const std::vector<double>& horizons,
                                          const std::vector<BlockBonds>& bonds, const Communicator& communicator) {
  constexpr double none = -std::numeric_limits<double>::infinity();
  std::vector<double> bounds(3 * bonds.size(), none);  // of each block the largest, the smallest, negated; the spacing
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

// Calls visit(j) for all that is within the horizon of pool member i.
template <class Visit>
void for_each_within(const CellGrid& grid, const CandidatePool& pool, int i, double reach, Visit&& visit) {
  const Vector here = pool.positions[i];
  grid.visit_near(here, [&](int j, const Vector& there) {
    const Vector xi = there - here;
    if (xi.squaredNorm() > reach * reach || j == i || pool.bodies[i] != pool.bodies[j]) return;
    if (pool.is_own_image(i, j, xi)) return;
    if (bonded(pool.horizons[i], pool.horizons[j], xi)) visit(j);
  });
}

// ---- Bonds through material ----------------------------------------------------------------------------------------

// Of each block: whether one of its body asks for it.
std::vector<char> concerned(const std::vector<BlockBonds>& bonds) {
  std::vector<char> blocks;
  for (const BlockBonds& block : bonds) {
    blocks.push_back(std::any_of(bonds.begin(), bonds.end(), [&](const BlockBonds& other) {
      return (other.through_material || other.touching) && other.body == block.body;
    }));
  }
  return blocks;
}

// Collective.
void check_through_material(const PointCloud& cloud, const std::vector<BlockBonds>& bonds,
                            const Communicator& communicator) {
  std::string problem;
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    if ((bonds[b].through_material || bonds[b].touching) && bonds[b].families != FamilyKind::lists) {
      throw std::logic_error("block '" + cloud.block_names[b] + "' asks for bonds through material without lists");
    }
  }
  for (std::size_t i = 0; i < cloud.size() && problem.empty(); ++i) {
    const BlockBonds& block = bonds[cloud.blocks[i]];
    if (!(block.through_material || block.touching) || (!cloud.joints.empty() && !cloud.joints[i].empty())) continue;
    problem = "block '" + cloud.block_names[cloud.blocks[i]] +
              "': its bonds shall run through material, but its points share nothing with each other; expected "
              "hexahedra or tetrahedra, not spheres or a text mesh";
  }
  raise_together(communicator, problem);
}

// A joint of a candidate, as it travels.
struct JointOf {
  std::int64_t id, joint;
};

// The joints of points and of their images.
class Joints {
 public:
  Joints(const PointCloud& cloud, const std::vector<BlockBonds>& bonds, const Mirrored& mirrored)
      : cloud_(cloud), bonds_(bonds), mirrored_(mirrored) {}

  // Calls visit(joint) for those of an image of point i. What lies on a symmetry plane is its own image.
  template <class Visit>
  void for_each(int i, int image, const Visit& visit) const {
    const int body = bonds_[cloud_.blocks[i]].body;
    const bool is_mirrored = !mirrored_.images.of_body(body).empty();
    for (const std::int64_t joint : cloud_.joints[i]) {
      const std::int64_t number = joint & ((std::int64_t{1} << first_plane_bit) - 1);
      if (!is_mirrored) {
        visit(number);
      } else if (cloud_.at == PointsAt::nodes) {  // joints are elements, none of which is its own image
        for_each_image_at(body, cloud_.positions[i], image, [&](int one) { visit(Images::id(number, one)); });
      } else {
        visit(Images::id(number, first_image(body, joint >> first_plane_bit, image)));
      }
    }
  }

 private:
  // Those that take X to the same place as `image` does.
  template <class Visit>
  void for_each_image_at(int body, const Vector& X, int image, const Visit& visit) const {
    const Images& images = mirrored_.images;
    const auto look_at = [&](int one) {
      if (is_same(images[one](X), images[image](X))) visit(one);
    };
    look_at(0);
    for (const int one : images.of_body(body)) look_at(one);
  }
  // The first of those that differ from `image` by reflections about some planes.
  int first_image(int body, std::int64_t planes, int image) const {
    std::vector<Reflection> alike{mirrored_.images[image]};
    int first = image;
    for (std::size_t n = 0; n < alike.size(); ++n) {
      first = std::min(first, number_of(body, alike[n], image));
      for (const Mirror& mirror : mirrored_.mirrors) {
        if (mirror.body != body || (planes >> mirror.bit & 1) == 0) continue;
        const Reflection next = alike[n].after(Reflection::by(mirror));
        const auto is_next = [&](const Reflection& one) { return is_same(one, next); };
        if (std::none_of(alike.begin(), alike.end(), is_next)) alike.push_back(next);
      }
    }
    return first;
  }
  // `otherwise`: where it is out of reach.
  int number_of(int body, const Reflection& reflection, int otherwise) const {
    if (is_same(reflection, Reflection())) return 0;
    for (const int one : mirrored_.images.of_body(body)) {
      if (is_same(reflection, mirrored_.images[one])) return one;
    }
    return otherwise;
  }
  bool is_same(const Vector& a, const Vector& b) const { return (a - b).norm() < 1e-9 * size_; }
  bool is_same(const Reflection& a, const Reflection& b) const {
    return (a.turn - b.turn).norm() < 1e-9 && is_same(a.shift, b.shift);
  }

  const PointCloud& cloud_;
  const std::vector<BlockBonds>& bonds_;
  const Mirrored& mirrored_;
  double size_ = mirrored_.boxes.empty() ? 0 : mirrored_.boxes.front().sizes().norm();
};

// Each joint with a pool member that has it, of some blocks. Collective: the candidates' come from their owners, which
// go through the same offers in the same order as for the candidates themselves.
std::vector<std::pair<std::int64_t, int>> joints_of(const PointCloud& cloud, const std::vector<char>& blocks,
                                                    const CandidatePool& pool, const Joints& all,
                                                    const std::vector<Offered>& offers, double reach,
                                                    const Communicator& communicator) {
  std::vector<std::pair<std::int64_t, int>> joints;
  std::vector<Vector> places;
  std::vector<JointOf> mine;
  std::vector<char> is_image;
  for (const auto& [i, image, place] : offers) {
    if (cloud.joints.empty() || !blocks[cloud.blocks[i]]) continue;
    all.for_each(i, image, [&](std::int64_t joint) {
      if (image == 0) joints.emplace_back(joint, i);
      places.push_back(place);
      mine.push_back({Images::id(cloud.ids[i], image), joint});
      is_image.push_back(image > 0);
    });
  }
  std::size_t member = cloud.size();
  for (const JointOf& one : received(cloud, places, mine, is_image, reach, communicator)) {
    while (pool.ids[member] != one.id) ++member;
    joints.emplace_back(one.joint, static_cast<int>(member));
  }
  return joints;
}

// Whom an owned point is not bonded to although it is within the horizon. Empty where no block asks for it.
struct LeftOut {
  std::vector<std::size_t> start;
  std::vector<int> members;  // ascending for each point

  bool contains(int i, int j) const {
    if (start.empty()) return false;
    return std::binary_search(members.begin() + start[i], members.begin() + start[i + 1], j);
  }
};

LeftOut left_out_of(std::vector<std::pair<int, int>> pairs, int owned) {
  std::sort(pairs.begin(), pairs.end());
  LeftOut result{std::vector<std::size_t>(owned + 1, 0), {}};
  for (const auto& [i, j] : pairs) {
    ++result.start[i + 1];
    result.members.push_back(j);
  }
  std::partial_sum(result.start.begin(), result.start.end(), result.start.begin());
  return result;
}

// Collective.
LeftOut left_out(const PointCloud& cloud, const std::vector<BlockBonds>& bonds, const Mirrored& mirrored,
                 const std::vector<Offered>& offers, const CandidatePool& pool, const CellGrid& grid, double reach,
                 const Communicator& communicator) {
  const std::vector<char> blocks = concerned(bonds);
  if (std::find(blocks.begin(), blocks.end(), 1) == blocks.end()) return {};
  check_through_material(cloud, bonds, communicator);
  ThroughMaterial material({pool.positions, pool.horizons, pool.bodies},
                           joints_of(cloud, blocks, pool, Joints(cloud, bonds, mirrored), offers, reach, communicator));
  std::vector<std::pair<int, int>> pairs;
  std::vector<int> family, asked, apart;
  const int owned = static_cast<int>(cloud.size());
  for (int i = 0; i < owned; ++i) {
    if (!blocks[cloud.blocks[i]]) continue;
    family.clear(), asked.clear();
    for_each_within(grid, pool, i, reach, [&](int j) {
      family.push_back(j);
      if ((pool.asks[i] || pool.asks[j]) && j > i) asked.push_back(j);  // of two owned points one is enough
    });
    apart.clear();
    const auto by_touch = std::stable_partition(asked.begin(), asked.end(),
                                                [&](int j) { return std::max(pool.asks[i], pool.asks[j]) < 2; });
    std::copy_if(by_touch, asked.end(), std::back_inserter(apart), [&](int j) { return !material.touch(i, j); });
    asked.erase(by_touch, asked.end());
    if (!asked.empty()) {
      for (const int j : material.apart(i, family, asked)) apart.push_back(j);
    }
    for (const int j : apart) {
      pairs.emplace_back(i, j);
      if (j < owned) pairs.emplace_back(j, i);
    }
  }
  return left_out_of(std::move(pairs), owned);
}

// Where families are looked up that are no stencils.
struct Search {
  const CellGrid& grid;
  const LeftOut& left_out;
  const std::vector<std::vector<Crack>>& cracks;  // of each body
  double reach;

  bool is_cut(const CandidatePool& pool, int i, int j) const {
    const std::vector<Crack>& here = cracks[pool.bodies[i]];
    return std::any_of(here.begin(), here.end(),
                       [&](const Crack& crack) { return crosses(crack, pool.positions[i], pool.positions[j]); });
  }
};

// Calls visit(j) for the family of owned point i.
template <class Visit>
void for_each_neighbor(const Search& search, const CandidatePool& pool, int i, Visit&& visit) {
  for_each_within(search.grid, pool, i, search.reach, [&](int j) {
    if (!search.left_out.contains(i, j) && !search.is_cut(pool, i, j)) visit(j);
  });
}

// Of the owned points in their order, those who would be bonded but for a crack, as Domain has them.
std::vector<std::pair<int, std::int64_t>> parted_by_cracks(const Search& search, const CandidatePool& pool,
                                                           const std::vector<int>& order) {
  std::vector<std::pair<int, std::int64_t>> pairs;
  if (std::ranges::all_of(search.cracks, [](const std::vector<Crack>& of_body) { return of_body.empty(); }))
    return pairs;
  for (std::size_t local = 0; local < order.size(); ++local) {
    const int i = order[local];
    for_each_within(search.grid, pool, i, search.reach, [&](int j) {
      const Vector xi = pool.positions[j] - pool.positions[i];
      if (!bonded(pool.deltas[i], pool.deltas[j], xi) || search.left_out.contains(i, j)) return;
      if (search.is_cut(pool, i, j)) pairs.emplace_back(local, pool.ids[j]);
    });
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// ---- Stencils, order, lists ----------------------------------------------------------------------------------------

// The bodies that sit on a lattice, over the pool: who owns which cell, until points have their order in memory.
struct Stencils {
  std::vector<LatticeFamilies> lattices;
  std::vector<int> of;  // of pool members; −1: lists

  bool is_listed(int i) const { return of[i] < 0 || lattices[of[i]].frame().loses_bonds; }
};

Stencils stencils_of(const std::vector<LatticeFrame>& frames, const std::vector<Vector>& positions,
                     const std::vector<int>& bodies, int owned) {
  Stencils stencils{{}, std::vector<int>(positions.size(), -1)};
  for (const LatticeFrame& frame : frames) {
    std::vector<int> members;
    for (int i = 0; i < static_cast<int>(positions.size()); ++i) {
      if (bodies[i] != frame.body) continue;
      members.push_back(i);
      stencils.of[i] = static_cast<int>(stencils.lattices.size());
    }
    stencils.lattices.emplace_back(frame, positions, std::move(members), owned);
  }
  return stencils;
}

// What the bonds of a point take in a step, in ns, by tests/bench. A list costs by its entries, which the points of a
// cluster share. `pencils`: of the lattice a point.
double cost_of_list(double neighbors) { return 80 + 3.2 * std::pow(neighbors, 0.84); }
double cost_of_stencil(double rows, double pencils) { return 35 + (280 + 8 * rows) * pencils; }

// Whether sums by a lattice's stencil take less time than by lists. Of sums over the points of all ranks, so that all
// decide alike however many they are. A run of n points fills (n + 7)/8 pencils on average; families are counted of
// every 64th point.
bool is_faster(const LatticeFamilies& lattice, const CandidatePool& pool, int owned, const Communicator& communicator) {
  double counts[4] = {0, 0, 0, 0};  // points, runs, samples, their neighbors
  for (int i = 0; i < owned; ++i) {
    if (lattice.cell(i) < 0) continue;
    counts[0] += 1;
    counts[1] += lattice.begins_run(i) ? 1 : 0;
    if (pool.ids[i] % 64 != 0) continue;
    counts[2] += 1;
    counts[3] += static_cast<double>(lattice.family_size(i));
  }
  communicator.sum(counts);
  const double pencils = (1 + 7 * counts[1] / counts[0]) / 8;
  return cost_of_stencil(static_cast<double>(lattice.rows().size()), pencils) <=
         cost_of_list(counts[3] / std::max(1.0, counts[2]));
}

// Calls visit(j) for the family of owned point i, by its stencil or by a search.
template <class Visit>
void for_each_neighbor(const Stencils& stencils, const Search& search, const CandidatePool& pool, int i,
                       Visit&& visit) {
  if (stencils.of[i] >= 0) {
    stencils.lattices[stencils.of[i]].for_each(i, visit);
  } else {
    for_each_neighbor(search, pool, i, visit);
  }
}

// The order in which points and ghosts stand in memory, as places in the pool: owned points without ghosts in their
// family first, then the others, both by blocks and along the curve, or as they lie in their lattice; then the ghosts
// that are in some family, ordered by id (ranks that own them send runs of ids).
struct Order {
  std::vector<int> points, ghosts;
  std::size_t listed = 0;  // bonds of points that have lists
  int interior = 0;
};

// Points on lattices by their cells, after all others, which are by blocks.
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

// Lists of the points that have them, in their order, neighbors by local[], from a second look at the grid. A cluster
// is of points that follow upon each other, of one block, and of the interior or the boundary.
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

}  // namespace

BondCosts bond_costs(const PointCloud& cloud, const std::vector<BlockBonds>& bonds, const std::vector<double>& spacings,
                     const Communicator& communicator) {
  constexpr double pencils = 1.0 / 6;  // of a lattice a point: between a full block's eighth and a foam's fifth
  const std::vector<LatticeFrame> frames = lattice_frames(cloud, horizons_of(cloud, bonds), bonds, communicator);
  BondCosts costs;
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const double reach = spacings[b] > 0 ? bonds[b].horizon_at(spacings[b]) / spacings[b] : 0;
    const double list = cost_of_list(4.0 / 3 * std::numbers::pi * std::pow(reach, 3));
    const double stencil = cost_of_stencil(std::numbers::pi * reach * reach, pencils);
    const auto here = [&](const LatticeFrame& frame) { return frame.body == bonds[b].body; };
    const bool by_stencil = stencil < list && std::any_of(frames.begin(), frames.end(), here);
    costs.of_block.push_back(by_stencil ? stencil : list);
    costs.by_stencils = costs.by_stencils || by_stencil;
  }
  return costs;
}

namespace {

// Lattices that are faster than lists, or asked for.
std::vector<LatticeFrame> chosen_frames(const std::vector<LatticeFrame>& found, const Stencils& stencils,
                                        const CandidatePool& pool, int owned, const Communicator& communicator) {
  std::vector<LatticeFrame> chosen;
  for (std::size_t l = 0; l < found.size(); ++l) {
    if (found[l].wanted || is_faster(stencils.lattices[l], pool, owned, communicator)) chosen.push_back(found[l]);
  }
  return chosen;
}

// Those of lattices on which the images of their points are, too, with room for these; images on the cells of points
// are none. Collective.
std::vector<LatticeFrame> frames_with_images(const std::vector<LatticeFrame>& found, const CandidatePool& pool,
                                             int owned, const Mirrored& mirrored, const Communicator& communicator) {
  std::vector<LatticeFrame> frames;
  for (LatticeFrame frame : found) {
    bool fits = true;
    if (!mirrored.images.of_body(frame.body).empty()) {
      frame.make_room();
      for (std::size_t j = owned; j < pool.ids.size(); ++j) {
        if (pool.bodies[j] == frame.body && Images::image(pool.ids[j]) > 0) fits = fits && frame.has(pool.positions[j]);
      }
      for (const Mirror& mirror : mirrored.mirrors) {
        if (mirror.body != frame.body) continue;
        for (int i = 0; i < owned; ++i) {
          fits = fits && (pool.bodies[i] != frame.body ||
                          std::abs(mirror.distance(pool.positions[i])) > 0.25 * frame.spacing.minCoeff());
        }
      }
    }
    if (communicator.max(fits ? 0.0 : 1.0) == 0) frames.push_back(frame);
  }
  return frames;
}

// Cracks cut all bodies, their images the body that is mirrored. By body.
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

// The points of a domain in their order, owned ones and ghosts.
struct Members {
  std::vector<int> in_pool, local, bodies;  // local: of the pool's members, −1 of those that are left out
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
      families.off_stencil[i] = stencil && stencil->family_size(i) > cluster.family_size(l);  // for a crack
    }
  }
}

}  // namespace

Domain make_domain(PointCloud cloud, const std::vector<BlockBonds>& bonds, const Communicator& communicator,
                   const std::vector<Crack>& cracks, std::vector<Mirror> mirrors) {
  const std::vector<double> own_horizons = horizons_of(cloud, bonds);
  std::vector<BlockHorizons> blocks = block_horizons(cloud, own_horizons, bonds, communicator);
  double reach = std::numeric_limits<double>::min();  // where there is no point
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    reach = std::max(reach, blocks[b].largest * (1 + 1e-9));
    blocks[b].smallest /= bonds[b].search_factor(), blocks[b].largest /= bonds[b].search_factor();
  }
  const int owned = static_cast<int>(cloud.size());
  std::stable_sort(mirrors.begin(), mirrors.end(), [](const Mirror& a, const Mirror& b) { return a.body < b.body; });
  const Mirrored all = mirrored(std::move(mirrors), cloud, bonds, reach, communicator);
  const std::vector<Offered> offers = offered(cloud, bonds, all, reach);
  const CandidatePool pool =
      candidates_of(cloud, own_horizons, bonds, candidates(cloud, own_horizons, offers, reach, communicator));
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
  const int ghosts = static_cast<int>(order.ghosts.size());
  return {communicator,
          std::move(mine),
          order.interior,
          owned,
          ghosts,
          std::move(members.sites),
          std::move(blocks),
          std::move(families),
          std::move(halo),
          std::move(members.ghost_ids),
          parted_by_cracks(search, pool, order.points),
          all.mirrors};
}

PointCloud whole_cloud(const Domain& domain) {
  PointCloud cloud = domain.cloud;
  for (int i = 0; i < domain.owned; ++i) {
    cloud.positions.push_back(domain.reference(i));
    cloud.volumes.push_back(domain.volume(i));
  }
  return cloud;
}

std::size_t Families::bonds() const {
  std::size_t count = 0;
  for (int b = 0; b < lists.count(); ++b) {
    const Cluster cluster = lists[b];
    for (std::size_t n = 0; n < cluster.near.size(); ++n) count += std::popcount(cluster.mask[n]);
  }
  for (const LatticeFamilies& stencil : lattices) {
    if (stencil.frame().loses_bonds) continue;  // they are in lists
    for (std::size_t i = 0; i < lattice_of.size(); ++i) {
      if (stencil.cell(static_cast<int>(i)) >= 0) count += stencil.family_size(static_cast<int>(i));
    }
  }
  return count;
}

double Families::bytes() const {
  double sum = lists.bytes();
  for (const LatticeFamilies& stencil : lattices) sum += stencil.bytes();
  return sum;
}

double family_volume(const Domain& domain, int i) {
  double volume = 0;
  domain.families.for_each(i, [&](int j) { volume += domain.volume(j); });
  return volume;
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

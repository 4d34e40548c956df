#include "topology/neighbors/search.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "base/errors.hpp"
#include "topology/neighbors/visibility.hpp"

namespace strut {

namespace {

// True for each block of a body in which a block asks for visibility.
std::vector<char> concerned(const std::vector<BlockBonds>& bonds) {
  std::vector<char> blocks;
  for (const BlockBonds& block : bonds) {
    blocks.push_back(std::any_of(bonds.begin(), bonds.end(), [&](const BlockBonds& other) {
      return (other.visible_only || other.touching) && other.body == block.body;
    }));
  }
  return blocks;
}

// Collective.
void check_visibility(const PointCloud& cloud, const std::vector<BlockBonds>& bonds, const Communicator& communicator) {
  std::string problem;
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    if ((bonds[b].visible_only || bonds[b].touching) && bonds[b].families != FamilyKind::lists) {
      throw std::logic_error("block '" + cloud.block_names[b] + "' asks for bonds through material without lists");
    }
  }
  for (std::size_t i = 0; i < cloud.size() && problem.empty(); ++i) {
    const BlockBonds& block = bonds[cloud.blocks[i]];
    if (!(block.visible_only || block.touching) || (!cloud.shared_nodes.empty() && !cloud.shared_nodes[i].empty()))
      continue;
    problem = "block '" + cloud.block_names[cloud.blocks[i]] +
              "': its bonds shall run through material, but its points share nothing with each other; expected "
              "hexahedra or tetrahedra, not spheres or a text mesh";
  }
  raise_together(communicator, problem);
}

// A shared node of a candidate, in the form in which it is sent.
struct SharedNodeOf {
  std::int64_t id, shared_node;
};

// The shared nodes of points and of their images.
class SharedNodes {
 public:
  SharedNodes(const PointCloud& cloud, const std::vector<BlockBonds>& bonds, const Mirrored& mirrored)
      : cloud_(cloud), bonds_(bonds), mirrored_(mirrored) {}

  // Calls visit(shared node) for those of an image of point i. A shared node on a symmetry plane is its own image.
  template <class Visit>
  void for_each(int i, int image, const Visit& visit) const {
    const int body = bonds_[cloud_.blocks[i]].body;
    const bool is_mirrored = !mirrored_.images.of_body(body).empty();
    for (const std::int64_t shared_node : cloud_.shared_nodes[i]) {
      const int bits = mirrored_.periods.empty() && !is_mirrored ? first_plane_bit : Images::bits;
      const std::int64_t number = shared_node & ((std::int64_t{1} << bits) - 1);
      if (!mirrored_.periods.empty()) {
        visit(Images::id(number, cell_of(shared_node >> first_plane_bit, image)));
      } else if (!is_mirrored) {
        visit(number);
      } else if (cloud_.at == PointsAt::nodes) {  // shared nodes are elements, none of which is its own image
        for_each_image_at(body, cloud_.positions[i], cloud_.spacings[i], image,
                          [&](int one) { visit(Images::id(number, one)); });
      } else {
        visit(Images::id(number, first_image(body, filled_planes(shared_node), image)));
      }
    }
  }

 private:
  // Calls visit for the images that map X to the same position as `image` does.
  template <class Visit>
  void for_each_image_at(int body, const Vector& X, double spacing, int image, const Visit& visit) const {
    const Images& images = mirrored_.images;
    const auto look_at = [&](int one) {
      if ((images[one](X) - images[image](X)).norm() < 6 * on_plane * spacing) visit(one);
    };
    look_at(0);
    for (const int one : images.of_body(body)) look_at(one);
  }
  // The number of the period that an image of a shared node belongs to; `upper`: bits of the upper sides that the
  // shared node is on.
  int cell_of(std::int64_t upper, int image) const {
    int number = 0;
    for (const Period& period : mirrored_.periods) {
      const int n = static_cast<int>(std::lround(mirrored_.images[image].shift[period.axis] / period.length));
      number = 16 * number + n + static_cast<int>(upper >> period.axis & 1) + 8;
    }
    return number;
  }
  // The bits of the planes at a shared node behind which there is no void.
  static std::int64_t filled_planes(std::int64_t shared_node) {
    const std::int64_t of_voids = shared_node & ((std::int64_t{1} << first_plane_bit) - 1);
    return (shared_node >> first_plane_bit) & ~(of_voids >> Images::bits << (Images::bits - first_void_bit));
  }
  // The first of the images that differ from `image` by reflections at some planes.
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
  // `otherwise`: result if it is out of reach.
  int number_of(int body, const Reflection& reflection, int otherwise) const {
    if (is_same(reflection, Reflection())) return 0;
    for (const int one : mirrored_.images.of_body(body)) {
      if (is_same(reflection, mirrored_.images[one])) return one;
    }
    return otherwise;
  }
  bool is_same(const Reflection& a, const Reflection& b) const {
    return (a.turn - b.turn).norm() < 1e-9 && (a.shift - b.shift).norm() < 1e-9 * size_;
  }

  const PointCloud& cloud_;
  const std::vector<BlockBonds>& bonds_;
  const Mirrored& mirrored_;
  double size_ = mirrored_.boxes.empty() ? 0 : mirrored_.boxes.front().sizes().norm();
};

// Collective. Each shared node of some blocks with a pool member that has it. Those of candidates come from their
// owners, which process the same offers in the same order as for the candidates themselves.
std::vector<std::pair<std::int64_t, int>> nodes_of(const PointCloud& cloud, const std::vector<char>& blocks,
                                                   const CandidatePool& pool, const SharedNodes& all,
                                                   const std::vector<Offered>& offers, double reach,
                                                   const Communicator& communicator) {
  std::vector<std::pair<std::int64_t, int>> shared_nodes;
  std::vector<Vector> places;
  std::vector<SharedNodeOf> mine;
  std::vector<char> is_image;
  for (const auto& [i, image, place] : offers) {
    if (cloud.shared_nodes.empty() || !blocks[cloud.blocks[i]]) continue;
    all.for_each(i, image, [&](std::int64_t shared_node) {
      if (image == 0) shared_nodes.emplace_back(shared_node, i);
      places.push_back(place);
      mine.push_back({Images::id(cloud.ids[i], image), shared_node});
      is_image.push_back(image > 0);
    });
  }
  std::size_t member = cloud.size();
  for (const SharedNodeOf& one : received(cloud, places, mine, is_image, reach, communicator)) {
    while (pool.ids[member] != one.id) ++member;
    shared_nodes.emplace_back(one.shared_node, static_cast<int>(member));
  }
  return shared_nodes;
}

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

}  // namespace

LeftOut left_out(const PointCloud& cloud, const std::vector<BlockBonds>& bonds, const Mirrored& mirrored,
                 const std::vector<Offered>& offers, const CandidatePool& pool, const CellGrid& grid, double reach,
                 const Communicator& communicator) {
  const std::vector<char> blocks = concerned(bonds);
  if (std::find(blocks.begin(), blocks.end(), 1) == blocks.end()) return {};
  check_visibility(cloud, bonds, communicator);
  Visibility material({pool.positions, pool.horizons, pool.bodies},
                      nodes_of(cloud, blocks, pool, SharedNodes(cloud, bonds, mirrored), offers, reach, communicator));
  std::vector<std::pair<int, int>> pairs;
  std::vector<int> family, asked, apart;
  const int owned = static_cast<int>(cloud.size());
  for (int i = 0; i < owned; ++i) {
    if (!blocks[cloud.blocks[i]]) continue;
    family.clear(), asked.clear();
    for_each_within(grid, pool, i, reach, [&](int j) {
      family.push_back(j);
      if ((pool.asks[i] || pool.asks[j]) && j > i) asked.push_back(j);  // one of two owned points is enough
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

std::vector<std::pair<int, std::int64_t>> separated_by_cracks(const Search& search, const CandidatePool& pool,
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

}  // namespace strut

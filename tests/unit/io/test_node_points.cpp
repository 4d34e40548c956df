// Points at the nodes of a mesh: volumes, spacings, blocks, sets, on any number of ranks.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"
#include "base/parallel/gather_scatter.hpp"
#include "bricks.hpp"
#include "io/exodus/elements.hpp"
#include "io/exodus/exodus.hpp"
#include "unit/temporary_folder.hpp"

namespace strut::io {
namespace {

const std::vector<double> graded_x = {0, 1, 2.5, 3}, graded_y = {-1, 0, 3}, graded_z = {0, 0.1, 0.3, 0.7, 1.5};

// The same with all nodes shaken: no face is plane, no angle right.
Mesh shaken(Mesh mesh) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(-0.02, 0.02);
  for (Vector& x : mesh.nodes) x += Vector(shift(random), shift(random), shift(random));
  return mesh;
}

class NodePoints : public ::testing::Test {
 protected:
  const Communicator world;
  const TemporaryFolder folder{world};

  PointCloud read(const Mesh& mesh, PointsAt at = PointsAt::nodes) const {
    run_on_root(world, [&] { write_mesh(folder / "mesh.g", mesh); });
    return read_exodus(folder / "mesh.g", world, at);
  }

  // Values of all ranks, by id.
  template <class T>
  std::map<std::int64_t, T> by_id(const PointCloud& cloud, const std::vector<T>& values) const {
    std::vector<std::int64_t> ids = gather(world, std::span<const std::int64_t>(cloud.ids));
    std::vector<T> all = gather(world, std::span<const T>(values));
    world.broadcast(ids);
    world.broadcast(all);
    std::map<std::int64_t, T> result;
    for (std::size_t i = 0; i < ids.size(); ++i) result[ids[i]] = all[i];
    EXPECT_EQ(result.size(), ids.size()) << "ids that are there twice";
    return result;
  }

  double total(const std::vector<double>& values) const {
    return world.sum(std::accumulate(values.begin(), values.end(), 0.0));
  }
  Vector moment(const PointCloud& cloud) const {
    Vector sum = Vector::Zero();
    for (std::size_t i = 0; i < cloud.size(); ++i) sum += cloud.volumes[i] * cloud.positions[i];
    return {world.sum(sum[0]), world.sum(sum[1]), world.sum(sum[2])};
  }
};

// Half of the gaps on either side.
double half_gaps(const std::vector<double>& planes, std::size_t i) {
  const double below = i > 0 ? planes[i] - planes[i - 1] : 0;
  return 0.5 * (below + (i + 1 < planes.size() ? planes[i + 1] - planes[i] : 0));
}

TEST_F(NodePoints, OfGradedBricksHaveHalfTheGapsOnEitherSide) {
  const PointCloud cloud = read(bricks(graded_x, graded_y, graded_z));
  EXPECT_EQ(cloud.at, PointsAt::nodes);
  const auto volumes = by_id(cloud, cloud.volumes);
  const auto numbers = by_id(cloud, cloud.element_ids);
  ASSERT_EQ(volumes.size(), 4u * 3 * 5);
  std::int64_t id = 0;
  for (std::size_t k = 0; k < graded_z.size(); ++k) {
    for (std::size_t j = 0; j < graded_y.size(); ++j) {
      for (std::size_t i = 0; i < graded_x.size(); ++i, ++id) {
        const double expected = half_gaps(graded_x, i) * half_gaps(graded_y, j) * half_gaps(graded_z, k);
        EXPECT_NEAR(volumes.at(id), expected, 1e-14 * expected) << "node " << id;  // 8 elements, 8 Gauss points each
        EXPECT_EQ(numbers.at(id), id + 1);
      }
    }
  }
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::size_t n = static_cast<std::size_t>(cloud.ids[i]);
    EXPECT_EQ(cloud.positions[i], Vector(graded_x[n % 4], graded_y[n / 4 % 3], graded_z[n / 12]));
  }
}

// Volume and center of mass of the mesh are kept whatever its shape: shape functions add up to 1, and to x.
TEST_F(NodePoints, KeepVolumeAndCenterOfMassOfDistortedElements) {
  const Mesh hexahedra = shaken(bricks(graded_x, graded_y, graded_z));
  for (const Mesh& mesh : {hexahedra, as_tetrahedra(hexahedra)}) {
    const PointCloud nodes = read(mesh), elements = read(mesh, PointsAt::elements);
    const double volume = total(elements.volumes);
    EXPECT_NEAR(total(nodes.volumes), volume, 1e-14 * volume) << mesh.blocks[0].type;
    EXPECT_NEAR((moment(nodes) - moment(elements)).norm(), 0, 1e-13 * volume) << mesh.blocks[0].type;
  }
}

// Against the sum in the order of the file's elements, made on every rank: equal to the last bit on any number of them.
TEST_F(NodePoints, HaveTheSameVolumesToTheLastBitOnAnyNumberOfRanks) {
  const Mesh mesh = shaken(bricks(graded_x, graded_y, graded_z));
  std::vector<double> expected(mesh.nodes.size(), 0);
  for (std::size_t e = 0; e < mesh.blocks[0].elements(); ++e) {
    std::array<Vector, 8> corners;
    for (int n = 0; n < 8; ++n) corners[n] = mesh.nodes[mesh.blocks[0].nodes[8 * e + n]];
    const std::array<double, 8> parts = hexahedron_parts(corners);
    for (int n = 0; n < 8; ++n) expected[mesh.blocks[0].nodes[8 * e + n]] += parts[n];
  }
  const PointCloud cloud = read(mesh);
  for (std::size_t i = 0; i < cloud.size(); ++i) EXPECT_EQ(cloud.volumes[i], expected[cloud.ids[i]]);
  EXPECT_EQ(world.sum(static_cast<std::int64_t>(cloud.size())), std::ssize(expected));
}

TEST_F(NodePoints, OfTetrahedraHaveAQuarterOfEachOne) {
  Mesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -2}};
  mesh.blocks.push_back({"pair", "TET4", {0, 1, 2, 3, 0, 2, 1, 4}, {}});
  const PointCloud cloud = read(mesh);
  const auto volumes = by_id(cloud, cloud.volumes);
  const double upper = 1.0 / 24, lower = 2.0 / 24;
  const double expected[] = {upper + lower, upper + lower, upper + lower, upper, lower};
  for (int n = 0; n < 5; ++n) EXPECT_NEAR(volumes.at(n), expected[n], 1e-16);
}

// A corner has an eighth of an inner node's volume, but the same spacing.
TEST_F(NodePoints, OnTheSurfaceHaveTheSpacingOfInnerOnes) {
  const PointCloud even = read(bricks({0, 2, 4, 6}, {0, 2, 4}, {0, 2, 4}));
  for (const double spacing : even.spacings) EXPECT_NEAR(spacing, 2, 1e-14);
  // Beside bricks of 1 and 27 m³ lies the edge of a cube of 14 m³.
  const PointCloud uneven = read(bricks({0, 1}, {0, 1}, {0, 1, 28}));
  const auto spacings = by_id(uneven, uneven.spacings);
  EXPECT_NEAR(spacings.at(0), 1, 1e-14);
  EXPECT_NEAR(spacings.at(4), std::cbrt(14), 1e-14);
  EXPECT_NEAR(spacings.at(8), 3, 1e-14);
}

TEST_F(NodePoints, AreInExactlyTheSetsThatNameThem) {
  const PointCloud cloud = read(bricks(graded_x, graded_y, graded_z));
  EXPECT_EQ(cloud.set_names, (std::vector<std::string>{"zmin", "edge"}));
  for (const auto& [id, sets] : by_id(cloud, cloud.sets)) {
    EXPECT_EQ(sets, (id < 12 ? 1u : 0u) | (id < 4 ? 2u : 0u)) << "node " << id;
  }
}

TEST_F(NodePoints, SharedByBlocksBelongToTheFirstAndLonelyNodesToNone) {
  Mesh mesh = bricks({0, 1, 2}, {0, 1}, {0, 1});
  std::vector<int>& nodes = mesh.blocks[0].nodes;
  // The brick at larger x comes first.
  const Mesh::Block right{"right", "HEX8", {nodes.begin() + 8, nodes.end()}, {}};
  const Mesh::Block left{"left", "HEX8", {nodes.begin(), nodes.begin() + 8}, {}};
  mesh.blocks = {right, left};
  mesh.nodes.insert(mesh.nodes.begin(), Vector(9, 9, 9));  // a node that no element uses
  for (Mesh::Block& block : mesh.blocks) {
    for (int& node : block.nodes) ++node;
  }
  for (Mesh::NodeSet& set : mesh.node_sets) set.nodes.clear();
  const PointCloud cloud = read(mesh);
  const auto blocks = by_id(cloud, cloud.blocks);
  const auto volumes = by_id(cloud, cloud.volumes);
  EXPECT_EQ(cloud.block_names, (std::vector<std::string>{"right", "left"}));
  EXPECT_EQ(blocks.size(), 12u);
  EXPECT_FALSE(blocks.contains(0));
  for (const auto& [id, block] : blocks) {
    const bool shared = (id - 1) % 3 == 1;
    EXPECT_EQ(block, (id - 1) % 3 == 0 ? 1 : 0) << "node " << id;
    EXPECT_NEAR(volumes.at(id), shared ? 0.25 : 0.125, 1e-15);
  }
}

// As a result is written and read: spheres of the nodes' volumes, sets and numbers.
TEST_F(NodePoints, ComeOutOfAResultAgain) {
  const PointCloud cloud = read(shaken(bricks(graded_x, graded_y, graded_z)));
  {
    ExodusWriter writer(folder / "result.e", world, cloud, {{"Id", 1, true}});
    writer.write(0, std::vector<std::vector<double>>{{cloud.ids.begin(), cloud.ids.end()}});
  }
  const PointCloud again = read_exodus(folder / "result.e", world);
  EXPECT_EQ(by_id(again, again.volumes), by_id(cloud, cloud.volumes));
  EXPECT_EQ(by_id(again, again.sets), by_id(cloud, cloud.sets));
  EXPECT_EQ(by_id(again, again.element_ids), by_id(cloud, cloud.element_ids));
  if (world.rank() != 0) return;
  const ExodusResult result = read_result(folder / "result.e");
  for (std::size_t n = 0; n < result.nodal[0][0].size(); ++n) EXPECT_EQ(result.nodal[0][0][n], n);
}

// Six tetrahedra a brick, cubes of one size: inner nodes have the spacing that they have with bricks.
TEST_F(NodePoints, OfTetrahedraHaveTheSpacingOfBricks) {
  const PointCloud cloud = read(as_tetrahedra(bricks({0, 2, 4, 6}, {0, 2, 4}, {0, 2, 4})));
  for (const double spacing : cloud.spacings) EXPECT_NEAR(spacing, 2, 1e-13);
}

// Two bricks with a brick between them that is last in the file: its eight nodes belong to them.
TEST_F(NodePoints, ABlockWithoutNodesOfItsOwnIsAnError) {
  Mesh mesh = bricks({0, 1}, {0, 1}, {0, 1, 2, 3});
  const std::vector<int> all = mesh.blocks[0].nodes;
  mesh.blocks[0].nodes.assign(all.begin(), all.begin() + 8);
  mesh.blocks[0].nodes.insert(mesh.blocks[0].nodes.end(), all.begin() + 16, all.end());
  mesh.blocks.push_back({"glue", "HEX8", {all.begin() + 8, all.begin() + 16}, {}});
  try {
    read(mesh);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("block 'glue' would have no point"), std::string::npos) << error.what();
  }
}

// As with points at elements.
TEST_F(NodePoints, ABlockWithoutElementsIsNone) {
  Mesh mesh = bricks({0, 1}, {0, 1}, {0, 1, 2});
  mesh.blocks.push_back({"empty", "HEX8", {}, {}});
  const PointCloud cloud = read(mesh);
  EXPECT_EQ(world.sum(std::ssize(cloud.ids)), 12);
  EXPECT_EQ(cloud.block_names, (std::vector<std::string>{"bricks", "empty"}));
}

TEST_F(NodePoints, AreRefusedForSpheresAndElementsInsideOut) {
  const auto error = [&](const Mesh& mesh) -> std::string {
    try {
      read(mesh);
    } catch (const Error& thrown) {
      return thrown.what();
    }
    return "no error";
  };
  Mesh spheres;
  spheres.nodes = {Vector::Zero()};
  spheres.blocks.push_back({"balls", "SPHERE", {0}, {1}});
  EXPECT_NE(error(spheres).find("block 'balls' has spheres; points at nodes need hexahedra (HEX8) or tetrahedra"),
            std::string::npos);
  Mesh turned = bricks({0, 1}, {0, 1}, {0, 1, 2});
  std::swap_ranges(&turned.blocks[0].nodes[8], &turned.blocks[0].nodes[12], &turned.blocks[0].nodes[12]);
  EXPECT_NE(error(turned).find("block 'bricks', element 2: volume -1"), std::string::npos) << error(turned);
}

}  // namespace
}  // namespace strut::io

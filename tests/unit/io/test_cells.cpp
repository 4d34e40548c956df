// The part of a body that a point stands for: moments, surface, shared nodes, cells that are partly filled; and bonds
// that need material.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"
#include "base/parallel/gather_scatter.hpp"
#include "bricks.hpp"
#include "io/exodus/elements.hpp"
#include "io/exodus/exodus.hpp"
#include "io/grid/grid.hpp"
#include "topology/domain.hpp"
#include "topology/partition.hpp"
#include "unit/temporary_folder.hpp"

namespace strut::io {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const std::vector<double> xs = {0, 1, 2.5, 3}, ys = {-1, 0, 3}, zs = {0, 0.1, 0.3, 0.7, 1.5};
const Vector low(0, -1, 0), high(3, 3, 1.5);  // of the box of these planes

const std::array<Vector, 8> cube = {Vector{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                    {0, 0, 1},       {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

const Tensor sheared = (Tensor() << 2, 0.3, -0.4, 0.1, 1.5, 0.2, 0.6, -0.2, 0.7).finished();

template <std::size_t size>
std::array<Vector, size> mapped(std::array<Vector, size> nodes) {
  for (Vector& x : nodes) x = Vector(30, -20, 10) + sheared * x;
  return nodes;
}

// S = A S₀ Aᵀ. Coordinates of 30 m are good to 4e-15 m, of which lengths of 1 m take some ten.
TEST(Moments, OfAnAffineHexahedronAreThoseOfTheCubeMapped) {
  const Tensor expected = sheared * sheared.transpose() / 12;
  EXPECT_LT((to_tensor(hexahedron_moments(mapped(cube))) - expected).norm(), 1e-13);
  EXPECT_LT((cube_moments(8) - spherical(4.0 / 12)).norm(), 1e-15);
}

// A uniform density on the unit simplex is Dirichlet's with α = 1: variances 3/80, covariances −1/80.
TEST(Moments, OfATetrahedronAreThoseOfTheUnitOneMapped) {
  const Tensor unit = Tensor::Identity() * 4 / 80 - Tensor::Ones() / 80;
  const std::array<Vector, 4> nodes = {cube[0], cube[1], cube[3], cube[4]};
  const Tensor expected = sheared * unit * sheared.transpose();
  EXPECT_LT((to_tensor(tetrahedron_moments(mapped(nodes))) - expected).norm(), 1e-13);
}

// A square of side s(z) from a to b over the height h: ∫ s⁴/12 dz and ∫ z² s² dz, the latter about the centroid.
TEST(Moments, OfAFrustumHaveTheClosedForm) {
  const double a = 2, b = 1, h = 3;
  std::array<Vector, 8> nodes;
  for (int n = 0; n < 8; ++n) {
    const double side = n < 4 ? a : b;
    nodes[n] = Vector((cube[n][0] - 0.5) * side, (cube[n][1] - 0.5) * side, cube[n][2] * h);
  }
  const double volume = h / 3 * (a * a + a * b + b * b);
  const double mean = h / 4 * (a * a + 2 * a * b + 3 * b * b) / (a * a + a * b + b * b);
  const double xx = h / 60 * (a * a * a * a + a * a * a * b + a * a * b * b + a * b * b * b + b * b * b * b) / volume;
  const double zz = h * h * h / 30 * (a * a + 3 * a * b + 6 * b * b) / volume - mean * mean;
  Symmetric expected = Symmetric::Zero();
  expected.head<3>() << xx, xx, zz;
  EXPECT_LT((hexahedron_moments(nodes) - expected).norm(), 1e-14);
}

// Moved from the nodes to the origin, the pieces add up to the whole, whatever the distortion.
Integrals moved(const Integrals& about, const Vector& place) {
  const Tensor cross = about.first * place.transpose();
  return {about.volume, about.first + about.volume * place,
          about.second + symmetric_part(cross + cross.transpose() + about.volume * place * place.transpose())};
}

TEST(Moments, OfThePiecesOfADistortedHexahedronAddUpToTheWhole) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  for (int trial = 0; trial < 20; ++trial) {
    std::array<Vector, 8> nodes = cube;
    for (Vector& x : nodes) x += Vector(shift(random), shift(random), shift(random));
    Integrals sum;
    const std::array<Integrals, 8> pieces = hexahedron_pieces(nodes);
    for (int n = 0; n < 8; ++n) sum += moved(pieces[n], nodes[n]);
    const ElementPoint whole = hexahedron(nodes);
    EXPECT_NEAR(sum.volume, whole.volume, 1e-14);
    EXPECT_LT((cell_shape(sum).offset - whole.centroid).norm(), 1e-14);
    EXPECT_LT((cell_shape(sum).moments - hexahedron_moments(nodes)).norm(), 1e-14);
  }
}

TEST(Moments, OfTheQuartersOfATetrahedronAddUpToTheWhole) {
  const std::array<Vector, 4> nodes = {cube[0], 2 * cube[1], cube[6], cube[4]};
  Integrals sum;
  const std::array<Integrals, 4> pieces = tetrahedron_pieces(nodes);
  for (int n = 0; n < 4; ++n) {
    EXPECT_NEAR(pieces[n].volume, tetrahedron(nodes).volume / 4, 1e-15) << n;
    sum += moved(pieces[n], nodes[n]);
  }
  EXPECT_LT((cell_shape(sum).offset - tetrahedron(nodes).centroid).norm(), 1e-15);
  EXPECT_LT((cell_shape(sum).moments - tetrahedron_moments(nodes)).norm(), 1e-15);
}

class Cells : public ::testing::Test {
 protected:
  const Communicator world;
  const TemporaryFolder folder{world};

  PointCloud read(const Mesh& mesh, PointsAt at = PointsAt::elements, bool with_cells = true) const {
    run_on_root(world, [&] { write_mesh(folder / "mesh.g", mesh); });
    return read_exodus(folder / "mesh.g", world, at, with_cells);
  }
  std::string error_of(const Mesh& mesh, PointsAt at = PointsAt::elements) const {
    try {
      read(mesh, at);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

  // The cells of all ranks, by id.
  std::map<std::int64_t, CellShape> shapes(const PointCloud& cloud) const {
    std::vector<ShapeNumbers> mine;
    for (const CellShape& shape : cloud.shapes) mine.push_back(numbers_of(shape));
    EXPECT_EQ(mine.size(), cloud.size());
    std::vector<std::int64_t> ids = gather(world, std::span<const std::int64_t>(cloud.ids));
    std::vector<ShapeNumbers> all = gather(world, std::span<const ShapeNumbers>(mine));
    world.broadcast(ids);
    world.broadcast(all);
    std::map<std::int64_t, CellShape> result;
    for (std::size_t i = 0; i < ids.size(); ++i) result[ids[i]] = shape_of(all[i]);
    return result;
  }

  // Σ V (S + (x − X₀)⊗(x − X₀)), x the centroid of the cell.
  Tensor inertia(const PointCloud& cloud, const Vector& about) const {
    Tensor sum = Tensor::Zero();
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Vector r = cloud.positions[i] + cloud.shapes[i].offset - about;
      sum += cloud.volumes[i] * (to_tensor(cloud.shapes[i].moments) + r * r.transpose());
    }
    world.sum(std::span(sum.data(), 9));
    return sum;
  }
  Vector surface(const PointCloud& cloud) const {
    Vector sum = Vector::Zero();
    for (const CellShape& shape : cloud.shapes) sum += shape.surface;
    world.sum(std::span(sum.data(), 3));
    return sum;
  }
};

// Nodes that are not on the surface are shaken: the box stays, no brick does.
Mesh shaken_inside(Mesh mesh) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(-0.02, 0.02);
  for (Vector& x : mesh.nodes) {
    const Vector by(shift(random), shift(random), shift(random));
    if ((x - low).minCoeff() > 0 && (high - x).minCoeff() > 0) x += by;
  }
  return mesh;
}

// ∫ (x − X₀)⊗(x − X₀) dV over the box.
Tensor inertia_of_box(const Vector& about) {
  const Vector size = high - low, r = (low + high) / 2 - about;
  return size.prod() * (Tensor(size.cwiseAbs2().asDiagonal()) / 12 + r * r.transpose());
}

TEST_F(Cells, AddUpToTheInertiaOfABox) {
  const Vector about(-1, 2, 0.5);
  const Tensor expected = inertia_of_box(about);
  const Mesh even = bricks(xs, ys, zs), uneven = shaken_inside(even);
  const double rounding = 1e-14 * expected.norm();  // some hundred cells
  EXPECT_LT((inertia(read(even), about) - expected).norm(), rounding);
  EXPECT_LT((inertia(read(uneven), about) - expected).norm(), rounding);
  EXPECT_LT((inertia(read(as_tetrahedra(uneven)), about) - expected).norm(), rounding);
  EXPECT_LT((inertia(read(even, PointsAt::nodes), about) - expected).norm(), rounding);
  EXPECT_LT((inertia(read(as_tetrahedra(uneven), PointsAt::nodes), about) - expected).norm(), rounding);
}

// At nodes ∫N dV is not quite the volume of the pieces of distorted hexahedra: shifts of 0.02 change it by that part.
TEST_F(Cells, OfDistortedHexahedraAtNodesNearlyAddUpToTheInertia) {
  const Vector about(-1, 2, 0.5);
  const Tensor expected = inertia_of_box(about);
  EXPECT_LT((inertia(read(shaken_inside(bricks(xs, ys, zs)), PointsAt::nodes), about) - expected).norm(),
            0.02 * expected.norm());
}

TEST_F(Cells, HaveAClosedSurface) {
  const Mesh hexahedra = shaken_inside(bricks(xs, ys, zs));
  for (const PointsAt at : {PointsAt::elements, PointsAt::nodes}) {
    EXPECT_LT(surface(read(hexahedra, at)).norm(), 1e-14);
    EXPECT_LT(surface(read(as_tetrahedra(hexahedra), at)).norm(), 1e-14);
  }
}

// At elements whole faces, at nodes halves of the gaps on either side.
TEST_F(Cells, HaveTheFacesOfTheBox) {
  const Mesh mesh = bricks(xs, ys, zs);
  for (const auto& [id, shape] : shapes(read(mesh))) {
    const auto i = id % 3, j = id / 3 % 2, k = id / 6;
    const double dx = xs[i + 1] - xs[i], dy = ys[j + 1] - ys[j], dz = zs[k + 1] - zs[k];
    const Vector expected((i == 2 ? dy * dz : 0) - (i == 0 ? dy * dz : 0),
                          (j == 1 ? dx * dz : 0) - (j == 0 ? dx * dz : 0),
                          (k == 3 ? dx * dy : 0) - (k == 0 ? dx * dy : 0));
    EXPECT_LT((shape.surface - expected).norm(), 1e-15) << "element " << id;
    EXPECT_EQ(shape.offset, Vector::Zero());
  }
  const auto at_nodes = shapes(read(mesh, PointsAt::nodes));
  EXPECT_LT((at_nodes.at(0).surface - Vector(-0.5 * 0.05, -0.5 * 0.05, -0.5 * 0.5)).norm(), 1e-15);  // a corner
  EXPECT_LT((at_nodes.at(1).surface - Vector(0, -1.25 * 0.05, -1.25 * 0.5)).norm(), 1e-15);          // an edge
  EXPECT_LT((at_nodes.at(0).offset - Vector(0.25, 0.25, 0.025)).norm(), 1e-15);
  EXPECT_LT((at_nodes.at(0).moments.head<3>() - Vector(0.25, 0.25, 0.0025) / 12).norm(), 1e-15);
}

TEST_F(Cells, SharedNodesAreTheNodesOfAnElementAndTheElementsAroundANode) {
  Mesh mesh = bricks({0, 1, 2, 3}, {0, 1}, {0, 1});
  mesh.nodes.emplace_back(9, 9, 9);
  mesh.blocks.push_back({"ball", "SPHERE", {16}, {8}});
  const std::vector<std::vector<std::int64_t>> nodes = {
      {0, 1, 4, 5, 8, 9, 12, 13}, {1, 2, 5, 6, 9, 10, 13, 14}, {2, 3, 6, 7, 10, 11, 14, 15}, {}};
  const PointCloud elements = read(mesh);
  ASSERT_EQ(elements.shared_nodes.size(), elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    EXPECT_EQ(elements.shared_nodes[i], nodes[elements.ids[i]]);
    if (elements.ids[i] == 3) {
      EXPECT_LT((elements.shapes[i].moments - cube_moments(8)).norm(), 1e-15);
      EXPECT_EQ(elements.shapes[i].surface, Vector::Zero());
    }
  }
  mesh.blocks.pop_back();
  const std::vector<std::vector<std::int64_t>> around = {{0}, {0, 1}, {1, 2}, {2}};
  const PointCloud at_nodes = read(mesh, PointsAt::nodes);
  ASSERT_EQ(at_nodes.shared_nodes.size(), at_nodes.size());
  for (std::size_t i = 0; i < at_nodes.size(); ++i) EXPECT_EQ(at_nodes.shared_nodes[i], around[at_nodes.ids[i] % 4]);
}

TEST_F(Cells, AreNotThereUnlessAskedForAndChangeNothingElse) {
  const Mesh mesh = bricks(xs, ys, zs);
  for (const PointsAt at : {PointsAt::elements, PointsAt::nodes}) {
    const PointCloud plain = read(mesh, at, false), full = read(mesh, at);
    EXPECT_TRUE(plain.shapes.empty());
    EXPECT_FALSE(plain.shared_nodes.empty());
    EXPECT_EQ(plain.shared_nodes, full.shared_nodes);  // cheap, and tell what is joined
    EXPECT_EQ(plain.positions, full.positions);
    EXPECT_EQ(plain.volumes, full.volumes);
    EXPECT_EQ(plain.spacings, full.spacings);
  }
}

TEST_F(Cells, OfAGridAreThoseOfTheMeshOfItsCells) {
  const PointCloud grid = make_grid({0, 0, 0}, {3, 1, 1.5}, {3, 2, 4}, world, true);
  const PointCloud mesh = read(bricks({0, 1, 2, 3}, {0, 0.5, 1}, {0, 0.375, 0.75, 1.125, 1.5}));
  ASSERT_EQ(grid.ids, mesh.ids);
  EXPECT_EQ(grid.shared_nodes, mesh.shared_nodes);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    EXPECT_LT((grid.shapes[i].moments - mesh.shapes[i].moments).norm(), 1e-15);
    EXPECT_LT((grid.shapes[i].surface - mesh.shapes[i].surface).norm(), 1e-15);
  }
  EXPECT_TRUE(make_grid({0, 0, 0}, {3, 1, 1.5}, {3, 2, 4}, world).shapes.empty());
  // Faces on symmetry planes are kept apart; with them the surface is the same.
  FacesOnPlanes faces;
  PointCloud before_plane = make_grid({0, 0, 0}, {3, 1, 1.5}, {3, 2, 4}, world, true, {Mirror{.bit = 2}}, {}, &faces);
  double apart = 0;
  for (FaceOnPlanes face : faces) {
    EXPECT_EQ(face.planes, 4u);
    apart += face.area[0], face.planes = 0;
    add_face(face, before_plane);
  }
  EXPECT_NEAR(world.sum(apart), -1.5, 1e-15);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    EXPECT_EQ(before_plane.shapes[i].surface, grid.shapes[i].surface);
    EXPECT_EQ(before_plane.shapes[i].surface_moments, grid.shapes[i].surface_moments);
  }
}

// ---- Cells that are partly filled ----------------------------------------------------------------------------------

// Two whole bricks and two that are partly filled.
Mesh partly_filled() {
  Mesh mesh = bricks({0, 1, 2, 3, 4}, {0, 1}, {0, 1});
  std::vector<int>& all = mesh.blocks[0].nodes;
  Mesh::Block cut{"cut", "HEX8", {all.begin() + 16, all.end()}, {}, {}};
  all.resize(16);
  cut.cells.push_back({0.25, {2.2, 0.4, 0.5}, Symmetric(0.01, 0.02, 0.03, 0.001, -0.002, 0.003), {0.1, -0.2, 0.3}});
  cut.cells.push_back({1.5, {3.6, 0.5, 0.5}, Symmetric(0.11, 0.12, 0.13, 0, 0, 0), {1, 0, 0}});
  mesh.blocks.push_back(cut);
  mesh.node_sets.clear();
  return mesh;
}

TEST_F(Cells, ThatArePartlyFilledComeOutOfTheFileAgain) {
  const Mesh mesh = partly_filled();
  for (const bool with_cells : {false, true}) {
    const PointCloud cloud = read(mesh, PointsAt::elements, with_cells);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (cloud.ids[i] < 2) {
        EXPECT_NEAR(cloud.volumes[i], 1, 1e-15);
        continue;
      }
      const PartialCell& cell = mesh.blocks[1].cells[cloud.ids[i] - 2];
      EXPECT_EQ(cloud.volumes[i], cell.volume);
      EXPECT_EQ(cloud.positions[i], cell.centroid);
      EXPECT_NEAR(cloud.spacings[i], 1, 1e-15);
      if (!with_cells) continue;
      EXPECT_EQ(cloud.shapes[i].offset, Vector::Zero());
      EXPECT_EQ(cloud.shapes[i].moments, cell.moments);
      EXPECT_EQ(cloud.shapes[i].surface, cell.surface);
      EXPECT_EQ(cloud.shared_nodes[i].size(), 8u);
    }
  }
  if (world.rank() != 0) return;
  const Mesh again = read_mesh(folder / "mesh.g");
  EXPECT_TRUE(again.blocks[0].cells.empty());
  ASSERT_EQ(again.blocks[1].cells.size(), 2u);
  for (std::size_t e = 0; e < 2; ++e) {
    EXPECT_EQ(again.blocks[1].cells[e].volume, mesh.blocks[1].cells[e].volume);
    EXPECT_EQ(again.blocks[1].cells[e].centroid, mesh.blocks[1].cells[e].centroid);
    EXPECT_EQ(again.blocks[1].cells[e].moments, mesh.blocks[1].cells[e].moments);
    EXPECT_EQ(again.blocks[1].cells[e].surface, mesh.blocks[1].cells[e].surface);
  }
}

TEST_F(Cells, ThatNoBodyCanFillAreErrorsThatNameTheElement) {
  const auto broken = [](auto change) {
    Mesh mesh = partly_filled();
    change(mesh.blocks[1].cells[1]);
    return mesh;
  };
  const std::string where = "mesh.g: block 'cut', element 4, attributes of its cell: ";
  for (const double volume : {0.0, -1.0, std::nan(""), infinity}) {
    const std::string text = error_of(broken([&](PartialCell& cell) { cell.volume = volume; }));
    EXPECT_NE(text.find(where + "volume "), std::string::npos) << text;
  }
  for (const double moment : {0.0, -1e-3, std::nan(""), infinity}) {
    const std::string text = error_of(broken([&](PartialCell& cell) { cell.moments[2] = moment; }));
    EXPECT_NE(text.find(where + "moments xx yy zz xy yz zx ("), std::string::npos) << text;
  }
  const std::string shear = error_of(broken([](PartialCell& cell) { cell.moments[4] = 0.2; }));
  EXPECT_NE(shear.find(where + "moments xx yy zz xy yz zx ("), std::string::npos) << shear;
  const std::string place = error_of(broken([](PartialCell& cell) { cell.centroid[1] = std::nan(""); }));
  EXPECT_NE(place.find(where + "centroid ("), std::string::npos) << place;
  const std::string nodes = error_of(partly_filled(), PointsAt::nodes);
  EXPECT_NE(nodes.find("mesh.g: block 'cut' has elements that are partly filled"), std::string::npos) << nodes;
  Mesh one_lacks = partly_filled();
  one_lacks.blocks[1].cells.pop_back();
  EXPECT_NE(error_of(one_lacks).find("block 'cut' needs one cell for each HEX8 element"), std::string::npos);
}

// ---- Bonds through material ----------------------------------------------------------------------------------------

// The bonds over all ranks whose ends `crosses` says are on different sides.
template <class Crosses>
std::int64_t bonds_across(const PointCloud& cloud, double horizon, bool visible_only, const Communicator& world,
                          const Crosses& crosses) {
  BlockBonds bonds(horizon);
  bonds.families = FamilyKind::lists;
  bonds.visible_only = visible_only;
  const Domain domain = make_domain(partitioned(cloud, world), {bonds}, world);
  std::int64_t count = 0;
  for (int i = 0; i < domain.owned; ++i) {
    domain.families.for_each(i, [&](int j) { count += crosses(domain.reference(i), domain.reference(j)) ? 1 : 0; });
  }
  return world.sum(count);
}

const auto any = [](const Vector&, const Vector&) { return true; };

// The same bricks without those in which `is_hole` finds their middle.
template <class IsHole>
Mesh with_hole(const Mesh& mesh, const IsHole& is_hole) {
  Mesh result = mesh;
  result.blocks[0].nodes.clear();
  for (std::size_t e = 0; e < mesh.blocks[0].elements(); ++e) {
    const auto nodes = mesh.blocks[0].nodes.begin() + static_cast<std::ptrdiff_t>(8 * e);
    Vector middle = Vector::Zero();
    for (int n = 0; n < 8; ++n) middle += mesh.nodes[nodes[n]] / 8;
    if (!is_hole(middle)) result.blocks[0].nodes.insert(result.blocks[0].nodes.end(), nodes, nodes + 8);
  }
  return result;
}

std::vector<double> steps(int count) {
  std::vector<double> planes;
  for (int n = 0; n <= count; ++n) planes.push_back(n);
  return planes;
}

// Two bars of 2 × 2 elements along x, one spacing apart in y.
TEST_F(Cells, OfTwoBarsSideBySideAreNotBonded) {
  const Mesh bars =
      with_hole(bricks(steps(12), steps(5), steps(2)), [](const Vector& x) { return x[1] > 2 && x[1] < 3; });
  const PointCloud cloud = read(bars, PointsAt::nodes);
  const auto across = [](const Vector& a, const Vector& b) { return (a[1] < 2.5) != (b[1] < 2.5); };
  const auto along = [&](const Vector& a, const Vector& b) { return !across(a, b); };
  for (const double horizon : {1.75, 3.0}) {
    EXPECT_EQ(bonds_across(cloud, horizon, true, world, across), 0);
    EXPECT_GT(bonds_across(cloud, horizon, false, world, across), 0);
    EXPECT_EQ(bonds_across(cloud, horizon, true, world, along), bonds_across(cloud, horizon, false, world, along));
  }
}

// A notch of one element's width from y = 0 to y = 8, in a plate of 13 × 12 × 2.
TEST_F(Cells, OnTheFacesOfANotchAreBondedOnlyAroundItsTip) {
  const auto in_notch = [](const Vector& x) { return x[0] > 6 && x[0] < 7 && x[1] < 8; };
  const Mesh plate = with_hole(bricks(steps(13), steps(12), steps(2)), in_notch);
  constexpr double horizon = 3;
  const auto across = [](const Vector& a, const Vector& b) { return (a[0] < 6.5) != (b[0] < 6.5); };
  const auto away = [&](const Vector& a, const Vector& b) {
    return across(a, b) && a[1] < 8 - horizon && b[1] < 8 - horizon;
  };
  const auto ahead = [&](const Vector& a, const Vector& b) { return across(a, b) && a[1] >= 8 && b[1] >= 8; };
  const auto corner = [&](const Vector& a, const Vector& b) { return across(a, b) && a[1] == 7 && b[1] == 7; };
  for (const PointsAt at : {PointsAt::elements, PointsAt::nodes}) {
    const PointCloud cloud = read(plate, at);
    EXPECT_EQ(bonds_across(cloud, horizon, true, world, away), 0) << word(at);
    EXPECT_GT(bonds_across(cloud, horizon, false, world, away), 0) << word(at);
    EXPECT_GT(bonds_across(cloud, horizon, true, world, ahead), 0) << word(at);
    EXPECT_EQ(bonds_across(cloud, horizon, true, world, ahead), bonds_across(cloud, horizon, false, world, ahead));
  }
  // A path over the tip is within reach of both ends here.
  EXPECT_GT(bonds_across(read(plate, PointsAt::nodes), horizon, true, world, corner), 0);
}

TEST_F(Cells, OfASolidKeepAllTheirBonds) {
  const Mesh solid = bricks(steps(7), steps(6), steps(5));
  for (const Mesh& mesh : {solid, as_tetrahedra(solid)}) {
    for (const PointsAt at : {PointsAt::elements, PointsAt::nodes}) {
      const PointCloud cloud = read(mesh, at);
      EXPECT_EQ(bonds_across(cloud, 3, true, world, any), bonds_across(cloud, 3, false, world, any));
    }
  }
}

}  // namespace
}  // namespace strut::io

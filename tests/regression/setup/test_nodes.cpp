// Points at the nodes of a graded mesh, with a horizon that follows the spacing: what a deck makes of it.
#include <gtest/gtest.h>

#include <set>

#include "base/parallel/gather_scatter.hpp"
#include "mechanics/rigid_motion.hpp"
#include "output/means.hpp"
#include "regression/bodies.hpp"
#include "verification/larger.hpp"

namespace strut::regression {
namespace {

// 4 × 4 × 8 bricks, each layer 1.08 times as thick as the one below; z runs from 0.
io::Mesh graded_mesh() {
  io::Mesh mesh = Lattice{4, 4, 8, 1e-3}.mesh();
  const double ratio = 1.08;
  for (Vector& x : mesh.nodes) x[2] = 1e-3 * (std::pow(ratio, std::round(x[2] / 1e-3)) - 1) / (ratio - 1);
  return mesh;
}

// The same, all inner places shaken by up to a tenth of a spacing.
io::Mesh distorted_mesh() {
  io::Mesh mesh = graded_mesh();
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const double angle = static_cast<double>(n);
    mesh.nodes[n] += 1e-4 * Vector(std::sin(7 * angle), std::sin(11 * angle), std::sin(13 * angle));
  }
  return mesh;
}

Parts nodal_parts() {
  Parts parts;
  parts.mesh_file = "graded.g";
  parts.points = "Nodes";
  parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon Factor", "1.8"));
  return parts;
}

Simulation simulation(const RunFolder& folder, const io::Mesh& mesh) {
  run_on_root(folder.world, [&] { io::write_mesh(folder / "graded.g", mesh); });
  return {folder, nodal_parts()};
}

TEST(Nodes, HorizonsFollowTheSpacing) {
  const RunFolder folder;
  Simulation run = simulation(folder, graded_mesh());
  const Domain& domain = run.scene.body.domain;
  for (int i = 0; i < domain.owned; ++i) EXPECT_EQ(domain.horizon(i), 1.8 * domain.cloud.spacings[i]);
  // The cube root of the lowest brick, and of the eighth.
  EXPECT_NEAR(domain.blocks[0].smallest, 1.8e-3, 1e-15);
  EXPECT_NEAR(domain.blocks[0].largest, 1.8e-3 * std::cbrt(std::pow(1.08, 7)), 1e-15);
  EXPECT_NEAR(run.volume(), 16e-9 * (std::pow(1.08, 8) - 1) / 0.08, 1e-13 * 16e-9 * 11);
  EXPECT_EQ(run.scene.points, 5 * 5 * 9);
}

TEST(Nodes, FamiliesAreSymmetricWhereHorizonsDiffer) {
  const RunFolder folder;
  Simulation run = simulation(folder, distorted_mesh());
  Domain& domain = run.scene.body.domain;
  std::vector<double> ids(domain.sites.size(), -1);
  for (int i = 0; i < domain.owned; ++i) ids[i] = static_cast<double>(domain.cloud.ids[i]);
  domain.halo.exchange(ids);
  std::vector<double> bonds;
  int one_sided = 0;  // bonds that a rule of one end alone would not have on both sides
  for (int i = 0; i < domain.owned; ++i) {
    domain.families.for_each(i, [&](int j) {
      bonds.insert(bonds.end(), {ids[i], ids[j]});
      const double length = (domain.reference(j) - domain.reference(i)).norm();
      one_sided += (length <= domain.horizon(i)) != (length <= domain.horizon(j));
    });
  }
  EXPECT_GT(folder.world.sum(static_cast<std::int64_t>(one_sided)), 0) << "the mesh is not a test of the rule";
  bonds = gather(folder.world, std::span<const double>(bonds));
  std::set<std::pair<double, double>> pairs;
  for (std::size_t k = 0; k < bonds.size(); k += 2) pairs.emplace(bonds[k], bonds[k + 1]);
  EXPECT_EQ(2 * pairs.size(), bonds.size());
  for (const auto& [i, j] : pairs) EXPECT_TRUE(pairs.contains({j, i})) << i << " " << j;
}

// An affine deformation is seen as it is, at graded and distorted nodes, at the surface too.
TEST(Nodes, DeformationGradientOfAnAffineMotionIsExact) {
  const RunFolder folder;
  for (const io::Mesh& mesh : {graded_mesh(), distorted_mesh()}) {
    Simulation run = simulation(folder, mesh);
    Body& body = run.body();
    Tensor F;
    F << 1.002, 0.003, -0.001, 0.0005, 0.998, 0.002, -0.0015, 0.001, 1.001;
    for (int i = 0; i < body.owned(); ++i) body.domain.sites[i].current.head<3>() = (F * run.reference(i)).array();
    find_rigid_motion(body);  // no longer, by hand
    EXPECT_FALSE(advance_stress_and_force(body, 1e-9, true).failure);
    double error = 0, work = 0;
    for (int i = 0; i < body.owned(); ++i) {
      error = larger(error, (body.points[i].deformation_gradient - F).norm());
      work = larger(work, std::abs(body.stabilization_work(i)));
    }
    // The condition of K is below 100 at a corner: two digits of the sixteen.
    EXPECT_LT(folder.world.max(error), 1e-13);
    EXPECT_LT(folder.world.max(work), 1e-13 * 0.02 * 117e9);  // of the two sums whose difference it is
  }
}

// Coordinates and the distance from the axis, over a node set and over a block, are those of the nodes of the mesh.
TEST(Nodes, ExtremesAreThoseOfTheNodes) {
  const RunFolder folder;
  Simulation run = simulation(folder, graded_mesh());
  const Body& body = run.body();
  const std::vector<Observable> all = observables(body);
  const auto value = [&](const std::string& name) { return reduction_of(all, {}, body, name, "test").values(body)[0]; };
  const double height = 1e-3 * (std::pow(1.08, 8) - 1) / 0.08;
  EXPECT_NEAR(value("Max_Coordinate_Z"), height, 1e-15);
  EXPECT_NEAR(value("Min_Coordinate_Z(top)"), height, 1e-15);
  EXPECT_EQ(value("Max_Coordinate_Z(foot)"), 0);
  EXPECT_NEAR(value("Max_Radial_Distance(foot)"), 4e-3 * std::sqrt(2), 1e-17);
  EXPECT_NEAR(value("Max_Coordinate_X(bar)"), 4e-3, 1e-17);
  EXPECT_EQ(value("Min_Coordinate_Y(bar)"), 0);
}

// Bar and plate share the 5 × 5 nodes between them, which belong to the bar: half a layer of 16 mm² by 1 mm more of its
// density than the mesh has, of 4 layers of it and 2 of the plate's.
TEST(Nodes, ThatBlocksOfTwoDensitiesShareAreToldOf) {
  const RunFolder folder(Lattice{.nz = 6, .plate_layers = 2});
  const auto warnings = [&folder](const std::string& density) {
    Parts parts;
    parts.points = "Nodes";
    parts.materials += changed(changed(copper(), "copper", "light"), "8930", density);
    parts.blocks.clear();
    for (const auto& [block, material] : {std::pair("bar", "copper"), {"plate", "light"}}) {
      parts.blocks +=
          section(block, key("Block Names", block) + key("Material", material) + key("Horizon Factor", "1.8"));
    }
    return told_at_the_start(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world).warnings;
  };
  EXPECT_EQ(warnings("8930").find("the mass is"), std::string::npos);
  // 16e-9 m³ (4 · 8930 + 2 · 2700) kg/m³, and 8e-9 (8930 − 2700) kg more.
  EXPECT_NE(warnings("2700").find("WARNING: the mass is 0.0007078 kg, that of the elements 0.0006579 kg"),
            std::string::npos)
      << warnings("2700");
}

// The bar has half a layer of the plate's two, of 16e-9 m³ each: 8e-9 of 96e-9 m³.
TEST(Nodes, ThatUnlikeBlocksShareAreToldOf) {
  const RunFolder folder(Lattice{.nz = 6, .plate_layers = 2});
  const auto warnings = [&folder](const std::string& material, const std::string& points,
                                  const std::string& of_plate = "") {
    Parts parts;
    parts.points = points;
    parts.materials += changed(changed(copper(), "copper", "soft"), "117e9", "20e9");
    parts.materials += changed(copper(), "copper", "other");
    parts.blocks =
        section("bar", key("Block Names", "bar") + key("Material", "copper") + key("Horizon Factor", "1.8")) +
        section("plate",
                key("Block Names", "plate") + key("Material", material) + key("Horizon Factor", "1.8") + of_plate);
    parts.conditions = along("flight", "Initial Velocity", "plate", "z", "1");
    return told_at_the_start(deck::read(folder.write("deck.xml", parts.text()), folder.world), folder.world).warnings;
  };
  const std::string unlike = "8.3 % of the elements' volume has the material, damage model or initial temperature of",
                    condition =
                        "Boundary Conditions > flight acts on 2.4e-08 m³, and the elements of block 'plate' "
                        "have 3.2e-08 m³";
  const std::string soft = warnings("soft", "Nodes"), alike = warnings("copper", "Nodes");
  EXPECT_NE(soft.find(unlike), std::string::npos) << soft;
  EXPECT_NE(warnings("other", "Nodes").find(unlike), std::string::npos) << "whatever they differ in";
  EXPECT_NE(alike.find(condition), std::string::npos) << alike;
  EXPECT_EQ(alike.find("of the elements' volume"), std::string::npos) << alike;
  EXPECT_EQ(warnings("soft", "Elements").find("stands first in the mesh"), std::string::npos);
  const std::string separate = key("Separate Body", "true"), bodies = "are separate bodies that share nodes";
  EXPECT_NE(warnings("copper", "Nodes", separate).find(bodies), std::string::npos);
  EXPECT_EQ(warnings("copper", "Elements", separate).find(bodies), std::string::npos);
  EXPECT_EQ(alike.find(bodies), std::string::npos);
}

}  // namespace
}  // namespace strut::regression

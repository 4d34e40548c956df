// strut-mesh, shape = file: a mesh that is there becomes a body of a recipe.
#include "base/parallel/communicator.hpp"
#include "io/exodus/exodus.hpp"
#include "tool.hpp"

namespace strut {
namespace {

class FileRecipe : public testing::ToolTest {
 protected:
  testing::Outcome make(const std::string& recipe, const std::string& output = "mesh.g") const {
    return run(std::string(STRUT_MESH) + " " + write("mesh.recipe", recipe) + " " + path(output));
  }
  void make_scan(const std::string& elements = "hex") const {
    const std::string recipe = "name = scan\nshape = box\nsize = 1 2 3\nspacing = 0.5\nelements = ";
    ASSERT_EQ(make(recipe + elements + "\n", "scan.g").status, 0);
  }
  void expect_error(const std::string& recipe, const std::string& part) const {
    const testing::Outcome outcome = make(recipe);
    EXPECT_EQ(outcome.status, 1) << recipe;
    EXPECT_NE(outcome.text.find(part), std::string::npos) << "expected '" << part << "' in " << outcome.text;
    EXPECT_FALSE(std::filesystem::exists(path("mesh.g")));
  }
};

TEST_F(FileRecipe, RoundTripIsExact) {
  for (const char* elements : {"hex", "sphere"}) {
    make_scan(elements);
    const testing::Outcome outcome = make("shape = file\nfile = scan.g # beside the recipe\n");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const io::Mesh scan = io::read_mesh(path("scan.g")), mesh = io::read_mesh(path("mesh.g"));
    EXPECT_EQ(mesh.nodes, scan.nodes);
    ASSERT_EQ(mesh.blocks.size(), 1u);
    EXPECT_EQ(mesh.blocks[0].name, "scan");
    EXPECT_EQ(mesh.blocks[0].type, scan.blocks[0].type);
    EXPECT_EQ(mesh.blocks[0].nodes, scan.blocks[0].nodes);
    EXPECT_EQ(mesh.blocks[0].volumes, scan.blocks[0].volumes);
    ASSERT_EQ(mesh.node_sets.size(), 8u);  // six faces, foot and top
    for (std::size_t k = 0; k < 8; ++k) {
      EXPECT_EQ(mesh.node_sets[k].name, scan.node_sets[k].name);
      EXPECT_EQ(mesh.node_sets[k].nodes, scan.node_sets[k].nodes);
    }
  }
}

TEST_F(FileRecipe, OnAPlate) {
  make_scan();
  const testing::Outcome outcome = make(
      "[body]\nname = foam\nshape = file\nfile = scan.g\norigin = 1 0.5 0.25\n"
      "[body]\nname = plate\nshape = box\nsize = 4 4 1\norigin = 0 0 -1\nspacing = 0.5\n");
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("block scan: 48 points"), std::string::npos) << outcome.text;
  const PointCloud scan = io::read_exodus(path("scan.g"), Communicator());
  const PointCloud both = io::read_exodus(path("mesh.g"), Communicator());
  EXPECT_EQ(both.block_names, (std::vector<std::string>{"foam", "plate"}));
  EXPECT_EQ(both.size(), 48u + 128);
  EXPECT_EQ(both.set_names[0], "foam_scan_zmin");
  EXPECT_EQ(both.set_names[6], "foam_foot");
  EXPECT_EQ(both.set_names[8], "plate_zmin");
  for (std::size_t i = 0; i < scan.size(); ++i) {
    EXPECT_LT((both.positions[i] - scan.positions[i] - Vector(1, 0.5, 0.25)).norm(), 1e-14);  // rounding of some units
    EXPECT_EQ(both.sets[i], scan.sets[i]);
  }
}

TEST_F(FileRecipe, SeveralBlocksKeepTheirNames) {
  make_scan();
  ASSERT_EQ(
      make("[body]\nshape = file\nfile = scan.g\n[body]\nname = b\nshape = box\nsize = 1 1 1\nspacing = 1\n", "two.g")
          .status,
      0);
  ASSERT_EQ(make("shape = file\nfile = " + path("two.g") + "\n").status, 0);
  const PointCloud cloud = io::read_exodus(path("mesh.g"), Communicator());
  EXPECT_EQ(cloud.block_names, (std::vector<std::string>{"scan", "b"}));
  std::filesystem::remove(path("mesh.g"));
  expect_error("shape = file\nfile = two.g\nname = foam\n", "has 2 blocks, which keep their names");
}

TEST_F(FileRecipe, WrongRecipesAreRefused) {
  make_scan();
  expect_error("shape = file\n", "lacks the key 'file'");
  expect_error("shape = file\nfile = scann.g\n", "scann.g: cannot open it: no such file");
  expect_error("shape = file\nfile = mesh.recipe\n", "not an Exodus");
  expect_error("shape = file\nfile = scan.g\nspacing = 1\n", "line 3: a file has no key 'spacing'");
  expect_error("shape = box\nfile = scan.g\nsize = 1 1 1\nspacing = 1\n", "line 2: a box has no key 'file'");
  expect_error("[body]\nshape = file\nfile = scan.g\n[body]\nname = scan\nshape = box\nsize = 1 1 1\nspacing = 1\n",
               "two blocks are called 'scan'");
}

TEST_F(FileRecipe, WhatIsReadIsNotReplaced) {
  make_scan();
  const auto size = std::filesystem::file_size(path("scan.g"));
  std::filesystem::create_hard_link(path("scan.g"), path("link.g"));
  for (const char* output : {"scan.g", "link.g"}) {
    EXPECT_NE(make("shape = file\nfile = scan.g\n", output).text.find("is a mesh that the recipe reads"),
              std::string::npos);
  }
  EXPECT_NE(make("shape = box\nsize = 1 1 1\nspacing = 1\n", "mesh.recipe").text.find("is the recipe"),
            std::string::npos);
  EXPECT_EQ(std::filesystem::file_size(path("scan.g")), size);
}

}  // namespace
}  // namespace strut

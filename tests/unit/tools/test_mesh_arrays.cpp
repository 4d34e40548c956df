// strut-mesh --arrays: voxels that another program hands over are gathered in cells, and a damaged stream is refused.
#include <algorithm>

#include "base/parallel/communicator.hpp"
#include "io/exodus/exodus.hpp"
#include "tool.hpp"

namespace strut {
namespace {

template <class Number>
std::string bytes(const std::vector<Number>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

// Two layers of a box of 4 × 4 × 3 voxels, not cubes, in cells of 2³.
struct VoxelStream {
  std::string header = "voxels foam 32 4 4 3 2 0 solid\n";
  std::vector<double> place = {0.1, 0.2, 0.3, 5, 6, 7};
  std::vector<int> voxels;
  std::vector<double> fills;
  std::string end = "end\n";

  VoxelStream() {
    for (int n = 0; n < 32; ++n) voxels.insert(voxels.end(), {n % 4, n / 4 % 4, n / 16});
  }
  std::string text() const {
    return "strut-mesh arrays 1\nnodes 0\n" + header + bytes(place) + bytes(voxels) + bytes(fills) + end;
  }
};

class Arrays : public testing::ToolTest {
 protected:
  testing::Outcome make(const std::string& stream) const {
    return run(std::string(STRUT_MESH) + " --arrays " + path("mesh.g") + " < " + write("stream", stream));
  }

  void expect_error(const std::string& stream, const std::string& part) const {
    const testing::Outcome outcome = make(stream);
    EXPECT_EQ(outcome.status, 1) << part;
    EXPECT_NE(outcome.text.find("strut-mesh: "), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find(part), std::string::npos) << "expected '" << part << "' in " << outcome.text;
    EXPECT_FALSE(std::filesystem::exists(path("mesh.g")));
  }
};

TEST_F(Arrays, VoxelsAreGatheredInCells) {
  VoxelStream stream;
  const testing::Outcome outcome = make(stream.text());
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("2 x 2 x 2 voxels to a cell: 4 cells in 2 x 2 x 2 places"), std::string::npos);
  const io::Mesh mesh = io::read_mesh(path("mesh.g"));
  ASSERT_EQ(mesh.blocks[0].cells.size(), 4u);
  EXPECT_EQ(mesh.nodes.size(), 18u);
  EXPECT_NEAR(mesh.blocks[0].cells[0].volume, 8 * 0.006, 1e-15);
  EXPECT_LT((mesh.blocks[0].cells[0].centroid - Vector(5.1, 6.2, 7.3)).norm(), 1e-14);
  EXPECT_LT((mesh.blocks[0].cells[0].surface - Vector(-0.24, -0.12, 0)).norm(), 1e-14);  // faces of z cancel
  ASSERT_EQ(mesh.node_sets.size(), 5u);                                                  // none at zmax
  EXPECT_EQ(mesh.node_sets[0].name, "foam_zmin");

  EXPECT_EQ(outcome.text.find("thick"), std::string::npos);

  stream.header = "voxels foam 32 4 4 3 2 0 solid 6\n";
  EXPECT_NE(
      make(stream.text()).text.find("members on the average 3 cells thick: by quadratic correspondence expect up"),
      std::string::npos);

  stream.header = "voxels foam 32 4 4 3 2 0 grey\n";
  stream.fills.assign(32, 0.5);
  ASSERT_EQ(make(stream.text()).status, 0);
  EXPECT_NEAR(io::read_mesh(path("mesh.g")).blocks[0].cells[0].volume, 4 * 0.006, 1e-15);

  stream = VoxelStream();  // with a limit for small cells, the plate has two layers
  stream.header = "voxels foam 32 4 4 3 2 0.3 solid\n";
  ASSERT_EQ(make(stream.text()).status, 0);
  EXPECT_EQ(io::read_mesh(path("mesh.g")).blocks[0].cells.size(), 8u);
}

TEST_F(Arrays, BodiesFollowEachOther) {
  VoxelStream stream, other;
  other.header = "voxels plate 32 4 4 3 2 0 solid\n";
  stream.end = other.header + bytes(other.place) + bytes(other.voxels) + "end\n";
  ASSERT_EQ(make(stream.text()).status, 0);
  const io::Mesh mesh = io::read_mesh(path("mesh.g"));
  ASSERT_EQ(mesh.blocks.size(), 2u);
  EXPECT_EQ(mesh.blocks[1].name, "plate");
  EXPECT_EQ(*std::min_element(mesh.blocks[1].nodes.begin(), mesh.blocks[1].nodes.end()), 18);
  std::filesystem::remove(path("mesh.g"));
  stream.end.replace(stream.end.find("plate"), 5, "foam");
  expect_error(stream.text(), "two blocks are called 'foam'");
}

TEST_F(Arrays, MoreThanOneChunkOfNumbers) {
  VoxelStream stream;  // 98,304 places, read 65,536 at a time
  stream.header = "voxels foam 32768 32 32 32 2 0 solid\n";
  stream.voxels.clear();
  for (int n = 0; n < 32768; ++n) stream.voxels.insert(stream.voxels.end(), {n % 32, n / 32 % 32, n / 1024});
  ASSERT_EQ(make(stream.text()).status, 0);
  EXPECT_EQ(io::read_mesh(path("mesh.g")).blocks[0].elements(), 4096u);
}

TEST_F(Arrays, TruncatedAnywhere) {
  const std::string whole = VoxelStream().text();
  for (std::size_t length = 0; length + 1 < whole.size(); length += 29) expect_error(whole.substr(0, length), "");
  expect_error(whole.substr(0, 28 + 31 + 31), "it ends after 3 of 6 numbers");  // lines of 28 and 31 bytes, 3 × 8 + 7
  expect_error(whole.substr(0, whole.size() - 4), "'end' closes it");
}

TEST_F(Arrays, WrongFrame) {
  VoxelStream stream;
  const std::string text = stream.text();
  expect_error("strut-mesh arrays 2" + text.substr(19), "'strut-mesh arrays 1'");
  expect_error("strut-mesh arrays 1\nnodes 8\n" + text.substr(28), "expected the line 'nodes 0'");
  expect_error("strut-mesh arrays 1\nnodes 0\nend\n", "no elements");
  expect_error(text + "more", "data after 'end'");
  stream.header = "voxels a foam 32 4 4 3 2 0 solid 1\n";
  expect_error(stream.text(), "expected 'voxels NAME COUNT");
}

TEST_F(Arrays, WrongVoxels) {
  for (const auto& [header, part] :
       {std::pair("voxels foam 32 4 4 1 2 0.3 solid\n", "voxels 'foam', voxel 16 is not in the box"),
        {"voxels foam 32 4 4 0 2 0.3 solid\n", "the box's size in voxels is '0', expected 1 to 134217727"},
        {"voxels foam 32 40000 40000 3 2 0.3 solid\n", "the box's size in voxels is '3', expected 1 to 1"},
        {"voxels foam 300000000 4 4 3 2 0.3 solid\n", "their number is '300000000', expected 0 to 268435455"},
        {"voxels foam 2000000 4 4 3 2 0.3 solid\n", "voxels 'foam': it ends after"},
        {"voxels foam 32 4 4 3 17 0.3 solid\n", "their number along an edge of a cell is '17', expected 1 to 16"},
        {"voxels foam 32 4 4 3 2 1 solid\n", "the smallest cell is '1', expected 0 to 0.9"},
        {"voxels foam 32 4 4 3 2 0.3 gray\n", "are 'gray', expected solid or grey"},
        {"voxels foam 32 4 4 3 2 0.3 solid 0\n", "the thickness in voxels is '0', expected 0.001 to 1e+09"},
        {"voxels foam 32 4 4 3 2 0.3 solid inf\n", "the thickness in voxels is 'inf'"},
        {"voxels foam 0 4 4 3 2 0.3 solid\n", "no cell is left"}}) {
    VoxelStream stream;
    stream.header = header;
    expect_error(stream.text(), part);
  }
  VoxelStream stream;
  stream.place[1] = 0;
  expect_error(stream.text(), "three edges of a voxel > 0");
  stream = VoxelStream();
  std::swap(stream.voxels[0], stream.voxels[3]);
  expect_error(stream.text(), "voxel 1 is out of order");
  stream = VoxelStream();
  stream.header = "voxels foam 32 4 4 3 2 0.3 grey\n";
  stream.fills.assign(32, 1);
  stream.fills[3] = 0;
  expect_error(stream.text(), "voxel 3: a part of 0");
}

}  // namespace
}  // namespace strut

// strut-mesh --arrays: what another program hands over comes out of the file, and a damaged stream is refused.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel/communicator.hpp"
#include "io/exodus/exodus.hpp"
#include "tool.hpp"

namespace strut {
namespace {

template <class Number>
std::string bytes(const std::vector<Number>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

// A stream in its parts, so that a test can spoil one of them.
struct Stream {
  std::string magic = "strut-mesh arrays 1\n";
  std::string nodes_header = "nodes 10\n";
  std::vector<double> nodes = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1,
                               1, 0, 1, 1, 1, 1, 0, 1, 1, 0, 0, 4, 7, 8, 9};
  std::string cube_header = "block cube HEX8 1 8\n";
  std::vector<int> cube = {0, 1, 2, 3, 4, 5, 6, 7};
  std::string tip_header = "block tip TET4 1 4\n";
  std::vector<int> tip = {4, 5, 7, 8};
  std::string ball_header = "block balls SPHERE 2 1\n";
  std::vector<int> balls = {9, 8};
  std::vector<double> volumes = {0.25, 0.5};
  std::string set_header = "set top 2\n";
  std::vector<int> set = {8, 9};
  std::string end = "set none 0\nend\n";

  std::string text() const {
    return magic + nodes_header + bytes(nodes) + cube_header + bytes(cube) + tip_header + bytes(tip) + ball_header +
           bytes(balls) + bytes(volumes) + set_header + bytes(set) + end;
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
    EXPECT_NE(outcome.text.find("strut-mesh: standard input: "), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find(part), std::string::npos) << "expected '" << part << "' in " << outcome.text;
    EXPECT_FALSE(std::filesystem::exists(path("mesh.g")));
  }
};

TEST_F(Arrays, RoundTripIsExact) {
  const testing::Outcome outcome = make(Stream().text());
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("4 points, 10 nodes; node sets top, none"), std::string::npos) << outcome.text;
  const PointCloud cloud = io::read_exodus(path("mesh.g"), Communicator());
  EXPECT_EQ(cloud.block_names, (std::vector<std::string>{"cube", "tip", "balls"}));
  EXPECT_EQ(cloud.blocks, (std::vector<int>{0, 1, 2, 2}));
  EXPECT_EQ(cloud.set_names, (std::vector<std::string>{"top", "none"}));
  EXPECT_EQ(cloud.sets, (std::vector<std::uint64_t>{0, 1, 1, 1}));
  EXPECT_NEAR(cloud.volumes[0], 1, 1e-14);  // a Gauss sum of eight terms
  EXPECT_NEAR(cloud.volumes[1], 0.5, 1e-15);
  EXPECT_EQ(cloud.volumes[2], 0.25);
  EXPECT_EQ(cloud.positions[2], Vector(7, 8, 9));
  EXPECT_EQ(cloud.positions[3], Vector(0, 0, 4));
}

TEST_F(Arrays, MoreThanOneChunkOfNumbers) {
  const int count = 100000;  // 300,000 coordinates, read 65,536 at a time
  std::vector<double> x;
  std::vector<int> nodes;
  for (int n = 0; n < count; ++n) {
    x.insert(x.end(), {0.5 * n, -1.0 * n, 1.0});
    nodes.push_back(count - 1 - n);
  }
  const std::string number = std::to_string(count);
  const std::string stream = "strut-mesh arrays 1\nnodes " + number + "\n" + bytes(x) + "block all SPHERE " + number +
                             " 1\n" + bytes(nodes) + bytes(std::vector<double>(count, 2)) + "end\n";
  ASSERT_EQ(make(stream).status, 0);
  const PointCloud cloud = io::read_exodus(path("mesh.g"), Communicator());
  ASSERT_EQ(cloud.size(), count);
  for (int n = 0; n < count; ++n) ASSERT_EQ(cloud.positions[n].x(), 0.5 * (count - 1 - n));
}

TEST_F(Arrays, TruncatedAnywhere) {
  const std::string whole = Stream().text();
  for (std::size_t length = 0; length + 1 < whole.size(); length += 7) {
    expect_error(whole.substr(0, length), length < 20 ? "it " : "");
  }
  expect_error(whole.substr(0, 60), "nodes: it ends after 3 of 30 numbers");  // 20 + 9 bytes of header, 3 × 8 + 7
  expect_error(whole.substr(0, whole.size() - 4), "'end' closes it");
}

TEST_F(Arrays, CountsThatPromiseTooMuch) {
  Stream stream;
  stream.nodes_header = "nodes 2000000000\n";  // 48 GB
  expect_error(stream.text(), "of 6000000000 numbers");
  stream = Stream();
  stream.cube_header = "block cube HEX8 2000000000 8\n";
  expect_error(stream.text(), "block 'cube': it ends after");
  stream = Stream();
  stream.set_header = "set top 2000000000\n";
  stream.end = "";
  expect_error(stream.text(), "set 'top': it ends after 2 of 2000000000 numbers");
  for (const char* count : {"3000000000", "-1", "1e3", "99999999999999999999", "ten"}) {
    stream.nodes_header = std::string("nodes ") + count + "\n";
    expect_error(stream.text(), "is not a number from 0 to 2147483647");
  }
}

TEST_F(Arrays, WrongContent) {
  const auto spoiled = [](auto member, auto value) {
    Stream stream;
    stream.*member = value;
    return stream.text();
  };
  expect_error(spoiled(&Stream::magic, std::string("strut-mesh arrays 2\n")), "'strut-mesh arrays 1'");
  expect_error(spoiled(&Stream::nodes_header, std::string("node 10\n")), "expected 'nodes N', found 'node 10'");
  expect_error(spoiled(&Stream::cube, std::vector<int>{0, 1, 2, 3, 4, 5, 6, 10}),
               "block 'cube' refers to node 10; the nodes are 0 to 9");
  expect_error(spoiled(&Stream::set, std::vector<int>{-1, 2}), "set 'top' refers to node -1");
  expect_error(spoiled(&Stream::cube_header, std::string("block cube HEX 1 8\n")), "(did you mean 'HEX8'?)");
  expect_error(spoiled(&Stream::cube_header, std::string("block cube HEX8 1 20\n")), "expected 8");
  expect_error(spoiled(&Stream::cube_header, std::string("block a cube HEX8 1 8\n")), "expected 'block NAME TYPE");
  expect_error(spoiled(&Stream::tip_header, std::string("block cube TET4 1 4\n")), "two blocks are called 'cube'");
  expect_error(spoiled(&Stream::volumes, std::vector<double>{1, 0}), "block 'balls', element 1: volume 0");
  expect_error(spoiled(&Stream::end, std::string("set top 0\nend\n")), "two sets are called 'top'");
  expect_error(spoiled(&Stream::end, std::string("end\nmore")), "data after 'end'");
  expect_error("strut-mesh arrays 1\nnodes 0\nend\n", "no elements");
  for (const double x : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Stream stream;
    stream.nodes[17] = x;
    expect_error(stream.text(), "node 5: a coordinate is not finite");
    stream = Stream();
    stream.volumes[1] = x;
    expect_error(stream.text(), "expected one > 0");
  }
}

// A stream of one cube with what it holds.
struct CellStream {
  std::string header = "cells cube 1\n";
  std::vector<double> numbers = {0.25, 0.5, 0.4, 0.3, 0.01, 0.02, 0.03, 0.001, -0.002, 0.003, 0,
                                 -0.5, 1,   0.1, 0.2, 0.3,  0.4,  0.5,  0.6,   0.7,    0.8,   0.9};
  std::string text() const {
    const Stream cube;
    return cube.magic + cube.nodes_header + bytes(cube.nodes) + cube.cube_header + bytes(cube.cube) + header +
           bytes(numbers) + cube.tip_header + bytes(cube.tip) + "end\n";
  }
};

TEST_F(Arrays, CellsGoWithTheirBlock) {
  const CellStream stream;
  const testing::Outcome outcome = make(stream.text());
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  const io::Mesh mesh = io::read_mesh(path("mesh.g"));
  ASSERT_EQ(mesh.blocks[0].cells.size(), 1u);
  EXPECT_TRUE(mesh.blocks[1].cells.empty());
  const io::PartialCell& cell = mesh.blocks[0].cells[0];
  EXPECT_EQ(cell.volume, 0.25);
  EXPECT_EQ(cell.centroid, Vector(0.5, 0.4, 0.3));
  Symmetric moments;
  moments << 0.01, 0.02, 0.03, 0.001, -0.002, 0.003;
  EXPECT_EQ(cell.moments, moments);
  EXPECT_EQ(cell.surface, Vector(0, -0.5, 1));
  Tensor surface_moments;
  surface_moments << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9;
  EXPECT_EQ(cell.surface_moments, surface_moments);
}

TEST_F(Arrays, WrongCells) {
  for (const auto& [header, part] :
       {std::pair("cells tip 1\n", "cells of block 'tip': there is no such block before them"),
        {"cells cube 2\n", "cells of block 'cube': 2 cells, expected one for each of its 1 elements"},
        {"cells cube\n", "expected 'block NAME TYPE"}}) {
    CellStream stream;
    stream.header = header;
    expect_error(stream.text(), part);
  }
  CellStream stream;
  stream.numbers[0] = 0;
  expect_error(stream.text(), "cells of block 'cube', cell 0: volume 0");
  stream.numbers[0] = 1;
  stream.numbers[7] = std::nan("");
  expect_error(stream.text(), "cell 0: moment_xy is not finite");
  stream = CellStream();
  stream.numbers.resize(12);
  expect_error(stream.text(), "");
}

// Two layers of a box of 4 × 4 × 3 voxels, not cubes, in cells of 2³.
struct VoxelStream {
  std::string nodes = "nodes 0\n";
  std::string header = "voxels foam 32 4 4 3 2 0 solid\n";
  std::vector<double> place = {0.1, 0.2, 0.3, 5, 6, 7};
  std::vector<int> voxels;
  std::vector<double> fills;
  std::string end = "end\n";

  VoxelStream() {
    for (int n = 0; n < 32; ++n) voxels.insert(voxels.end(), {n % 4, n / 4 % 4, n / 16});
  }
  std::string text() const {
    return "strut-mesh arrays 1\n" + nodes + header + bytes(place) + bytes(voxels) + bytes(fills) + end;
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

TEST_F(Arrays, NodesOfVoxelsAreNotThoseOfTheStream) {
  VoxelStream stream;
  stream.nodes = "nodes 1\n" + bytes(std::vector<double>{1, 2, 3}) + "block ball SPHERE 1 1\n" +
                 bytes(std::vector<int>{0}) + bytes(std::vector<double>{1});
  stream.end = "set at 1\n" + bytes(std::vector<int>{0}) + "end\n";
  ASSERT_EQ(make(stream.text()).status, 0);
  const io::Mesh mesh = io::read_mesh(path("mesh.g"));
  EXPECT_EQ(mesh.blocks[1].name, "foam");
  EXPECT_EQ(*std::min_element(mesh.blocks[1].nodes.begin(), mesh.blocks[1].nodes.end()), 1);
  std::filesystem::remove(path("mesh.g"));
  stream.end = "set at 1\n" + bytes(std::vector<int>{1}) + "end\n";
  expect_error(stream.text(), "set 'at' refers to node 1; the nodes are 0 to 0");
  stream.end = "block foam SPHERE 0 1\nend\n";
  expect_error(stream.text(), "two blocks are called 'foam'");
  stream.end = "set foam_zmin 0\nend\n";
  expect_error(stream.text(), "two sets are called 'foam_zmin'");
}

TEST_F(Arrays, WrongVoxels) {
  for (const auto& [header, part] :
       {std::pair("voxels foam 32 4 4 1 2 0.3 solid\n", "voxels 'foam', voxel 16 is not in the box"),
        {"voxels foam 32 4 4 0 2 0.3 solid\n", "a box of 4 x 4 x 0 voxels"},
        {"voxels foam 32 40000 40000 3 2 0.3 solid\n", "expected 1 to 2147483647 in all"},
        {"voxels foam 300000000 4 4 3 2 0.3 solid\n", "at most 268435455 are supported"},
        {"voxels foam 2000000 4 4 3 2 0.3 solid\n", "voxels 'foam': it ends after"},
        {"voxels foam 32 4 4 3 17 0.3 solid\n", "17 along an edge of a cell, expected 1 to 16"},
        {"voxels foam 32 4 4 3 2 1 solid\n", "the smallest cell is '1', expected a number from 0 to 0.9"},
        {"voxels foam 32 4 4 3 2 0.3 gray\n", "are 'gray', expected solid or grey"},
        {"voxels foam 32 4 4 3 2 0.3 solid 0\n", "the thickness is '0', expected voxels > 0"},
        {"voxels foam 32 4 4 3 2 0.3 solid inf\n", "the thickness is 'inf', expected voxels > 0"},
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

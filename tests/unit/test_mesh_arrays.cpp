// strut-mesh --arrays: what another program hands over comes out of the file, and a damaged stream is refused.
#include <cmath>
#include <limits>

#include "base/communicator.hpp"
#include "io/exodus.hpp"
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

}  // namespace
}  // namespace strut

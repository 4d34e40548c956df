// Whatever a file holds, reading it gives one Error on all ranks that names the file: no crash, no hang.
#include <exodusII.h>
#include <gtest/gtest.h>
#include <netcdf.h>
#include <signal.h>
#include <sys/resource.h>

#include <fstream>
#include <iterator>
#include <random>

#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"
#include "io/exodus/exodus.hpp"
#include "io/exodus/exodus_file.hpp"
#include "unit/io/bytes_and_errors.hpp"
#include "unit/temporary_folder.hpp"

namespace strut::io {
namespace {

namespace fs = std::filesystem;

void write_bytes(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

void expect_error(const Communicator& world, const fs::path& file, const std::string& part) {
  const std::string text = error_of([&] { read_exodus(file, world); });
  EXPECT_NE(text.find(file.string()), std::string::npos) << text;
  EXPECT_NE(text.find(part), std::string::npos) << "expected '" << part << "' in: " << text;
}

Mesh row_of_cubes(int count) {
  Mesh mesh;
  for (int i = 0; i <= count; ++i) {
    for (const Vector& x : {Vector(i, 0, 0), Vector(i, 1, 0), Vector(i, 1, 1), Vector(i, 0, 1)})
      mesh.nodes.push_back(x);
  }
  mesh.blocks.push_back({"row", "HEX8", {}, {}});
  for (int i = 0; i < count; ++i) {
    const int n = 4 * i;
    for (const int corner : {0, 4, 5, 1, 3, 7, 6, 2}) mesh.blocks[0].nodes.push_back(n + corner);
  }
  mesh.node_sets.push_back({"start", {0, 1, 2, 3}});
  return mesh;
}

class BrokenFile : public testing::Test {
 protected:
  const Communicator world;
  const TemporaryFolder folder{world};

  fs::path mesh_file(const Mesh& mesh) const {
    run_on_root(world, [&] { write_mesh(folder / "mesh.g", mesh); });
    return folder / "mesh.g";
  }
};

TEST_F(BrokenFile, NoMeshAtAll) {
  run_on_root(world, [&] {
    write_bytes(folder / "empty.g", "");
    write_bytes(folder / "text.g", "0 0 0 1 1e-9\n");
    write_bytes(folder / "short.g", "CD");
    write_bytes(folder / "hdf.g", "\x89HDF\r\n\x1a\n and nothing more");
    fs::create_directory(folder / "folder.g");
  });
  expect_error(world, folder / "missing.g", "no such file");
  expect_error(world, folder / "empty.g", "empty");
  expect_error(world, folder / "text.g", "not an Exodus");
  expect_error(world, folder / "short.g", "not an Exodus");
  expect_error(world, folder / "hdf.g", "cannot open");
  expect_error(world, folder / "folder.g", "directory");
}

// HDF5 compares the end of its data, which its first bytes hold, with the size of the file.
TEST_F(BrokenFile, HDF5TruncatedAnywhere) {
  const fs::path file = mesh_file(row_of_cubes(20)), copy = folder / "hdf.g";
  run_on_root(world, [&] {
    int word = sizeof(double), stored = sizeof(double);
    float version = 0;
    const int in = ex_open(file.c_str(), EX_READ, &word, &stored, &version);
    const int out = ex_create(copy.c_str(), EX_CLOBBER | EX_NETCDF4 | EX_NOCLASSIC, &word, &stored);
    ASSERT_GE(ex_copy(in, out), 0);
    ex_close(in), ex_close(out);
  });
  EXPECT_EQ(error_of([&] { read_exodus(copy, world); }), "");
  const std::string bytes = bytes_of(copy);
  world.barrier();
  for (std::size_t length = 4; length < bytes.size(); length += bytes.size() / 50) {
    run_on_root(world, [&] { write_bytes(folder / "cut.g", bytes.substr(0, length)); });
    expect_error(world, folder / "cut.g", "cannot open");
  }
  run_on_root(world, [&] { write_bytes(folder / "cut.g", bytes.substr(0, bytes.size() - 1)); });
  expect_error(world, folder / "cut.g", "cannot open");
}

// The same file with `first` as its first variable.
void reorder(const fs::path& file, const fs::path& copy, const std::string& first) {
  int in = 0, out = 0, dimensions = 0, variables = 0, attributes = 0, unlimited = 0, number = 0;
  nc_open(file.c_str(), NC_NOWRITE, &in), nc_create(copy.c_str(), NC_CLOBBER | NC_64BIT_OFFSET, &out);
  nc_inq(in, &dimensions, &variables, &attributes, &unlimited);
  char name[NC_MAX_NAME + 1];
  for (int d = 0; d < dimensions; ++d) {
    std::size_t length = 0;
    nc_inq_dim(in, d, name, &length), nc_def_dim(out, name, d == unlimited ? NC_UNLIMITED : length, &number);
  }
  for (int a = 0; a < attributes; ++a)
    nc_inq_attname(in, NC_GLOBAL, a, name), nc_copy_att(in, NC_GLOBAL, name, out, NC_GLOBAL);
  nc_enddef(out), nc_inq_varid(in, first.c_str(), &number), nc_copy_var(in, number, out);
  for (int v = 0; v < variables; ++v) EXPECT_EQ(v == number ? NC_NOERR : nc_copy_var(in, v, out), NC_NOERR);
  nc_close(in), nc_close(out);
}

// Exodus' library skips such a column: spheres stood at x = 0, hexahedra had no volume.
TEST_F(BrokenFile, CoordinatesMayBeTheFirstVariable) {
  const fs::path file = mesh_file(row_of_cubes(3));
  const PointCloud right = read_exodus(file, world);
  for (const char* axis : {"coordx", "coordy", "coordz"}) {
    run_on_root(world, [&] { reorder(file, folder / "first.g", axis); });
    const PointCloud cloud = read_exodus(folder / "first.g", world);
    EXPECT_EQ(cloud.positions, right.positions);
    EXPECT_EQ(cloud.volumes, right.volumes);
    world.barrier();
  }
}

TEST_F(BrokenFile, TruncatedAnywhere) {
  const fs::path file = mesh_file(row_of_cubes(20));
  const auto size = static_cast<std::size_t>(fs::file_size(file));
  world.barrier();
  for (std::size_t length = 4; length < size; length += 4 + size / 50) {
    run_on_root(world, [&] { write_bytes(folder / "cut.g", bytes_of(file).substr(0, length)); });
    expect_error(world, folder / "cut.g", "truncated");
  }
  run_on_root(world, [&] { write_bytes(folder / "cut.g", bytes_of(file).substr(0, size - 8)); });
  expect_error(world, folder / "cut.g", "truncated");
}

TEST_F(BrokenFile, DamagedBytesNeverCrash) {
  const fs::path file = mesh_file(row_of_cubes(3));
  std::mt19937 random(3);
  const std::string bytes = bytes_of(file);
  for (int trial = 0; trial < 400; ++trial) {
    std::string damaged = bytes;
    for (int k = 0; k < 3; ++k) damaged[random() % bytes.size()] = static_cast<char>(random());
    run_on_root(world, [&] { write_bytes(folder / "damaged.g", damaged); });
    error_of([&] { read_exodus(folder / "damaged.g", world); });  // either way, but it comes back
  }
}

// A count in the header, of nodes as of anything else, is compared with the file's size before memory is taken.
TEST_F(BrokenFile, SmallFilesThatClaimToBeLarge) {
  const fs::path file = mesh_file(row_of_cubes(3));
  const std::string bytes = bytes_of(file), nodes = std::string("num_nodes") + std::string(3, '\0');
  const std::size_t at = bytes.find(nodes);
  ASSERT_NE(at, std::string::npos);
  for (const char* const count : {"\x7f\xff\xff\xff", "\x10\x00\x00\x00", "\xff\xff\xff\xff"}) {
    std::string damaged = bytes;
    damaged.replace(at + nodes.size(), 4, std::string(count, 4));
    run_on_root(world, [&] { write_bytes(folder / "large.g", damaged); });
    EXPECT_NE(error_of([&] { read_exodus(folder / "large.g", world); }), "");
  }
  // Where no variable has the dimension, the walk through the header sees nothing wrong.
  run_on_root(world, [&] {
    const ExodusFile hollow = ExodusFile::create(folder / "hollow.g");
    hollow.put_sizes("", {3, 8, 1'000'000'000, 1, 0});
    hollow.put_blocks({{1, "one", "HEX8", 1, 8, {}}});
  });
  expect_error(world, folder / "hollow.g", "1000000000 elements, for which it is too small");
}

TEST_F(BrokenFile, ElementsThatCannotBePoints) {
  Mesh mesh = row_of_cubes(3);
  std::swap(mesh.nodes[8], mesh.nodes[4]);
  std::swap(mesh.nodes[9], mesh.nodes[5]);
  std::swap(mesh.nodes[10], mesh.nodes[6]);
  std::swap(mesh.nodes[11], mesh.nodes[7]);
  expect_error(world, mesh_file(mesh), "block 'row', element 2: volume -1");
  mesh = row_of_cubes(1);
  mesh.nodes[2][1] = std::nan("");
  expect_error(world, mesh_file(mesh), "node 3");
  mesh = row_of_cubes(1);
  mesh.blocks[0].nodes.clear();
  expect_error(world, mesh_file(mesh), "no elements");
  mesh = row_of_cubes(1);
  for (int k = 0; k < 65; ++k) mesh.node_sets.push_back({"set" + std::to_string(k), {0}});
  expect_error(world, mesh_file(mesh), "66 node sets");
}

// The library looks both up by the first that has the number, the deck by the first that has the name.
TEST_F(BrokenFile, BlocksAndNodeSetsOfOneNumberOrName) {
  Mesh mesh = row_of_cubes(2);
  mesh.blocks.push_back(mesh.blocks[0]);
  mesh.blocks[0].nodes.resize(8),
      mesh.blocks[1].nodes.erase(mesh.blocks[1].nodes.begin(), mesh.blocks[1].nodes.begin() + 8);
  expect_error(world, mesh_file(mesh),
               "blocks 'row' (number 1, at place 1) and 'row' (number 2, at place 2) have the same name");
  mesh.blocks[0].name = "block_70", mesh.blocks[1].name = "block_80";
  mesh.node_sets.push_back({"end", {8, 9, 10, 11}});
  mesh.node_sets[0].name = "end";
  expect_error(world, mesh_file(mesh),
               "node sets 'end' (number 1, at place 1) and 'end' (number 2, at place 2) have the same name");
  mesh.node_sets[0].name = "nodelist_90", mesh.node_sets[1].name = "nodelist_91";
  const fs::path file = mesh_file(mesh);
  EXPECT_EQ(error_of([&] { read_exodus(file, world); }), "");
  const auto with_one_number = [&](const std::string& kind, char first, char second) {
    const std::string both{0, 0, 0, first, 0, 0, 0, second}, one{0, 0, 0, first, 0, 0, 0, first};
    std::string bytes = bytes_of(file);
    const std::size_t at = bytes.find(both);
    ASSERT_NE(at, std::string::npos);
    bytes.replace(at, both.size(), one);
    run_on_root(world, [&] { write_bytes(folder / (kind + ".g"), bytes); });
  };
  with_one_number("blocks", 70, 80);
  expect_error(world, folder / "blocks.g",
               "blocks 'block_70' (number 70, at place 1) and 'block_80' (number 70, at place 2) have the same number");
  with_one_number("sets", 90, 91);
  expect_error(
      world, folder / "sets.g",
      "node sets 'nodelist_90' (number 90, at place 1) and 'nodelist_91' (number 90, at place 2) have the same number");
}

// The corner moved through the middle leaves 1/6 to 1 of a unit cube's volume positive. One that is collapsed to a
// wedge is none of these.
TEST_F(BrokenFile, HexahedraFoldedAtACorner) {
  Mesh mesh = row_of_cubes(3);
  mesh.nodes[6] += Vector(0, -0.7, -0.7);  // of the first two elements
  for (const PointsAt at : {PointsAt::elements, PointsAt::nodes}) {
    const fs::path file = mesh_file(mesh);
    const std::string text = error_of([&] { read_exodus(file, world, at); });
    EXPECT_NE(text.find("folded at a corner"), std::string::npos) << text;
    EXPECT_NE(text.find("element 1 of block 'row' (corner "), std::string::npos) << text;
  }
  Mesh wedges = row_of_cubes(2);
  wedges.blocks[0].nodes[8 + 2] = wedges.blocks[0].nodes[8 + 1],
                             wedges.blocks[0].nodes[8 + 6] = wedges.blocks[0].nodes[8 + 5];
  const fs::path file = mesh_file(wedges);
  EXPECT_EQ(error_of([&] { read_exodus(file, world); }), "");
}

// By the same nodes, or by others at the same places.
TEST_F(BrokenFile, AnElementGivenTwiceDoesNotDoubleTheVolumesOfItsNodes) {
  for (const bool same_nodes : {true, false}) {
    Mesh mesh = row_of_cubes(3);
    mesh.blocks.push_back({"again", "HEX8", {mesh.blocks[0].nodes.begin() + 8, mesh.blocks[0].nodes.begin() + 16}, {}});
    for (int& node : mesh.blocks[1].nodes) node += same_nodes ? 0 : 16;
    for (int n = 0; n < 16; ++n) mesh.nodes.push_back(mesh.nodes[n] + Vector::Constant(1e-6));
    const fs::path file = mesh_file(mesh);
    const std::string text = error_of([&] { read_exodus(file, world, PointsAt::nodes); });
    EXPECT_NE(text.find("element 4 of block 'again' is where element 2 of block 'row' is"), std::string::npos) << text;
  }
}

// Volumes of small elements are printed with their digits, too: not "-0.000000".
TEST_F(BrokenFile, VolumesAreToldWithTheirDigits) {
  Mesh mesh = row_of_cubes(1);
  for (Vector& x : mesh.nodes) x *= 1e-4;
  std::swap(mesh.blocks[0].nodes[0], mesh.blocks[0].nodes[4]),
      std::swap(mesh.blocks[0].nodes[1], mesh.blocks[0].nodes[5]);
  std::swap(mesh.blocks[0].nodes[2], mesh.blocks[0].nodes[6]),
      std::swap(mesh.blocks[0].nodes[3], mesh.blocks[0].nodes[7]);
  expect_error(world, mesh_file(mesh), "volume -1e-12 m³");
}

// Names say what attributes are, whatever their places; without names the radius stands first.
TEST_F(BrokenFile, AttributesOfSpheresAreReadByTheirNames) {
  const auto volume_of = [&](const std::vector<std::string>& names) {
    run_on_root(world, [&] {
      const ExodusFile file = ExodusFile::create(folder / "spheres.g");
      const ExodusFile::Block block = {1, "spheres", "SPHERE", 1, 1, names};
      file.put_sizes("", {3, 1, 1, 1, 0});
      file.put_blocks({block});
      file.put_coordinates({std::vector<double>(1), std::vector<double>(1), std::vector<double>(1)});
      file.put_connectivity(block, std::vector<std::int64_t>{1});
      for (std::size_t k = 0; k < names.size(); ++k)
        file.put_attribute(block, static_cast<int>(k), std::vector<double>{0.5 + static_cast<double>(k)});
    });
    const PointCloud cloud = read_exodus(folder / "spheres.g", world);
    return world.sum(cloud.size() > 0 ? cloud.volumes[0] : 0.0);
  };
  const double ball = 4 * M_PI / 3;
  EXPECT_EQ(volume_of({"radius", "volume"}), 1.5);
  EXPECT_EQ(volume_of({"VOLUME", "Radius"}), 0.5);
  EXPECT_EQ(volume_of({"volume"}), 0.5);
  EXPECT_EQ(volume_of({"density", "angle", "SPH_volume"}), 2.5);
  EXPECT_EQ(volume_of({"free_volume", "Volume"}), 1.5);
  EXPECT_DOUBLE_EQ(volume_of({"mass", "radius"}), ball * 1.5 * 1.5 * 1.5);
  EXPECT_EQ(volume_of({"", ""}), 1.5);
  EXPECT_DOUBLE_EQ(volume_of({""}), ball / 8);
  const std::string text = error_of([&] { volume_of({"mass", "angle"}); });
  EXPECT_NE(
      text.find("its spheres have the attributes mass, angle; expected one of the name radius (m) or volume (m³)"),
      std::string::npos)
      << text;
}

// Whole hexahedra would be another body.
TEST_F(BrokenFile, PartlyFilledElementsWithoutOneOfTheirAttributes) {
  std::vector<std::string> names = partial_cell_attributes;
  names.erase(names.begin() + 7);
  run_on_root(world, [&] {
    const ExodusFile file = ExodusFile::create(folder / "cells.g");
    file.put_sizes("", {3, 8, 1, 1, 0});
    file.put_blocks({{1, "foam", "HEX8", 1, 8, names}});
    file.put_coordinates({std::vector<double>(8), std::vector<double>(8), std::vector<double>(8)});
  });
  expect_error(world, folder / "cells.g", "block 'foam' has attributes of partly filled elements, but not 'moment_xy'");
}

TEST_F(BrokenFile, UnknownElementType) {
  run_on_root(world, [&] {
    const ExodusFile file = ExodusFile::create(folder / "pyramid.g");
    const ExodusFile::Block block = {1, "tips", "PYRAMID5", 1, 5, {}};
    file.put_sizes("", {3, 5, 1, 1, 0});
    file.put_blocks({block});
    file.put_coordinates({std::vector<double>(5), std::vector<double>(5), std::vector<double>(5)});
    file.put_connectivity(block, std::vector<std::int64_t>{1, 2, 3, 4, 5});
  });
  expect_error(world, folder / "pyramid.g", "PYRAMID5");
}

TEST_F(BrokenFile, TextNamesTheLine) {
  const std::pair<std::string, const char*> cases[] = {
      {"0 0 0 1 1\n0 0 1\n", "line 2"},
      {"0 0 0 1 1\n\n0 0 1 1 x\n", "line 3: 'x'"},
      {"0 0 0 1.5 1\n", "'1.5' is not an integer"},
      {"0 0 0 1 0\n", "not positive"},
      {"0 nan 0 1 1\n", "'nan'"},
      {"0 inf 0 1 1\n", "'inf'"},
      {"0 1e999 0 1 1\n", "'1e999'"},
      {"0 0 0 1 1 7\n", "found 6"},
      {"0 0 0 1 1\r0 0 1 1 1\r", "found 10 and lines that end in CR alone"},
      {std::string("0 0 0 1 1\0\n", 11), "found a byte 0"},
      {"\377\3760", "it is in UTF-16"},
      {"header: x y block_id volume\n0 0 1 1\n",
       "line 1: two-dimensional problems are not there; expected the columns"},
      {"header: x y z block_id volume Angles\n0 0 0 1 1 7\n",
       "line 1: expected the columns x y z block_id volume, no "
       "more"},
      {"# nothing\n", "no points"},
      {"", "no points"},
  };
  for (const auto& [content, part] : cases) {
    run_on_root(world, [&] { write_bytes(folder / "points.txt", content); });
    const std::string text = error_of([&] { read_text(folder / "points.txt", world); });
    EXPECT_NE(text.find(part), std::string::npos) << "expected '" << part << "' in: " << text;
  }
  EXPECT_NE(error_of([&] { read_text(folder / "missing.txt", world); }), "");
  EXPECT_NE(error_of([&] { read_text(folder / "", world); }), "");
}

// A limit on the size of files stands in for a full disk.
TEST_F(BrokenFile, FullDiskIsAnErrorAndEarlierFramesStay) {
  PointCloud cloud;
  cloud.block_names = {"block"};
  for (int i = 0; i < 10000; ++i) {
    cloud.ids.push_back(world.rank() * 10000 + i);
    cloud.positions.emplace_back(i, 0, 0);
  }
  cloud.element_ids = cloud.ids;
  cloud.volumes.assign(10000, 1);
  cloud.blocks.assign(10000, 0);
  cloud.sets.assign(10000, 0);
  const std::vector<std::vector<double>> columns = {std::vector<double>(10000, 3)};
  ExodusWriter writer(folder / "result.e", world, cloud, {{"Field", 1, true}});
  writer.write(0, columns);

  signal(SIGXFSZ, SIG_IGN);
  rlimit before = {};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit limit = {static_cast<rlim_t>(fs::file_size(folder / "result.e") + 10000), before.rlim_max};
  world.barrier();
  setrlimit(RLIMIT_FSIZE, &limit);
  const std::string text = error_of([&] { writer.write(1, columns); });
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_NE(text.find("result.e"), std::string::npos) << text;
  EXPECT_NE(text.find("large"), std::string::npos) << text;
  if (world.rank() != 0) return;
  fs::copy_file(folder / "result.e", folder / "copy.e");
  EXPECT_EQ(read_result(folder / "copy.e").times, std::vector<double>{0});
}

}  // namespace
}  // namespace strut::io

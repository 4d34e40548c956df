// A mesh, a text, a result or a history is read as it was written, on any number of ranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <random>

#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"
#include "base/parallel/gather_scatter.hpp"
#include "io/exodus/elements.hpp"
#include "io/exodus/exodus.hpp"
#include "io/text/history.hpp"
#include "unit/temporary_folder.hpp"

namespace strut::io {
namespace {

namespace fs = std::filesystem;

const Vector cube[8] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

template <class T>
std::vector<T> gathered(const std::vector<T>& values, const Communicator& world) {
  return gather(world, std::span<const T>(values));
}

// The whole cloud, on rank 0.
PointCloud gathered(const PointCloud& cloud, const Communicator& world) {
  PointCloud whole = cloud;
  std::vector<double> numbers;
  for (const Vector& x : cloud.positions) numbers.insert(numbers.end(), x.data(), x.data() + 3);
  numbers = gathered(numbers, world);
  whole.positions.clear();
  for (std::size_t i = 0; i < numbers.size(); i += 3) whole.positions.emplace_back(&numbers[i]);
  whole.ids = gathered(cloud.ids, world);
  whole.element_ids = gathered(cloud.element_ids, world);
  whole.volumes = gathered(cloud.volumes, world);
  whole.spacings = gathered(cloud.spacings, world);
  whole.blocks = gathered(cloud.blocks, world);
  whole.sets = gathered(cloud.sets, world);
  return whole;
}

// Two unit cubes side by side, a tetrahedron on top of the first, two spheres apart.
Mesh mixed_mesh() {
  Mesh mesh;
  mesh.nodes.assign(cube, cube + 8);
  for (const Vector& x : {Vector(2, 0, 0), Vector(2, 1, 0), Vector(2, 0, 1), Vector(2, 1, 1)}) mesh.nodes.push_back(x);
  mesh.nodes.emplace_back(0, 0, 2);
  mesh.nodes.emplace_back(5, 5, 5);
  mesh.nodes.emplace_back(6, 5, 5);
  mesh.blocks.push_back({"cubes", "HEX8", {0, 1, 2, 3, 4, 5, 6, 7, 1, 8, 9, 2, 5, 10, 11, 6}, {}});
  mesh.blocks.push_back({"a_tetrahedron_with_a_name_that_is_longer_than_32_characters", "TET4", {4, 5, 7, 12}, {}});
  mesh.blocks.push_back({"spheres", "SPHERE", {13, 14}, {0.5, 0.25}});
  mesh.node_sets.push_back({"left", {0, 3, 4, 7}});
  mesh.node_sets.push_back({"right", {8, 9, 10, 11, 14}});
  mesh.node_sets.push_back({"none", {}});
  return mesh;
}

TEST(Mesh, RoundTripKeepsBlocksSetsAndVolumes) {
  const Communicator world;
  const TemporaryFolder folder(world);
  run_on_root(world, [&] { write_mesh(folder / "mixed.g", mixed_mesh()); });
  const PointCloud mine = read_exodus(folder / "mixed.g", world);
  EXPECT_EQ(mine.block_names.size(), 3u);
  EXPECT_EQ(mine.block_names[1], "a_tetrahedron_with_a_name_that_is_longer_than_32_characters");
  EXPECT_EQ(mine.set_names, (std::vector<std::string>{"left", "right", "none"}));
  const PointCloud whole = gathered(mine, world);
  if (world.rank() != 0) return;
  EXPECT_EQ(whole.ids, (std::vector<std::int64_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(whole.element_ids, (std::vector<std::int64_t>{1, 2, 3, 4, 5}));
  EXPECT_EQ(whole.blocks, (std::vector<int>{0, 0, 1, 2, 2}));
  EXPECT_EQ(whole.sets, (std::vector<std::uint64_t>{1, 2, 1, 0, 2}));
  const double volumes[] = {1, 1, 1.0 / 6, 0.5, 0.25};
  const Vector centers[] = {{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}, {0.25, 0.25, 1.25}, {5, 5, 5}, {6, 5, 5}};
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(whole.volumes[i], volumes[i], 1e-15);
    EXPECT_NEAR(whole.spacings[i], std::cbrt(volumes[i]), 1e-15);
    EXPECT_LT((whole.positions[i] - centers[i]).norm(), 1e-14);
  }
}

TEST(Mesh, ReadMeshIsTheInverseOfWriteMesh) {
  const Communicator world;
  const TemporaryFolder folder(world);
  if (world.rank() != 0) return;
  const Mesh written = mixed_mesh();
  write_mesh(folder / "mixed.g", written);
  const Mesh read = read_mesh(folder / "mixed.g");
  EXPECT_EQ(read.nodes, written.nodes);
  ASSERT_EQ(read.blocks.size(), written.blocks.size());
  for (std::size_t b = 0; b < read.blocks.size(); ++b) {
    EXPECT_EQ(read.blocks[b].name, written.blocks[b].name);
    EXPECT_EQ(read.blocks[b].type, written.blocks[b].type);
    EXPECT_EQ(read.blocks[b].nodes, written.blocks[b].nodes);
    EXPECT_EQ(read.blocks[b].volumes, written.blocks[b].volumes);
  }
  ASSERT_EQ(read.node_sets.size(), written.node_sets.size());
  for (std::size_t k = 0; k < read.node_sets.size(); ++k) {
    EXPECT_EQ(read.node_sets[k].name, written.node_sets[k].name);
    EXPECT_EQ(read.node_sets[k].nodes, written.node_sets[k].nodes);
  }
}

TEST(Mesh, SlicesAreContiguousAndEven) {
  const Communicator world;
  const TemporaryFolder folder(world);
  run_on_root(world, [&] { write_mesh(folder / "mixed.g", mixed_mesh()); });
  const PointCloud mine = read_exodus(folder / "mixed.g", world);
  EXPECT_LE(std::abs(static_cast<double>(mine.size()) - 5.0 / world.size()), 1);
  for (std::size_t i = 1; i < mine.size(); ++i) EXPECT_EQ(mine.ids[i], mine.ids[i - 1] + 1);
  EXPECT_EQ(world.sum(static_cast<std::int64_t>(mine.size())), 5);
}

TEST(Element, FrustumHasItsVolumeAndCentroid) {
  const double a = 2, b = 1, h = 3;
  std::array<Vector, 8> nodes;
  for (int n = 0; n < 8; ++n) {
    const double side = n < 4 ? a : b;
    nodes[n] = Vector(100, 200, 300) + Vector((cube[n][0] - 0.5) * side, (cube[n][1] - 0.5) * side, cube[n][2] * h);
  }
  const ElementPoint point = hexahedron(nodes);
  const double sum = a * a + a * b + b * b;
  EXPECT_NEAR(point.volume, h / 3 * sum, 1e-12);
  EXPECT_LT((point.centroid - Vector(100, 200, 300 + h / 4 * (a * a + 2 * a * b + 3 * b * b) / sum)).norm(), 1e-12);
}

TEST(Element, DistortedHexahedronHasTheVolumeOfTheClosedForm) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.25, 0.25);
  for (int trial = 0; trial < 20; ++trial) {
    std::array<Vector, 8> x;
    for (int n = 0; n < 8; ++n) x[n] = cube[n] + Vector(shift(random), shift(random), shift(random));
    // Grandy, Efficient computation of volume of hexahedral cells, UCRL-ID-128886 (1997).
    const auto triple = [](const Vector& u, const Vector& v, const Vector& w) { return u.dot(v.cross(w)); };
    const double expected = (triple(x[3] - x[1] + x[7] - x[2], x[6] - x[3], x[2] - x[0]) +
                             triple(x[4] - x[3] + x[5] - x[7], x[6] - x[4], x[7] - x[0]) +
                             triple(x[1] - x[4] + x[2] - x[5], x[6] - x[1], x[5] - x[0])) /
                            12;
    EXPECT_NEAR(hexahedron(x).volume, expected, 1e-14);
  }
}

// Points 0 … n−1 dealt to the ranks like cards and held in descending order: the worst case for the writer.
PointCloud dealt_cloud(int count, const Communicator& world) {
  PointCloud cloud;
  cloud.block_names = {"even", "empty", "odd"};
  cloud.set_names = {"all", "thirds"};
  for (int id = count - 1; id >= 0; --id) {
    if (id % world.size() != world.rank()) continue;
    cloud.ids.push_back(id);
    cloud.element_ids.push_back(1000 + id);
    cloud.positions.emplace_back(id, 2 * id, -id);
    cloud.volumes.push_back(1 + id);
    cloud.blocks.push_back(id % 2 == 0 ? 0 : 2);
    cloud.sets.push_back(id % 3 == 0 ? 3 : 1);
  }
  return cloud;
}

const std::vector<OutputField> all_fields = {
    {"Mass", 1, false}, {"Displacement", 3, true}, {"Stress", 6, false}, {"Temperature", 1, true}, {"F", 9, true}};

// Component c of field k at point id.
double value_of(std::size_t k, std::int64_t id, int c, double time) {
  return 1000.0 * static_cast<double>(id) + 100.0 * static_cast<double>(k) + c + time;
}

std::vector<std::vector<double>> columns_of(const PointCloud& cloud, double time) {
  std::vector<std::vector<double>> columns(all_fields.size());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    for (const std::int64_t id : cloud.ids) {
      for (int c = 0; c < all_fields[k].components; ++c) columns[k].push_back(value_of(k, id, c, time));
    }
  }
  return columns;
}

void expect_result(const fs::path& file, int points, const std::vector<double>& times) {
  const ExodusResult result = read_result(file);
  EXPECT_EQ(result.times, times);
  EXPECT_EQ(result.element_names,
            (std::vector<std::string>{"Mass", "StressXX", "StressYY", "StressZZ", "StressXY", "StressYZ", "StressZX"}));
  EXPECT_EQ(result.nodal_names,
            (std::vector<std::string>{"DisplacementX", "DisplacementY", "DisplacementZ", "Temperature", "FXX", "FXY",
                                      "FXZ", "FYX", "FYY", "FYZ", "FZX", "FZY", "FZZ"}));
  std::vector<std::int64_t> elements;  // ids in the file's order: the even block first
  for (int parity = 0; parity < 2; ++parity) {
    for (int id = parity; id < points; id += 2) elements.push_back(id);
  }
  for (std::size_t t = 0; t < times.size(); ++t) {
    for (int n = 0; n < points; ++n) {
      EXPECT_EQ(result.nodal[2][t][n], value_of(1, n, 2, times[t]));
      EXPECT_EQ(result.nodal[3][t][n], value_of(3, n, 0, times[t]));
      EXPECT_EQ(result.nodal[4 + 5][t][n], value_of(4, n, 5, times[t]));
      EXPECT_EQ(result.element[0][t][n], value_of(0, elements[n], 0, times[t]));
      EXPECT_EQ(result.element[1 + 3][t][n], value_of(2, elements[n], 3, times[t]));
    }
  }
}

TEST(Writer, FileIsTheSameOnAnyNumberOfRanks) {
  const Communicator world;
  const TemporaryFolder folder(world);
  constexpr int points = 25;
  const PointCloud cloud = dealt_cloud(points, world);
  {
    ExodusWriter writer(folder / "result.e", world, cloud, all_fields);
    for (const double time : {0.0, 0.25}) writer.write(time, columns_of(cloud, time));
  }
  if (world.rank() == 0) expect_result(folder / "result.e", points, {0.0, 0.25});
}

TEST(Writer, ResultIsAMeshAgain) {
  const Communicator world;
  const TemporaryFolder folder(world);
  const PointCloud cloud = dealt_cloud(25, world);
  { const ExodusWriter writer(folder / "result.e", world, cloud, {}); }
  const PointCloud whole = gathered(read_exodus(folder / "result.e", world), world);
  EXPECT_EQ(whole.block_names, cloud.block_names);
  EXPECT_EQ(whole.set_names, cloud.set_names);
  if (world.rank() != 0) return;
  ASSERT_EQ(whole.size(), 25u);
  for (std::size_t e = 0; e < whole.size(); ++e) {
    const auto id = static_cast<int>(e < 13 ? 2 * e : 2 * (e - 13) + 1);
    EXPECT_EQ(whole.element_ids[e], 1000 + id);
    EXPECT_EQ(whole.volumes[e], 1 + id);
    EXPECT_EQ(whole.blocks[e], id % 2 == 0 ? 0 : 2);
    EXPECT_EQ(whole.sets[e], id % 3 == 0 ? 3u : 1u);
    EXPECT_EQ(whole.positions[e], Vector(id, 2 * id, -id));
  }
}

TEST(Writer, FramesAreOnDiskBeforeTheFileIsClosed) {
  const Communicator world;
  const TemporaryFolder folder(world);
  const PointCloud cloud = dealt_cloud(12, world);
  ExodusWriter writer(folder / "result.e", world, cloud, all_fields);
  writer.write(0.5, columns_of(cloud, 0.5));
  if (world.rank() != 0) return;
  fs::copy_file(folder / "result.e", folder / "as_if_killed.e");
  expect_result(folder / "as_if_killed.e", 12, {0.5});
}

// As a run leaves it that is killed while it writes a frame: that one is counted, and not all of it there.
TEST(Writer, GoesOnAfterAFrameThatIsThereInPart) {
  const Communicator world;
  const TemporaryFolder folder(world);
  const PointCloud cloud = dealt_cloud(25, world);
  double sums[4] = {};  // by the number of frames
  const auto write = [&](int frames, const std::vector<double>& times) {
    ExodusWriter writer(folder / "result.e", world, cloud, all_fields, frames, sums[frames]);
    for (const double time : times) {
      writer.write(time, columns_of(cloud, time));
      sums[writer.frames()] = writer.sum();
    }
  };
  write(0, {0.0, 0.25, 0.5});
  for (const int lost : {8, 1000}) {
    if (world.rank() == 0) fs::resize_file(folder / "result.e", fs::file_size(folder / "result.e") - lost);
    world.barrier();
    EXPECT_THROW(write(3, {}), Error) << "all three are asked for";
    write(2, {0.75});
    if (world.rank() == 0) expect_result(folder / "result.e", 25, {0.0, 0.25, 0.75});
    world.barrier();
  }
}

TEST(Writer, NumbersOfNamelessBlocksAndOfElementsSurvive) {
  const Communicator world;
  const TemporaryFolder folder(world);
  PointCloud cloud = dealt_cloud(6, world);
  cloud.block_names = {"block_7", "block_3", "block_12"};
  { const ExodusWriter writer(folder / "result.e", world, cloud, {}); }
  EXPECT_EQ(read_exodus(folder / "result.e", world).block_names, cloud.block_names);
}

TEST(Writer, WrongColumnsAndPlacesAreErrorsOnAllRanks) {
  const Communicator world;
  const TemporaryFolder folder(world);
  const PointCloud cloud = dealt_cloud(6, world);
  ExodusWriter writer(folder / "result.e", world, cloud, all_fields);
  std::vector<std::vector<double>> columns = columns_of(cloud, 0);
  if (world.rank() == world.size() - 1) columns[1].pop_back();
  EXPECT_THROW(writer.write(0, columns), Error);
  writer.write(0, columns_of(cloud, 0));  // the file is as it was
  EXPECT_THROW(ExodusWriter(folder / "no/such/folder.e", world, cloud, {}), Error);
  PointCloud large = cloud;
  large.element_ids[0] = std::int64_t{1} << 40;  // the file holds 32 bits: an error, not another number
  EXPECT_THROW(ExodusWriter(folder / "large.e", world, large, {}), Error);
  EXPECT_THROW(ExodusWriter(folder / "x.e", world, cloud, {{"Tensor", 4, false}}), Error);
  EXPECT_THROW(ExodusWriter(folder / "y.e", world, cloud, {{std::string(200, 'n'), 1, false}}), Error);
}

TEST(Text, BlocksAreNamedByTheirNumbers) {
  const Communicator world;
  const TemporaryFolder folder(world);
  run_on_root(world, [&] {
    std::ofstream(folder / "points.txt") << "\xef\xbb\xbf# x y z block volume\n"  // some editors begin so
                                            "0 0 0  2 1e-9\n\n"
                                            "1.5e-3 0 -1  1 2e-9  # a comment\r\n"
                                            "  2 0 0  2 3e-9";
  });
  const PointCloud mine = read_text(folder / "points.txt", world);
  EXPECT_EQ(mine.block_names, (std::vector<std::string>{"block_1", "block_2"}));
  const PointCloud whole = gathered(mine, world);
  if (world.rank() != 0) return;
  EXPECT_EQ(whole.blocks, (std::vector<int>{1, 0, 1}));
  EXPECT_EQ(whole.volumes, (std::vector<double>{1e-9, 2e-9, 3e-9}));
  EXPECT_EQ(whole.positions[1], Vector(1.5e-3, 0, -1));
  EXPECT_EQ(whole.ids, (std::vector<std::int64_t>{0, 1, 2}));
}

// PeriLab's lists begin with a line that names the columns.
TEST(Text, PeriLabsListsOfPointsAreRead) {
  const Communicator world;
  const TemporaryFolder folder(world);
  run_on_root(world, [&] {
    std::ofstream(folder / "mesh.txt") << "header: x y z block_id volume\n"
                                          "0.0 0.0 0.5 1 1.0E-02\n"
                                          "0.1 0.0 0.5 2 2.0E-02\n"
                                          "0.1 0.1 0.5 1 1.0E-02\n";
  });
  const PointCloud mine = read_text(folder / "mesh.txt", world);
  EXPECT_EQ(mine.block_names, (std::vector<std::string>{"block_1", "block_2"}));
  const PointCloud whole = gathered(mine, world);
  if (world.rank() != 0) return;
  EXPECT_EQ(whole.element_ids, (std::vector<std::int64_t>{1, 2, 3}));  // the header has no number
  EXPECT_EQ(whole.blocks, (std::vector<int>{0, 1, 0}));
  EXPECT_EQ(whole.volumes, (std::vector<double>{0.01, 0.02, 0.01}));
  EXPECT_EQ(whole.positions[2], Vector(0.1, 0.1, 0.5));
}

TEST(History, KeepsAllDigitsAndEveryRow) {
  const Communicator world;
  const TemporaryFolder folder(world);
  HistoryFile history(folder / "history.csv", world, {{"Time", "s"}, {"Energy", "J"}});
  history.write(std::vector<double>{0.1, 1.0 / 3});
  history.write(std::vector<double>{-1e-300, 2});
  if (world.rank() == 0) {  // before it is closed
    std::ifstream file(folder / "history.csv");
    std::string facts, header;
    std::getline(file, facts);
    std::getline(file, header);
    EXPECT_TRUE(facts.starts_with("# strut ") && facts.ends_with("; units: s,J")) << facts;  // who wrote it
    EXPECT_EQ(header, "Time,Energy");
    double a = 0, b = 0, c = 0, d = 0;
    char comma = 0;
    file >> a >> comma >> b >> c >> comma >> d;
    EXPECT_EQ(a, 0.1);
    EXPECT_EQ(b, 1.0 / 3);
    EXPECT_EQ(c, -1e-300);
    EXPECT_EQ(d, 2);
    EXPECT_EQ(last_time_of_history(folder / "history.csv"), -1e-300);
    std::ofstream(folder / "other.csv") << "Time,Energy\n1,2\n";
    EXPECT_EQ(last_time_of_history(folder / "other.csv"), std::nullopt);
    EXPECT_EQ(last_time_of_history(folder / "none.csv"), std::nullopt);
  }
  EXPECT_THROW(history.write(std::vector<double>{1}), Error);
  EXPECT_THROW(HistoryFile(folder / "no/such/folder.csv", world, {{"Time", "s"}}), Error);
}

// Meshes and results of another code, where the checkout has them beside it.
struct ForeignFile {
  const char* path;
  std::int64_t points;
  double volume;
};

TEST(ForeignMesh, PointsAndVolume) {
  const Communicator world;
  const fs::path folder = fs::path(STRUT_SOURCE_DIR) / "../shared/peer-decks";
  if (!fs::exists(folder)) GTEST_SKIP() << "no meshes of another code at " << folder.lexically_normal();
  const ForeignFile files[] = {
      {"WaveInBar/WaveInBar.g", 525, 4.2e-6},
      {"Contact_Cubes/Contact_Cubes.g", 128, 2},
      {"ElasticCorrespondenceFullyPrescribedTension/ElasticCorrespondenceFullyPrescribedTension.g", 384, 6},
      {"ElasticPlasticCorrespondenceFullyPrescribedTension/ElasticPlasticCorrespondenceFullyPrescribedTension.g", 384,
       6},
      {"ViscoplasticNeedlemanFullyPrescribedTension_NoFlaw/"
       "ViscoplasticNeedlemanFullyPrescribedTension_NoFlaw_gold.e",
       384, 6},
  };
  for (const ForeignFile& file : files) {
    const PointCloud cloud = read_exodus(folder / file.path, world);
    EXPECT_EQ(world.sum(static_cast<std::int64_t>(cloud.size())), file.points) << file.path;
    const double volume = world.sum(std::accumulate(cloud.volumes.begin(), cloud.volumes.end(), 0.0));
    EXPECT_NEAR(volume, file.volume, 1e-12 * file.volume) << file.path;
  }
}

}  // namespace
}  // namespace strut::io

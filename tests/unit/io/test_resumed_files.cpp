// A run goes on with the files that it left, and with no others; and files of more than 4 GB a variable.
#include <gtest/gtest.h>

#include <fstream>

#include "base/archive.hpp"
#include "base/errors.hpp"
#include "base/files.hpp"
#include "base/parallel/communicator.hpp"
#include "io/checkpoint/checkpoint_file.hpp"
#include "io/exodus/exodus.hpp"
#include "io/exodus/exodus_file.hpp"
#include "io/netcdf/classic_netcdf.hpp"
#include "io/text/history.hpp"
#include "unit/io/bytes_and_errors.hpp"
#include "unit/temporary_folder.hpp"

namespace strut::io {
namespace {

namespace fs = std::filesystem;

class Resumed : public testing::Test {
 protected:
  const Communicator world;
  const TemporaryFolder folder{world};

  void write_bytes(const fs::path& file, const std::string& bytes) const {
    run_on_root(world, [&] { std::ofstream(file, std::ios::binary) << bytes; });
  }

  // Points on a line, in two blocks, dealt to the ranks.
  PointCloud cloud() const {
    PointCloud cloud;
    cloud.block_names = {"one", "two"};
    for (int id = world.rank(); id < 7; id += world.size()) {
      cloud.ids.push_back(id), cloud.element_ids.push_back(id + 1), cloud.volumes.push_back(1);
      cloud.positions.emplace_back(id, 0, 0), cloud.blocks.push_back(id % 2), cloud.sets.push_back(0);
    }
    return cloud;
  }

  // Frames at these times of a field at elements and one at nodes, of this value. Returns their check sum.
  double write_result(const fs::path& file, const std::vector<double>& times, double value, int frames = 0,
                      double sum = 0) const {
    const PointCloud points = cloud();
    ExodusWriter writer(file, world, points, {{"a", 1, false}, {"u", 3, true}}, frames, sum);
    const std::vector<std::vector<double>> columns = {std::vector<double>(points.size(), value),
                                                      std::vector<double>(3 * points.size(), -value)};
    for (const double time : times) writer.write(time, columns);
    return writer.sum();
  }
};

TEST_F(Resumed, AResultOfAnotherRunIsNotGoneOnWith) {
  const double sum = write_result(folder / "left.e", {0, 0.5, 1}, 2);
  write_result(folder / "later.e", {0, 0.5, 1.25}, 2);
  write_result(folder / "values.e", {0, 0.5, 1}, 2 + 1e-15);
  for (const char* name : {"later.e", "values.e"}) {
    const std::string before = bytes_of(folder / name);
    EXPECT_NE(error_of([&] { write_result(folder / name, {2}, 2, 3, sum); }).find("not the result that the run left"),
              std::string::npos)
        << name;
    EXPECT_EQ(bytes_of(folder / name), before) << name;
  }
  write_result(folder / "left.e", {2}, 2, 3, sum);
  if (world.rank() == 0) {
    EXPECT_EQ(read_result(folder / "left.e").times, (std::vector<double>{0, 0.5, 1, 2}));
  }
}

// Its first bytes are those of HDF5: the number of records of a classic file would be written over them.
TEST_F(Resumed, AResultThatWasConvertedStaysAsItIs) {
  const std::string content = "\x89HDF\r\n\x1a\n and what follows";
  write_bytes(folder / "converted.e", content);
  EXPECT_NE(error_of([&] { write_result(folder / "converted.e", {2}, 2, 3, 0); }).find("netCDF-4 (HDF5)"),
            std::string::npos);
  if (world.rank() == 0) {
    EXPECT_THROW(keep_records(folder / "converted.e", 3), Error);
  }
  world.barrier();
  EXPECT_EQ(bytes_of(folder / "converted.e"), content);
}

TEST_F(Resumed, AHistoryOfAnotherRunIsNotGoneOnWith) {
  const std::vector<HistoryColumn> columns = {{"Time", "s"}, {"Energy", "J"}};
  const auto write = [&](const char* name, double energy) {
    HistoryFile history(folder / name, world, columns);
    for (const double time : {0.0, 1.0}) history.write(std::vector<double>{time, energy});
    return std::pair(history.bytes(), history.sum());
  };
  auto [bytes, sum] = write("left.csv", 0.1);
  write("other.csv", 0.2);
  if (world.rank() != 0) bytes = 1;  // only rank 0 has the file; the others only know that there is one
  const std::string before = bytes_of(folder / "other.csv");
  EXPECT_NE(error_of([&] { HistoryFile(folder / "other.csv", world, columns, bytes, sum); }).find("has other rows"),
            std::string::npos);
  EXPECT_EQ(bytes_of(folder / "other.csv"), before);
  HistoryFile(folder / "left.csv", world, columns, bytes, sum).write(std::vector<double>{2, 0.1});
  EXPECT_NE(bytes_of(folder / "left.csv").find("\n2,0.1"), std::string::npos);
}

// 600 million nodes are more than a variable of the format with 64-bit offsets can have in a frame (2³² − 4 bytes).
// Unwritten parts of a file take no space on the disk; but the library moves them with every definition that follows,
// so the frames are those of a small file of the same format.
TEST_F(Resumed, AFrameMayBeLargerThanFourGigabytes) {
  run_on_root(world, [&] {
    constexpr std::int64_t many = 600'000'000, few = 5;
    ExodusFile::create(folder / "large.e", 8 * many).put_sizes(result_title, {3, many, 0, 0, 0});
    const ExodusFile large = ExodusFile::open(folder / "large.e");
    EXPECT_EQ(large.coordinates(many - 1, 1)[2], std::vector<double>{0});

    const std::vector<ExodusFile::Block> blocks = {{1, "all", "SPHERE", few, 1, {"radius", "volume"}}};
    {
      const ExodusFile file = ExodusFile::create(folder / "small.e", 8 * many);
      file.put_sizes(result_title, {3, few, few, 1, 0});
      file.put_blocks(blocks);
      file.put_variables(blocks, {"u"}, {"a"});
      for (const int step : {0, 1}) {
        file.put_time(step, step);
        file.put_nodal_values(step, 0, std::vector<double>{1.5, 2.5 + step}, few - 2);
        file.put_element_values(step, 0, blocks[0], std::vector<double>{3.5 + step}, few - 1);
      }
      file.flush();
    }
    EXPECT_EQ(bytes_of(folder / "small.e").substr(0, 4), "CDF\5");
    EXPECT_TRUE(is_of_kind(folder / "small.e", FileKind::result));
    EXPECT_EQ(classic_netcdf_problem(folder / "small.e"), "");
    const ExodusFile file = ExodusFile::open(folder / "small.e");
    EXPECT_EQ(file.nodal_values(0, 0, few - 2, 2), (std::vector<double>{1.5, 2.5}));
    EXPECT_EQ(file.nodal_values(1, 0, few - 2, 2), (std::vector<double>{1.5, 3.5}));
    EXPECT_EQ(file.element_values(1, 0, blocks[0], few - 1, 1), std::vector<double>{4.5});
    keep_records(folder / "small.e", 1);
    EXPECT_EQ(ExodusFile::open(folder / "small.e").times(), std::vector<double>{0});
  });
}

class Generations : public Resumed {
 protected:
  Snapshot snapshot(double value) const {
    Snapshot snapshot{{{"all", {}, {{"place", 3, {}}, {"stress", 1, {}}}}}, {{"time", value}}, {{"work", value}}};
    Snapshot::Group& group = snapshot.groups[0];
    for (std::int64_t id = world.rank(); id < 5; id += world.size()) group.ids.push_back(id);
    for (Snapshot::Column& column : group.columns) column.values.assign(column.width * group.ids.size(), value);
    return snapshot;
  }
  void write(double value) const { write_checkpoint(file, world, snapshot(value), "the deck"); }
  // The value that is restored, and the note.
  std::pair<double, std::string> read() const {
    Snapshot found = snapshot(0);
    std::string note = read_checkpoint(file, world, found);
    world.broadcast(note);
    EXPECT_EQ(facts_of_checkpoint(file, world).deck, "the deck");
    EXPECT_EQ(found.groups[0].columns[0].values, snapshot(found.numbers["time"]).groups[0].columns[0].values);
    return {found.numbers["time"], note};
  }
  const fs::path file = folder / "run.restart";
};

TEST_F(Generations, TheOneBeforeIsReadWhereTheNewestIsDamagedOrGone) {
  write(1);
  EXPECT_FALSE(fs::exists(before_of(file)));
  write(2);
  EXPECT_EQ(read(), (std::pair(2.0, std::string())));
  const std::string good = bytes_of(file);
  world.barrier();
  const std::string mark = "the deck", cut = good.substr(0, good.size() / 2);
  std::string header = good, deck = good;
  header[15] ^= 0x40, deck[good.find(mark)] ^= 1;
  for (const std::string& damaged : {cut, header, deck, std::string("hello"), std::string()}) {
    write_bytes(file, damaged);
    const auto [value, note] = read();
    EXPECT_EQ(value, 1) << note;
    EXPECT_NE(note.find("going on from the one before, " + before_of(file).string()), std::string::npos) << note;
  }
  run_on_root(world, [&] { fs::remove(file); });
  EXPECT_EQ(read().first, 1);
  write(3);
  EXPECT_EQ(read().first, 3);
  EXPECT_TRUE(fs::exists(before_of(file)));
  world.barrier();
  remove_checkpoint(file, world);
  EXPECT_FALSE(fs::exists(file) || fs::exists(before_of(file)));
}

// The check sum is of all numbers of the file, whether they are asked for or not.
TEST_F(Generations, NumbersThatNobodyAsksForAreNoDamage) {
  Snapshot more = snapshot(1), found = snapshot(0);
  more.numbers["crack"] = 7;
  write_checkpoint(file, world, more, "the deck");
  EXPECT_EQ(error_of([&] { read_checkpoint(file, world, found); }), "");
  EXPECT_EQ(found.numbers.at("time"), 1);
}

// A bit in each eighth byte of the values: whichever list has it is named.
TEST_F(Generations, EachListHasItsCheckSum) {
  write(1.25);
  const std::string good = bytes_of(file), value = std::string("\x3f\xf4\0\0\0\0\0\0", 8);  // 1.25 as it is stored
  world.barrier();
  std::string named;
  for (std::size_t at = good.find(value); at != std::string::npos; at = good.find(value, at + 8)) {
    std::string damaged = good;
    damaged[at + 7] ^= 1;
    write_bytes(file, damaged);
    const std::string error = error_of([this] { read(); });
    EXPECT_NE(error.find("is damaged: the check sum of "), std::string::npos) << at << error;
    for (const char* name : {"its numbers", "'work'", "'place' of all", "'stress' of all"}) {
      if (error.find(name) != std::string::npos && named.find(name) == std::string::npos) named += name;
    }
  }
  EXPECT_EQ(named, "its numbers'work''place' of all'stress' of all");
}

TEST_F(Generations, WhatIsNoCheckpointIsNotRemoved) {
  write(1), write(2);
  for (const fs::path& other : {before_of(file), part_of(file), file}) {
    write_bytes(other, "notes");
    EXPECT_NE(error_of([this] { remove_checkpoint(file, world); }).find("is no checkpoint of strut"),
              std::string::npos);
    EXPECT_EQ(bytes_of(other), "notes");
    world.barrier();
    run_on_root(world, [&] { fs::remove(other); });
  }
}

}  // namespace
}  // namespace strut::io

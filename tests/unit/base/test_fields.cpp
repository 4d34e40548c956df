#include <gtest/gtest.h>

#include <cstdint>

#include "base/fields.hpp"
#include "base/math/tensors.hpp"

namespace strut {
namespace {

struct Record {
  double first = 1, second = 2;
  static constexpr double Record::*numbers[] = {&Record::first, &Record::second};
};

// As a member of some state would: each field is one declaration.
struct State {
  FieldSet fields;
  PointField<Vector> velocity = fields.of_points<Vector>({.name = "velocity", .persistent = true});
  PointField<double> transient = fields.of_points<double>({.name = "transient"});
  PointField<std::uint8_t> mark = fields.of_points<std::uint8_t>({.name = "mark", .persistent = true}, When::if_used);
  PointField<Record> records = fields.add<std::vector<Record>>(
      At::integration_point, {{.name = "first", .width = 1}, {.name = "second", .persistent = true, .width = 1}});
};

// Integration points of two points, the places of which are not in the order of the points.
const FieldIndices two_a_point{2, [](std::size_t k, int q) { return 2 * (1 - k) + static_cast<std::size_t>(q); }};

State filled() {
  State state;
  state.fields.resize(2);
  state.records.use(4);
  state.velocity[1] = Vector(1, 2, 3);
  state.transient[0] = 7;
  state.records[2].second = 5;  // of the first point, at its first place
  return state;
}

Snapshot saved(State& state) {
  Snapshot snapshot;
  Archive archive = Archive::saving_to(snapshot);
  archive.points("all", {10, 11});
  state.fields.serialize(archive, two_a_point);
  return snapshot;
}

TEST(Fields, ASnapshotHasWhatIsKeptAndNothingElse) {
  State state = filled();
  const Snapshot snapshot = saved(state);
  ASSERT_EQ(snapshot.groups[0].columns.size(), 2u);
  EXPECT_EQ(snapshot.groups[0].columns[0].name, "velocity");
  EXPECT_EQ(snapshot.groups[0].columns[0].values, (std::vector<double>{0, 0, 0, 1, 2, 3}));
  EXPECT_EQ(snapshot.groups[0].columns[1].name, "second");
  EXPECT_EQ(snapshot.groups[0].columns[1].values, (std::vector<double>{5, 2, 2, 2}));
}

TEST(Fields, ComeBackFromASnapshot) {
  State state = filled();
  state.mark.use(2);
  state.mark[1] = 3;
  Snapshot snapshot = saved(state);
  State other;
  other.mark.use(2);
  other.fields.resize(2);
  other.records.use(4);
  Archive archive = Archive::loading_from(snapshot);
  archive.points("all", {10, 11});
  other.fields.serialize(archive, two_a_point);
  EXPECT_EQ(other.velocity[1], Vector(1, 2, 3));
  EXPECT_EQ(other.mark[1], 3);
  EXPECT_EQ(other.records[2].second, 5);
  EXPECT_EQ(other.records[2].first, 1) << "is not kept";
  EXPECT_EQ(other.transient[0], 0) << "is not kept";
}

TEST(Fields, BytesAreThoseOfTheValues) {
  State state = filled();
  EXPECT_EQ(state.fields.bytes(), 2 * sizeof(Vector) + 2 * sizeof(double) + 4 * sizeof(Record));
}

TEST(Fields, GoAlongWhereTheirOwnerIsMoved) {
  State state = filled();
  const State moved = std::move(state);
  EXPECT_EQ(moved.velocity[1], Vector(1, 2, 3));
  EXPECT_EQ(moved.velocity.size(), 2u);
}

}  // namespace
}  // namespace strut

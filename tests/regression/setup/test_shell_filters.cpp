// Bond filters by a mesh of shells cut what rectangles at the same places cut.
#include <gtest/gtest.h>

#include "io/exodus/exodus_file.hpp"
#include "regression/bodies.hpp"
#include "run/simulation.hpp"
#include "setup/families.hpp"
#include "unit/io/bytes_and_errors.hpp"

namespace strut::regression {
namespace {

using Corners = std::vector<std::vector<Vector>>;  // of triangles or quadrilaterals

// A block for the triangles, and one for the quadrilaterals; each element has nodes of its own.
void write_shells(const std::filesystem::path& file, const Corners& elements, std::int64_t dimensions = 3) {
  std::array<std::vector<double>, 3> places;
  std::vector<io::ExodusFile::Block> blocks;
  std::vector<std::vector<std::int64_t>> nodes;
  for (const std::size_t corners : {3, 4}) {
    nodes.emplace_back();
    for (const std::vector<Vector>& element : elements) {
      if (element.size() != corners) continue;
      for (const Vector& corner : element) {
        for (int c = 0; c < 3; ++c) places[c].push_back(corner[c]);
        nodes.back().push_back(static_cast<std::int64_t>(places[0].size()));
      }
    }
    const auto count = static_cast<std::int64_t>(nodes.back().size() / corners);
    blocks.push_back({.id = corners == 3 ? 70 : 80,
                      .name = "",
                      .type = corners == 3 ? "TRI3" : "quad",
                      .elements = count,
                      .nodes_per_element = static_cast<std::int64_t>(corners),
                      .attributes = {}});
  }
  io::ExodusFile out = io::ExodusFile::create(file);
  out.put_sizes("shells", {dimensions, static_cast<std::int64_t>(places[0].size()),
                           blocks[0].elements + blocks[1].elements, 2, 0});
  out.put_blocks(blocks);
  out.put_coordinates(places);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (blocks[b].elements > 0) out.put_connectivity(blocks[b], nodes[b]);
  }
}

// An upright rectangle at x = 2 mm, and a flat one that meets it at z = 3 mm, each of some parts.
Corners two_walls() {
  const auto at = [](double x, double y, double z) { return Vector(1e-3 * x, 1e-3 * y, 1e-3 * z); };
  Corners all;
  for (const double y : {-1.0, 0.7, 1.9}) {
    const double next = y < 0 ? 0.7 : y < 1 ? 1.9 : 5;
    all.push_back({at(2, y, -1), at(2, next, -1), at(2, next, 3), at(2, y, 3)});
  }
  all.push_back({at(2, -1, 3), at(5, -1, 3), at(5, 5, 3)});
  all.push_back({at(2, -1, 3), at(5, 5, 3), at(2, 5, 3)});
  return all;
}

std::string rectangle(const std::string& name, const std::string& x, const std::string& y, const std::string& z,
                      const std::string& normal, const std::string& bottom, const std::string& length,
                      const std::string& side) {
  const auto vector = [](const std::string& key_name, const std::string& axis) {
    std::string keys;
    for (const char* c : {"X", "Y", "Z"}) keys += key(key_name + "_" + c, axis == c ? "1" : "0");
    return keys;
  };
  return section(name, key("Type", "Rectangular_Plane") + vector("Normal", normal) +
                           vector("Bottom_Unit_Vector", bottom) + key("Lower_Left_Corner_X", x) +
                           key("Lower_Left_Corner_Y", y) + key("Lower_Left_Corner_Z", z) +
                           key("Bottom_Length", length) + key("Side_Length", side));
}

std::string with_filters(const Parts& parts, const std::string& filters) {
  return changed(parts.text(), R"(value="bar.g"/>)", R"(value="bar.g"/>)" + section("Bond Filters", filters));
}

std::vector<std::vector<std::int64_t>> families_of(const RunFolder& folder, const std::string& text) {
  const Scene scene = set_up(deck::read(folder.write("deck.xml", text), folder.world), folder.world);
  const Domain& domain = scene.body.domain;
  std::vector<std::vector<std::int64_t>> all;
  for (int i = 0; i < domain.owned; ++i) {
    all.push_back({domain.id(i)});
    domain.families.for_each(i, [&](int j) { all.back().push_back(domain.id(j)); });
    std::sort(all.back().begin() + 1, all.back().end());
  }
  return all;
}

TEST(ShellFilters, CutWhatRectanglesCut) {
  const RunFolder folder;
  run_on_root(folder.world, [&] { write_shells(folder / "shells.g", two_walls()); });
  const Parts parts;
  const std::string shells =
      with_filters(parts, section("walls", key("Type", "Exodus Mesh") + key("File Name", "shells.g")));
  // The other edge is along bottom × normal: y, and −y.
  const std::string rectangles =
      with_filters(parts, rectangle("upright", "2e-3", "-1e-3", "-1e-3", "X", "Z", "4e-3", "6e-3") +
                              rectangle("flat", "2e-3", "5e-3", "3e-3", "Z", "X", "3e-3", "6e-3"));
  const auto cut = families_of(folder, shells), expected = families_of(folder, rectangles);
  EXPECT_EQ(cut, expected);
  EXPECT_NE(cut, families_of(folder, parts.text()));
}

std::string wall(const RunFolder& folder, const std::string& file, double z) {
  const Vector x(6e-3, 0, 0), y(0, 6e-3, 0), corner(-1e-3, -1e-3, z);
  run_on_root(folder.world, [&] { write_shells(folder / file, {{corner, corner + x, corner + x + y, corner + y}}); });
  return section("wall", key("Type", "Exodus Mesh") + key("File Name", file));
}

TEST(ShellFilters, ThatCutNothingAreToldOf) {
  const RunFolder folder;
  const auto told = [&](const std::string& filters) {
    return told_at_the_start(deck::read(folder.write("deck.xml", with_filters({}, filters)), folder.world),
                             folder.world)
        .warnings;
  };
  EXPECT_NE(told(wall(folder, "far.g", 3)).find("Bond Filters: the crack of far.g cuts no bond; are its lengths in m"),
            std::string::npos);
  EXPECT_EQ(told(wall(folder, "near.g", 3e-3)).find("Bond Filters"), std::string::npos);
}

// The bar has 4 x 4 points at z = 2.5 mm. They keep bonds to each other only, which are enough for an ordinary solid.
TEST(BondFilters, ThroughALayerOfPointsAreToldOf) {
  const RunFolder folder;
  const std::string by_shells = wall(folder, "wall.g", 2.5e-3),
                    by_rectangle = rectangle("wall", "-1e-3", "5e-3", "2.5e-3", "Z", "X", "6e-3", "6e-3");
  Parts ordinary;
  ordinary.materials = changed(copper(), "Elastic Correspondence", "Elastic");
  for (const auto& [filter, name] : {std::pair(by_shells, "the crack of wall.g"),
                                     std::pair(by_rectangle, "the crack around (0.002, 0.002, 0.0025) m")}) {
    const deck::Deck deck = deck::read(folder.write("deck.xml", with_filters(ordinary, filter)), folder.world);
    const std::string told = told_at_the_start(deck, folder.world).warnings;
    EXPECT_NE(told.find(name + std::string(" runs through 16 points, one at (0.0005, 0.0005, 0.0025) m")),
              std::string::npos)
        << told;
    try {
      families_of(folder, with_filters({}, filter));
      ADD_FAILURE() << "correspondence needs neighbors that span space";
    } catch (const Error& error) {
      const std::string what = error.what();
      EXPECT_NE(what.find("16 points have too few neighbors"), std::string::npos) << what;
      EXPECT_NE(what.find("a crack (Bond Filters) runs through it"), std::string::npos) << what;
      EXPECT_EQ(what.find("Enlarge the horizon"), std::string::npos) << what;
    }
  }
}

// The file is no part of the checkpoint; the bonds that it has cut are known there.
TEST(ShellFilters, ThatHaveMovedAreNotThoseOfTheCheckpoint) {
  const RunFolder folder;
  const auto write = [&](double z) {
    const Corners wall = {{Vector(-1e-3, -1e-3, z), Vector(2e-3, -1e-3, z), Vector(2e-3, 5e-3, z)}};
    run_on_root(folder.world, [&] { write_shells(folder / "shells.g", wall); });
  };
  const auto error = [&](const std::string& until, Start start, const std::string& from = "") -> std::string {
    Parts parts;
    parts.conditions = along("flight", "Initial Velocity", "all", "z", "-20*z/1e-3");
    parts.times = key("Initial Time", from.empty() ? "0" : "1e-6") + key("Final Time", until);
    const std::string name = (folder / (from.empty() ? "first" : "second")).string();
    parts.output = key("Output Filename", name + ".e") + section("Output Variables", key("Displacement", "true"));
    const std::string deck = with_filters(parts,
                                          section("wall", key("Type", "Exodus Mesh") + key("File Name", "shells.g"))),
                      solver = R"(<ParameterList name="Solver">)";
    testing::internal::CaptureStdout();
    std::string text = "no error";
    try {
      run(folder.write("deck.xml",
                       changed(deck, solver, section("Restart", key("Filename", name + ".restart")) + from + solver)),
          folder.world, start);
    } catch (const Error& one) {
      text = one.what();
    }
    testing::internal::GetCapturedStdout();
    return text;
  };
  const std::string from = section("Start From", key("Checkpoint", (folder / "first.restart").string()));
  write(3e-3);
  EXPECT_EQ(error("1e-6", Start::anew), "no error");
  write(2e-3);
  EXPECT_NE(error("2e-6", Start::continued).find("points are bonded to others (by a mesh of Bond Filters"),
            std::string::npos);
  EXPECT_NE(error("2e-6", Start::anew, from).find("points are bonded to others (by a mesh of Bond Filters"),
            std::string::npos);
  write(3e-3);
  EXPECT_EQ(error("2e-6", Start::anew, from), "no error");
  EXPECT_EQ(error("2e-6", Start::continued), "no error");
}

// A run that spreads its points over the ranks anew needs no file for it.
TEST(ShellFilters, AreReadOnce) {
  const RunFolder folder;
  run_on_root(folder.world, [&] { write_shells(folder / "shells.g", two_walls()); });
  deck::Deck deck = deck::read(
      folder.write("deck.xml",
                   with_filters({}, section("walls", key("Type", "Exodus Mesh") + key("File Name", "shells.g")))),
      folder.world);
  read_cracks(deck, folder.world);
  const Scene scene = set_up(deck, folder.world);
  run_on_root(folder.world, [&] { std::filesystem::remove(folder / "shells.g"); });
  const auto bonds = [&](const Scene& one) {
    return folder.world.sum(static_cast<std::int64_t>(one.body.domain.families.bonds()));
  };
  const Scene again = set_up_again(deck, migration_state_of(scene, whole_cloud(scene.body.domain)), folder.world);
  EXPECT_EQ(bonds(again), bonds(scene));
}

TEST(ShellFilters, OfAWrongFileAreRefused) {
  const RunFolder folder;
  const auto error = [&](const std::string& file) -> std::string {
    try {
      families_of(folder, with_filters({}, section("walls", key("Type", "Exodus Mesh") + key("File Name", file))));
    } catch (const Error& one) {
      return one.what();
    }
    return "";
  };
  EXPECT_NE(error("none.g").find("expected a mesh of shells"), std::string::npos);
  EXPECT_NE(error("bar.g").find("expected triangles"), std::string::npos);
}

// Elements that would cut nothing, or elsewhere, without a word.
TEST(ShellFilters, OfDamagedMeshesAreRefused) {
  const RunFolder folder;
  const auto read_error = [&] { return io::error_of([&] { io::read_shells(folder / "shells.g", folder.world); }); };
  const auto error = [&](const Corners& elements, std::int64_t dimensions = 3) {
    run_on_root(folder.world, [&] { write_shells(folder / "shells.g", elements, dimensions); });
    return read_error();
  };
  const Vector a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(0, 1, 0), nowhere(std::nan(""), 0, 0);
  const auto is_told = [&](const std::string& told, const std::string& words) {
    EXPECT_NE(told.find(words), std::string::npos) << told;
  };
  EXPECT_EQ(error(two_walls()), "");
  run_on_root(folder.world, [&] {
    std::string bytes = io::bytes_of(folder / "shells.g");
    bytes.at(bytes.find(std::string{0, 0, 0, 70, 0, 0, 0, 80}) + 7) = 70;
    std::ofstream(folder / "shells.g", std::ios::binary) << bytes;
  });
  is_told(read_error(), "blocks 'block_70' (number 70, at place 1) and 'block_70' (number 70");
  is_told(error(two_walls(), 2), "has 2 dimensions, expected 3");
  is_told(error({{a, b, nowhere}}), "node 3: a coordinate is not a finite number");
  is_told(error({{a, b, c, d}, {a, b, a, b}}), "block 'block_80' element 2: it has no area");
  is_told(error({{a, b, b}}), "element 1: it has no area");
  for (const Corners& crossed : {Corners{{a, c, b, d}}, Corners{{a, b, d, c}}})
    is_told(error(crossed), "element 1: its corners cross");
  EXPECT_EQ(error({{a, b, c, c}, {a, a, b, c}}), "");  // triangles, as some programs write them
}

}  // namespace
}  // namespace strut::regression

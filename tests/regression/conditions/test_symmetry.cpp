// Symmetry planes: a quarter of a body between two of them, or a half behind one, is the whole body.
#include <gtest/gtest.h>

#include <numbers>

#include "regression/bodies.hpp"
#include "run/simulation.hpp"
#include "verification/larger.hpp"

namespace strut::regression {
namespace {

constexpr double h = 1e-3;  // m, spacing

// A bar of square cross-section, 2n cells wide, its axis z; or its quarter at x, y > 0. All turned.
struct Bar {
  int n = 3, layers = 5;
  bool whole = false;
  Tensor turn = Tensor::Identity();
  double taper = 0;  // it widens by this part over a spacing

  int across() const { return whole ? 2 * n : n; }
  io::Mesh mesh() const {
    io::Mesh mesh = Lattice{.nx = across(), .ny = across(), .nz = layers, .spacing = h}.mesh();
    const auto nodes_at = [&](int axis) {
      std::vector<int> at;
      for (int i = 0; i < static_cast<int>(mesh.nodes.size()); ++i) {
        if (mesh.nodes[i][axis] == 0) at.push_back(i);
      }
      return at;
    };
    mesh.node_sets.push_back({"left", nodes_at(0)});
    mesh.node_sets.push_back({"front", nodes_at(1)});
    for (Vector& X : mesh.nodes) {
      X -= (whole ? n * h : 0) * Vector(1, 1, 0);
      X.head<2>() *= 1 + taper * X[2] / h;
      X = turn * X;
    }
    return mesh;
  }
  // The places of the quarter's points, in the order of its file, in the file of the whole.
  std::vector<std::size_t> quarter(bool at_nodes) const {
    const int more = at_nodes ? 1 : 0;
    std::vector<std::size_t> places;
    for (int k = 0; k < layers + more; ++k) {
      for (int j = n; j < 2 * n + more; ++j) {
        for (int i = n; i < 2 * n + more; ++i) {
          places.push_back((static_cast<std::size_t>(k) * (2 * n + more) + j) * (2 * n + more) + i);
        }
      }
    }
    return places;
  }
};

std::string text_of(const Vector& v) {
  std::ostringstream text;
  text.precision(17);
  text << v[0] << " " << v[1] << " " << v[2];
  return text.str();
}

std::string planes(const Tensor& turn) {
  return plane("sx", "Symmetry Plane", "left", "0 0 0", text_of(turn.col(0))) +
         plane("sy", "Symmetry Plane", "front", "0 0 0", text_of(turn.col(1)));
}

// Thrown along its axis at a wall.
std::string impact(const Tensor& turn, double speed) {
  std::string all;
  for (int c = 0; c < 3; ++c) {
    std::ostringstream velocity;
    velocity.precision(17);
    velocity << -speed * turn(c, 2);
    all +=
        along(std::string("flight ") + "xyz"[c], "Initial Velocity", "all", std::string(1, "xyz"[c]), velocity.str());
  }
  return all + plane("wall", "Rigid Plane", "all", "0 0 0", text_of(turn.col(2)));
}

// Displacements of the last frame, turned back, in the order of the file; on rank 0.
std::vector<Vector> run_of(const RunFolder& folder, const Bar& bar, Parts parts, const std::string& how) {
  run_on_root(folder.world, [&] { io::write_mesh(folder / "bar.g", bar.mesh()); });
  parts.output = key("Output Filename", (folder / "result.e").string()) + key("Output Frequency", "100000") +
                 section("Output Variables", key("Displacement", "true"));
  testing::internal::CaptureStdout();
  run(folder.write("deck.xml", changed(parts.text(), "Verlet", how)), folder.world);
  testing::internal::GetCapturedStdout();
  std::vector<Vector> all;
  if (folder.world.rank() > 0) return all;
  const io::ExodusResult result = io::read_result(folder / "result.e");
  const auto column = [&](const std::string& name) {
    for (std::size_t v = 0; v < result.nodal_names.size(); ++v) {
      if (result.nodal_names[v] == name) return result.nodal[v].back();
    }
    throw std::logic_error("no variable " + name);
  };
  const auto x = column("DisplacementX"), y = column("DisplacementY"), z = column("DisplacementZ");
  for (std::size_t i = 0; i < x.size(); ++i) all.push_back(bar.turn.transpose() * Vector(x[i], y[i], z[i]));
  return all;
}

// The largest difference between displacements of the quarter and those of the whole, as a part of the largest of them.
// `conditions`: of the turn.
double difference(const Parts& parts, const std::function<std::string(const Tensor&)>& conditions, const Tensor& turn,
                  const std::string& how = "Verlet", double taper = 0) {
  const RunFolder folder;
  Parts of_whole = parts, of_quarter = parts;
  of_whole.conditions = conditions(Tensor::Identity());
  of_quarter.conditions = conditions(turn) + planes(turn);
  const Bar whole{.whole = true, .taper = taper}, quarter{.turn = turn, .taper = taper};
  const std::vector<Vector> all = run_of(folder, whole, of_whole, how), some = run_of(folder, quarter, of_quarter, how);
  if (folder.world.rank() > 0) return 0;
  const std::vector<std::size_t> places = quarter.quarter(parts.points == "Nodes");
  EXPECT_EQ(some.size(), places.size());
  double most = 0, largest = 0;
  for (std::size_t i = 0; i < some.size(); ++i) {
    most = larger(most, (some[i] - all[places[i]]).norm());
    largest = larger(largest, all[places[i]].norm());
  }
  EXPECT_GT(largest, 0);
  return most / largest;
}

Tensor turned_in_space() {
  return (Eigen::AngleAxisd(std::numbers::pi / 9, Vector::UnitX()) *
          Eigen::AngleAxisd(std::numbers::pi / 6, Vector::UnitZ()))
      .toRotationMatrix();
}

const std::string plastic = key("Yield Stress", "200e6");
const std::string viscous = key("Linear Viscosity", "0.1") + key("Quadratic Viscosity", "1.2");

// Copper with more keys, the first of which may be its model.
std::string material(const std::string& model, const std::string& keys) {
  return section("copper", key("Material Model", model) + key("Density", "8930") + key("Young's Modulus", "117e9") +
                               key("Poisson's Ratio", "0.35") + keys);
}

struct Case {
  std::string name, material, points = "Elements", horizon = key("Horizon Factor", "1.75");
  double speed = 100;
};

class Quarter : public testing::TestWithParam<Case> {
 protected:
  Parts parts() const {
    Parts parts;
    parts.materials = GetParam().material;
    parts.points = GetParam().points;
    parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + GetParam().horizon);
    parts.times = key("Final Time", "1.2e-6");
    parts.verlet = key("Fixed dt", "2e-8");  // an estimated one is of other bodies
    return parts;
  }
  std::function<std::string(const Tensor&)> thrown() const {
    return [](const Tensor& turn) { return impact(turn, GetParam().speed); };
  }
};

// Only round-off may remain: sums over families have another order, and a position of 5 mm is rounded to 1e-18 m in
// each of 60 steps, beside displacements of 0.1 mm; in flow such differences grow some hundredfold.
constexpr double round_off = 1e-10;

TEST_P(Quarter, IsTheWhole) { EXPECT_LT(difference(parts(), thrown(), Tensor::Identity()), round_off); }

TEST_P(Quarter, IsTheWholeWhereverItStands) {
  EXPECT_LT(difference(parts(), thrown(), turned_in_space()), 1e-9);  // coordinates of nodes are rounded, too
}

INSTANTIATE_TEST_SUITE_P(By, Quarter,
                         testing::Values(Case{"MeanGradient", material("Elastic Plastic Correspondence", plastic)},
                                         Case{"Silling", material("Elastic Plastic Correspondence",
                                                                  plastic + key("Stabilization", "Silling"))},
                                         Case{"LargeFamilies", material("Elastic Plastic Correspondence", plastic),
                                              "Elements", key("Horizon", "3.015e-3")},
                                         Case{"Ordinary", material("Elastic", ""), "Elements",
                                              key("Horizon Factor", "2.01"), 10},
                                         Case{"Nodes", material("Elastic Plastic Correspondence", plastic), "Nodes"},
                                         Case{"ViscousNodes",  // the distance of points is that of whole cells
                                              material("Elastic Plastic Correspondence", plastic + viscous), "Nodes"}),
                         [](const auto& info) { return info.param.name; });

// The four places of a cell by quadratic correspondence are no mirror images of each other: there the second order in
// the strain differs between a cell and its image. At this speed that is as little as the round-off of places, 1e-15 m,
// which falls with the speed: 2e-8 of the motion, 5e-8 turned in space.
TEST(Symmetry, OfQuadraticCellsIsThatOfSmallStrains) {
  Parts parts;
  parts.materials = material("Elastic Correspondence", key("Formulation", "Quadratic Correspondence"));
  parts.blocks =
      section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon Factor", "1.75"));
  parts.times = key("Final Time", "6e-7");
  parts.verlet = key("Fixed dt", "1e-8");
  const auto thrown = [](const Tensor& turn) { return impact(turn, 0.1); };
  EXPECT_LT(difference(parts, thrown, Tensor::Identity()), 1e-7);
  EXPECT_LT(difference(parts, thrown, turned_in_space()), 2e-7);  // what fits the motion of a cell has no direction
}

// Nodes at a non-reflecting end have the inertia that is before it: of the half or quarter cells on symmetry planes,
// too. The bar widens towards the end, so that its nodes have more than an eighth of each element.
TEST(Symmetry, OfNonReflectingEnds) {
  Parts parts;
  parts.points = "Nodes";
  const auto thrown = [](const Tensor&) {
    return along("pulse", "Initial Velocity", "all", "z", "10*sin(900*z)") +
           section("end", key("Type", "Non-Reflecting End") + key("Node Set", "top") + key("Normal", "0 0 1"));
  };
  EXPECT_LT(difference(parts, thrown, Tensor::Identity(), "Verlet", 0.1), round_off);
}

// A free cylinder, with friction, that is its own image. Its part of the mass is that of the part of the bar.
TEST(Symmetry, IsThatOfAFreeToolOnIt) {
  Parts parts;
  parts.times = key("Final Time", "1.5e-6");
  parts.verlet = key("Fixed dt", "2e-8");
  parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon", "2.01e-3") +
                                      key("Separate Body", "true"));
  const auto struck = [](const Tensor& turn) {
    std::string speeds;
    for (int c = 0; c < 3; ++c) speeds += key(std::string("Speed ") + "XYZ"[c], std::to_string(-100 * turn(c, 2)));
    return impact(turn, 1) +
           section("tool", key("Type", "Rigid Cylinder") + key("Point", text_of(8.01 * h * turn.col(2))) +
                               key("Axis", text_of(turn.col(1))) + key("Radius", "3e-3") + speeds +
                               key("Friction Coefficient", "0.3") + key("Mass", turn.isIdentity() ? "4e-4" : "1e-4"));
  };
  EXPECT_LT(difference(parts, struck, turned_in_space()), 1e-6);  // digits of the speeds
}

// Also where bonds break in the first step that strains the body: what is counted and fitted then, by the places at the
// start of the step, is of images behind the planes.
TEST(Symmetry, OfBondsThatBreakInTheFirstStep) {
  Parts parts;
  parts.damage = section("brittle", key("Damage Model", "Critical Stretch") + key("Critical Stretch", "3e-3"));
  parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") +
                                      key("Horizon Factor", "1.75") + key("Damage Model", "brittle"));
  parts.times = key("Final Time", "1e-6");
  const auto torn = [](const Tensor&) { return along("tear", "Initial Velocity", "all", "z", "50*sin(900*z)"); };
  EXPECT_LT(difference(parts, torn, Tensor::Identity()), round_off);
  // Half cells carry stress with as few bonds as the whole ones do.
  parts.points = "Nodes";
  parts.times = key("Final Time", "2e-6");
  EXPECT_LT(difference(parts, torn, Tensor::Identity()), round_off);
}

// Lattices have families that are left just as steep as a point may be: round-off must not decide which carry stress.
TEST(Symmetry, OfFamiliesAtTheLimitOfSteepness) {
  Parts parts;
  parts.materials = material("Elastic Plastic Correspondence", plastic);
  parts.damage = section("brittle", key("Damage Model", "Critical Stretch") + key("Critical Stretch", "3e-3"));
  parts.blocks = section("metal", key("Block Names", "all") + key("Material", "copper") +
                                      key("Horizon Factor", "1.75") + key("Damage Model", "brittle"));
  parts.times = key("Final Time", "1e-6");
  parts.verlet = key("Fixed dt", "5e-8");
  const auto torn = [](const Tensor&) {
    return along("tear", "Initial Velocity", "all", "z", "3e4*(z - 2.5e-3)*(1 + 3e4*(x*x + 2*y*y))");
  };
  EXPECT_LT(difference(parts, torn, Tensor::Identity()), round_off);
}

// Equilibria are found to 1e-9 of the forces, with the same tangent.
TEST(Symmetry, IsThatOfEquilibria) {
  Parts parts;
  const std::string hardening = section("Hardening", key("Type", "Linear") + key("Hardening Modulus", "5e9"));
  parts.materials = material("Elastic Plastic Correspondence", plastic + hardening);
  parts.blocks =
      section("metal", key("Block Names", "all") + key("Material", "copper") + key("Horizon Factor", "1.75"));
  parts.times = key("Final Time", "1");
  parts.verlet = key("Number of Load Steps", "2") + key("Tolerance", "1e-9");
  const auto pressed = [](const Tensor&) {
    return along("foot", "Prescribed Displacement", "foot", "xyz", "0") +
           along("press", "Prescribed Displacement", "top", "z", "-4e-5*t");
  };
  EXPECT_LT(difference(parts, pressed, Tensor::Identity(), "QuasiStatic"), 1e-7);
}

// Points that are no end of a body have no mirror image; a warning tells users who may have meant one.
TEST(Symmetry, IsToldWhereThereIsNone) {
  const auto warnings = [](const std::string& sets, const std::string& plane_of_deck, const std::string& more = "") {
    const RunFolder folder;
    Parts parts;
    parts.node_sets = sets;
    parts.conditions = plane_of_deck;
    if (!more.empty()) parts.contact = more;
    Simulation run(folder, parts);
    EXPECT_EQ(run.body().domain.mirrors.empty(), more.empty());
    return run.advice.warnings;
  };
  const std::string path = "WARNING: Boundary Conditions > p: ";
  const auto on = [](const std::string& set, const std::string& point) {
    return plane("p", "Symmetry Plane", set, point, "0 0 1");
  };
  const std::string set = key("some", "z &lt; 1e-3 &amp;&amp; x &lt; 2e-3");
  EXPECT_NE(warnings(set, on("some", "0 0 0")).find(path + "8 points at the plane are not in the set"),
            std::string::npos);
  EXPECT_NE(warnings(set, on("foot", "0 0 0.4e-3")).find(path + "the plane runs through elements"), std::string::npos);
  for (const std::string off : {"-", ""}) {
    EXPECT_NE(warnings(set, on("foot", "0 0 " + off + "5e-5"))
                  .find(path + "the plane is about 5e-05 m off the faces of 16 elements of the set"),
              std::string::npos);
  }
  EXPECT_NE(warnings(set, on("foot", "0 0 3e-3")).find(path + "the body of its points lies on both sides"),
            std::string::npos);
  EXPECT_EQ(warnings(set, on("all", "0 0 0")).find(path), std::string::npos);
  const std::string self = contact_of({{"bar", "bar"}}, "1e-3", "1e12");
  EXPECT_NE(warnings(set, on("foot", "0 0 0"), self).find(path + "contact does not see mirror images"),
            std::string::npos);
}

TEST(Symmetry, OfTwoBodiesOnOnePlaneIsToldOnceThatContactDoesNotSeeIt) {
  Lattice two;
  two.plate_layers = 2;
  const RunFolder folder(two);
  Parts parts;
  parts.node_sets = key("side", "x &lt; 1e-3");
  parts.conditions = plane("p", "Symmetry Plane", "side", "0 0 0", "1 0 0");
  parts.blocks = changed(parts.blocks, "all", "bar");
  parts.blocks += section("plate", key("Block Names", "plate") + key("Material", "copper") + key("Horizon", "2.01e-3") +
                                       key("Separate Body", "true"));
  parts.contact = contact_of({{"bar", "plate"}}, "1e-3", "1e12");
  const Simulation run(folder, parts);
  EXPECT_EQ(run.scene.body.domain.mirrors.size(), 2);
  const std::string& told = run.advice.warnings;
  EXPECT_NE(told.find("contact does not see mirror images"), std::string::npos) << told;
  EXPECT_EQ(told.find("contact does not see mirror images"), told.rfind("contact does not see mirror images")) << told;
}

// Bonds to images run by nodes on the plane, which coordinates in single precision and normals of three digits miss.
TEST(Symmetry, IsThatOfAPlaneThatMissesItsNodesByRoundOff) {
  const auto bonds = [](Parts parts, const std::string& point, const std::string& normal) {
    const RunFolder folder;
    parts.conditions = plane("p", "Symmetry Plane", "foot", point, normal);
    const Simulation run(folder, parts);
    EXPECT_EQ(run.advice.warnings.find("> p:"), std::string::npos) << run.advice.warnings;
    return run.world().sum(static_cast<std::int64_t>(run.scene.body.domain.families.bonds()));
  };
  Parts quadratic, visible;
  quadratic.materials = material("Elastic Correspondence", key("Formulation", "Quadratic Correspondence"));
  visible.blocks = changed(visible.blocks, key("Material", "copper"),
                           key("Material", "copper") + key("Bonds Across Voids", "false"));
  Parts at_nodes = visible;
  at_nodes.points = "Nodes";
  for (const Parts& parts : {quadratic, visible, at_nodes}) {
    const auto all = bonds(parts, "0 0 0", "0 0 1");
    EXPECT_EQ(bonds(parts, "0 0 1e-8", "0 0 1"), all);
    EXPECT_EQ(bonds(parts, "0 0 -1e-8", "0 0.0005 1"), all);
  }
}

// Foams cut by a plane have cells at it that are filled at their far side only, and cells behind these into which small
// ones at the plane were merged. The face of the former towards the plane is surface, and no bonds cross the void,
// where no cell is filled up to the plane.
TEST(Symmetry, IsThatOfCellsFilledAtTheirFarSide) {
  const RunFolder folder;
  const auto bonds = [&folder](double x_of_void, const std::string& formulation) {
    io::Mesh mesh = Lattice{}.mesh();
    io::Mesh::Block& bar = mesh.blocks[0];
    for (std::size_t e = 0; e < bar.elements(); ++e) {
      const Vector middle = 0.5 * (mesh.nodes[bar.nodes[8 * e]] + mesh.nodes[bar.nodes[8 * e + 6]]);
      const bool at_plane = middle[2] < h, far = at_plane && middle[0] < x_of_void, merged = e == 31;
      const double below = far ? 0.7 * h : merged ? 0.1 * h : middle[2] - 0.5 * h, above = middle[2] + 0.5 * h;
      io::PartialCell cell{.volume = merged ? 0.9 * h * h * h : h * h * (above - below), .centroid = middle};
      cell.centroid[2] = 0.5 * (below + above);
      cell.moments << h * h / 12, h * h / 12, (above - below) * (above - below) / 12, 0, 0, 0;
      if (at_plane) {
        cell.surface[2] = -h * h;
        cell.surface_moments(2, 2) = 0.5 * h * h * (above - below);
      }
      bar.cells.push_back(cell);
    }
    run_on_root(folder.world, [&] { io::write_mesh(folder / "bar.g", mesh); });
    Parts parts;
    parts.materials = material("Elastic Correspondence", key("Formulation", formulation));
    parts.conditions = plane("p", "Symmetry Plane", "foot", "0 0 0", "0 0 1");
    const Simulation run(folder, parts);
    EXPECT_EQ(run.scene.body.domain.mirrors.size(), 1);
    EXPECT_EQ(run.advice.warnings.find("> p:"), std::string::npos) << run.advice.warnings;
    double surface = 0;  // m²
    for (int i = 0; i < run.scene.body.owned(); ++i) {
      if (run.reference(i)[2] < h) surface -= run.scene.body.domain.cloud.shapes[i].surface[2];
    }
    EXPECT_NEAR(run.world().sum(surface), 4 * h * x_of_void, 1e-9 * h * h);  // round-off
    return run.world().sum(static_cast<std::int64_t>(run.scene.body.domain.families.bonds()));
  };
  bonds(2 * h, "Correspondence");
  const std::string quadratic = "Quadratic Correspondence";
  // From column 0 to the images of columns 0 and 1, and from 1 to those of 0: 10 each, as common nodes are in the void.
  EXPECT_EQ(bonds(0, quadratic) - bonds(2 * h, quadratic), 30);
}

// Faces on a plane are surface unless the body that they are of goes on behind it: the plane of a block is plane
// strain, as that of `all`, and a plate beside a bar that goes on ends there.
TEST(Symmetry, TakesFacesFromTheSurfaceOnlyWhereImagesAre) {
  struct Areas {
    double below, left_of_bar, left_of_plate;  // squares of the spacing
  };
  const auto areas = [](const std::string& points, const std::string& conditions) {
    const RunFolder folder({.plate_layers = 2});
    Parts parts;
    parts.points = points;
    parts.node_sets = key("left", "x &lt; 0.9e-3 &amp;&amp; z &lt; 4.1e-3");  // all of the bar's points there
    const auto block = [](const std::string& name) {
      return section(name, key("Block Names", name) + key("Material", "copper") + key("Horizon", "2.01e-3") +
                               key("Separate Body", "true") + key("Bonds Across Voids", "false"));
    };
    parts.blocks = block("bar") + block("plate");
    parts.conditions = conditions;
    const Simulation run(folder, parts);
    const PointCloud& cloud = run.scene.body.domain.cloud;
    double sums[3] = {0, 0, 0};
    for (int i = 0; i < run.scene.body.owned(); ++i) {
      const bool is_plate = cloud.block_names[cloud.blocks[i]] == "plate";
      if (run.reference(i)[2] < 0.9e-3) sums[0] -= cloud.shapes[i].surface[2] / (h * h);
      if (run.reference(i)[0] < 0.9e-3) sums[is_plate ? 2 : 1] -= cloud.shapes[i].surface[0] / (h * h);
    }
    run.world().sum(sums);
    return Areas{sums[0], sums[1], sums[2]};
  };
  constexpr double round_off_of_sums = 1e-9;
  for (const std::string points : {"Elements", "Nodes"}) {
    const Areas all = areas(points, plane("p", "Symmetry Plane", "all", "0 0 0", "0 0 1"));
    const Areas blocks = areas(points, plane("p", "Symmetry Plane", "bar", "0 0 0", "0 0 1"));
    const Areas mirrored = areas(points, plane("p", "Symmetry Plane", "foot", "0 0 0", "0 0 1"));
    EXPECT_NEAR(all.below, 16, round_off_of_sums);
    EXPECT_NEAR(blocks.below, 16, round_off_of_sums);
    EXPECT_NEAR(mirrored.below, 0, round_off_of_sums);
    const Areas part = areas(points, plane("p", "Symmetry Plane", "left", "0 0 0", "1 0 0"));
    EXPECT_NEAR(part.left_of_plate, all.left_of_plate, round_off_of_sums);
    EXPECT_NEAR(part.left_of_bar, 0, round_off_of_sums);
  }
}

}  // namespace
}  // namespace strut::regression

#include "subjects.hpp"

#include <exodusII.h>

#include <algorithm>
#include <fstream>

#include "base/errors.hpp"
#include "base/math/function.hpp"
#include "files.hpp"
#include "io/checkpoint/checkpoint_file.hpp"
#include "io/exodus/exodus.hpp"
#include "mesh/arrays.hpp"
#include "mesh/body.hpp"
#include "mesh/recipe.hpp"
#include "meshes.hpp"
#include "mutate.hpp"
#include "point/path.hpp"

namespace strut::fuzz {

namespace {

namespace fs = std::filesystem;

std::string change_text(const std::string& sample, const std::string& other, Random& random) {
  if (random.chance(0.6)) return reworded(sample, random);
  return damaged(random.chance(0.5) ? sample : reworded(sample, random), other, random);
}

// ---- Exodus

// HDF5 compares sizes; other damage within may crash it.
std::string damaged_or_cut(const std::string& sample, const std::string& other, Random& random) {
  const std::string_view hdf5 = "\x89HDF";
  if (std::string bytes = damaged(sample, other, random); !bytes.starts_with(hdf5)) return bytes;
  return sample.starts_with(hdf5) ? sample.substr(0, random.below(sample.size())) : sample;
}

// The same file in another format of netCDF.
std::string converted(const fs::path& file, int mode) {
  const fs::path copy = fs::path(file).replace_extension(".copy");
  int word = 8, stored = 0;
  float version = 0;
  const int in = ex_open(file.c_str(), EX_READ, &word, &stored, &version);
  int stored_word = 8;
  const int out = ex_create(copy.c_str(), EX_CLOBBER | mode, &word, &stored_word);
  if (in < 0 || out < 0 || ex_copy(in, out) < 0) throw std::runtime_error("cannot convert " + file.string());
  ex_close(in);
  ex_close(out);
  return contents(copy);
}

void write_result(const fs::path& file, const Communicator& world) {
  PointCloud cloud;
  cloud.block_names = {"a", "b"};
  cloud.set_names = {"left"};
  for (int n = 0; n < 6; ++n) {
    cloud.ids.push_back(n);
    cloud.element_ids.push_back(n + 1);
    cloud.positions.emplace_back(n, 0, 0);
    cloud.volumes.push_back(1);
    cloud.spacings.push_back(1);
    cloud.blocks.push_back(n / 3);
    cloud.sets.push_back(n == 0);
  }
  io::ExodusWriter writer(file, world, cloud, {{"Displacement", 3, true}, {"Volume", 1, false}});
  const std::vector<std::vector<double>> columns = {std::vector<double>(18, 1), std::vector<double>(6, 1)};
  for (const double time : {0.0, 1.0}) writer.write(time, columns);
}

std::vector<std::string> exodus_samples(const fs::path& folder, const Communicator& world) {
  io::Mesh boxes;
  add_box(boxes, "bar", 1e-3, 0, {"foot", "top"});
  add_box(boxes, "plate", 1e-3, 5e-3, {});
  io::write_mesh(folder / "hexahedra.g", boxes);
  io::write_mesh(folder / "tetrahedra.g", tetrahedra());
  io::write_mesh(folder / "spheres.g", spheres());
  write_result(folder / "result.g", world);
  std::vector<std::string> samples;
  for (const char* name : {"hexahedra.g", "tetrahedra.g", "spheres.g", "result.g"}) {
    samples.push_back(contents(folder / name));
    samples.push_back(converted(folder / name, EX_NETCDF4 | EX_NOCLASSIC));
  }
  samples.push_back(converted(folder / "tetrahedra.g", EX_NORMAL_MODEL));
  return samples;
}

std::vector<Subject> exodus(const fs::path& folder, const Communicator& world) {
  const std::vector<std::string> all = exodus_samples(folder, world);
  const std::vector<std::string> solids(all.begin(), all.begin() + 4);  // hexahedra and tetrahedra, in both formats
  const auto elements = [&world](const fs::path& file) { io::read_exodus(file, world); };
  const auto nodes = [&world](const fs::path& file) { io::read_exodus(file, world, PointsAt::nodes); };
  return {{"exodus", "mesh.g", all, damaged_or_cut, elements},
          {"nodes", "solid.g", solids, damaged_or_cut, nodes},
          {"mesh", "raw.g", all, damaged_or_cut, [](const fs::path& file) { io::read_mesh(file); }},
          {"result", "result.e", all, damaged_or_cut, [](const fs::path& file) { io::read_result(file); }}};
}

// ---- text

Subject points(const Communicator& world) {
  const auto read = [&world](const fs::path& file) { io::read_text(file, world); };
  return {
      "text", "points.txt", {"# points\n0 0 0 1 1e-9\n1e-3 0 0 1 1e-9\n\n0 1e-3 0 2 2e-9 # last\n"}, change_text, read};
}

// A million cells are what a recipe may ask for; here they would only cost time.
bool is_small(const mesh::Body& body) {
  const double across = 2 * std::max(body.radius, body.top_radius);
  const Vector extent = body.size.cwiseMax(Vector(across, across, body.length)) / body.spacing;
  if (body.shape == mesh::Body::Shape::file) return true;
  const double cells = extent.cwiseMax(1).prod();
  const bool foam = body.shape == mesh::Body::Shape::foam;
  const double seeds = foam ? (body.size / body.cell).cwiseMax(1).prod() : 0;
  return !(cells < 1e8) || (cells < 1e5 && !(seeds > 1e4));  // of too many an error is expected
}

void read_recipe(const fs::path& file) {
  io::Mesh mesh;
  std::string summary;
  for (const mesh::Body& body : mesh::read_recipe(file)) {
    if (is_small(body)) mesh::append(mesh, mesh::mesh_of(body, summary));
  }
}

Subject recipes() {
  const std::vector<std::string> samples = {
      "name = bar\nshape = cylinder\nlength = 0.01\nradius = 0.002\nspacing = 1e-3\ncentred = point\n",
      "shape = cylinder\nmethod = fitted\nlength = 0.01\nradius = 0.002\nspacing = 5e-4\ngrading = 1.1\nuniform = "
      "2e-3\n"
      "coarsest = 1e-3\norigin = 0 0 1\n",
      "elements = sphere\nspacing = 1e-3\n[body]\nname = a\nshape = box\nsize = 3e-3 3e-3 4e-3\n[body]\nname = "
      "b\nshape = "
      "cone\nlength = 5e-3\nradius = 2e-3\ntop_radius = 1e-3\n",
      "shape = foam\nsize = 1e-3 1e-3 1e-3\nspacing = 1e-4\ncells = 2\nsmallest_cell = 0.2\ncell = 4e-4\n"
      "relative_density = 0.1\n",
      "shape = foam\nsize = 1e-3 1e-3 1e-3\nspacing = 5e-5\ncell = 4e-4\nrelative_density = 0.1\nseed = "
      "3\nirregularity = "
      "0.5\n",
      "[body]\nname = scan\nshape = file\nfile = spheres.g\norigin = 0 0 1\n[body]\nname = plate\nshape = box\nspacing "
      "= "
      "1\nsize = 3 3 1\n"};
  return {"recipe", "body.recipe", samples, change_text, read_recipe};
}

std::string raw(const auto& numbers) {
  return std::string(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(numbers[0]));
}

std::string voxels_sample() {
  return "strut-mesh arrays 1\nnodes 0\nvoxels foam 4 3 2 4 2 0.3 grey\n" +
         raw(std::vector<double>{0.1, 0.2, 0.1, 0, 0, 0}) +
         raw(std::vector<std::int32_t>{0, 0, 0, 1, 0, 0, 2, 1, 2, 2, 1, 3}) + raw(std::vector<double>{1, 0.5, 1, 0.7}) +
         "voxels plate 2 2 1 1 2 0.3 solid 3\n" + raw(std::vector<double>{0.1, 0.2, 0.1, 0, 0, 0}) +
         raw(std::vector<std::int32_t>{0, 0, 0, 1, 0, 0}) + "end\n";
}

// A grey image with noise, as a scan has: pieces that are dropped beside others that are kept.
std::string noisy_sample(int factor) {
  constexpr int edge = 8;
  std::vector<std::int32_t> places;
  std::vector<double> fills;
  Random random(1);
  for (int v = 0; v < edge * edge * edge; ++v) {
    const int i = v % edge, j = v / edge % edge, k = v / edge / edge;
    const double strut = i > 2 && i < 6 && j > 2 && j < 6 ? 0.8 : 0;
    const double fill = std::min(1.0, strut + 0.5 * (static_cast<double>(random.below(1000)) / 1000 - 0.5));
    if (fill <= 0) continue;
    places.insert(places.end(), {i, j, k});
    fills.push_back(fill);
  }
  return "strut-mesh arrays 1\nnodes 0\nvoxels foam " + std::to_string(fills.size()) + " 8 8 8 " +
         std::to_string(factor) + " 0.3 grey\n" + raw(std::vector<double>{0.1, 0.1, 0.1, 0, 0, 0}) + raw(places) +
         raw(fills) + "end\n";
}

// Which parts of a noisy image are solid, and how much: other pieces are dropped, merged and cut.
std::string change_fills(const std::string& sample, Random& random) {
  std::string changed = sample;
  const std::size_t header = sample.find("grey\n") + 5, end = sample.size() - 4;
  const std::size_t first = header + 48 + (end - header - 48) * 12 / 20;  // edges and corner, places (12), fills (8)
  for (std::size_t at = first; at + 8 <= end; at += 8) {
    const double fill = random.chance(0.3) ? 1 : (1 + static_cast<double>(random.below(999))) / 1000;
    changed.replace(at, 8, raw(std::vector<double>{fill}));
  }
  return changed;
}

Subject arrays() {
  const auto read = [](const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    mesh::read_arrays(stream, "arrays");
  };
  const auto change = [](const std::string& sample, const std::string& other, Random& random) {
    const bool noisy = sample.find("plate") == std::string::npos;
    return noisy && random.chance(0.7) ? change_fills(sample, random) : change_text(sample, other, random);
  };
  const std::vector<std::string> samples = {voxels_sample(), noisy_sample(1), noisy_sample(2)};
  return {"arrays", "mesh.arrays", samples, change, read};
}

Subject paths() {
  const auto read = [](const fs::path& file) { point::read_path(file, point::all_strain); };
  return {"path",
          "path.csv",
          {"t, xx, yy, zz, xy, yz, zx\n0,0,0,0,0,0,0\n1, 0.1, 0,0,0,0,0\n# end\n2,0.2,0,0,0,0,0\n"},
          change_text,
          read};
}

Subject expressions() {
  const auto change = [](const std::string& sample, const std::string& other, Random& random) {
    if (random.chance(0.7)) return expression(random);
    return random.chance(0.5) ? reworded(sample, random) : damaged(sample, other, random);
  };
  const auto read = [](const fs::path& file) {
    const Function function = Function::parse(contents(file));
    for (const double x : {0.0, -1.0, 1e300}) function(x, 0.5, -x, 1e-3);
  };
  const std::vector<std::string> samples = {
      "-1.5*t*(1 + 100*x)*(2 - 200*y)", "value = 0; if (t < 1e-4) { value = 5*sin(x); } else { value = t^2; }",
      "double r = x*x + y*y; value = sqrt(r) < 0.5 && !(z > 1) || pow(x, 2) == 0;"};
  return {"expression", "expression.txt", samples, change, read};
}

// ---- checkpoints

Snapshot small_snapshot() {
  Snapshot snapshot;
  snapshot.groups = {{"all points", {2, 0, 1}, {{"position", 3, std::vector<double>(9, 0.5)}, {"state", 1, {1, 2, 3}}}},
                     {"block a", {}, {{"state", 2, {}}}}};
  snapshot.numbers = {{"time", 1e-6}, {"steps", 12}};
  snapshot.rank_sums = {{"work", -3.5}};
  return snapshot;
}

Subject checkpoint(const fs::path& folder, const Communicator& world) {
  io::write_checkpoint(folder / "run.restart", world, small_snapshot(), "<ParameterList/>");
  const auto read = [&world](const fs::path& file) {
    Snapshot snapshot = small_snapshot();
    io::read_checkpoint(file, world, snapshot);
    if (snapshot.groups[0].columns[1].values != small_snapshot().groups[0].columns[1].values) {
      throw std::logic_error("a damaged file was taken for a good one");
    }
  };
  return {"restart", "broken.restart", {contents(folder / "run.restart")}, damaged, read};
}

}  // namespace

std::vector<Subject> all_subjects(const fs::path& folder, const Communicator& world) {
  std::vector<Subject> all = exodus(folder, world);
  const Subject deck = decks(folder, world);
  all.insert(all.end(), 4, deck);  // the most can be said wrongly there
  for (const Subject& subject :
       {points(world), recipes(), arrays(), paths(), expressions(), checkpoint(folder, world)}) {
    all.push_back(subject);
  }
  return all;
}

}  // namespace strut::fuzz

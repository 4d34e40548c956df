// A file's mesh to the material points of all ranks.
#include "base/errors.hpp"
#include "base/parallel/communicator.hpp"
#include "io/distribute.hpp"
#include "io/exodus/exodus.hpp"
#include "io/exodus/exodus_file.hpp"
#include "io/exodus/mesh_points.hpp"
#include "io/exodus/mesh_read.hpp"
#include "io/netcdf/trial_read.hpp"

namespace strut::io {

namespace {

constexpr std::size_t most_sets = 64;  // one bit each

PointCloud read_cloud(const std::filesystem::path& path, PointsAt at, bool with_cells) {
  const ExodusFile file = ExodusFile::open(path);
  const std::size_t sets = file.node_sets().size();
  if (sets > most_sets) {
    throw Error(path.string() + ": " + std::to_string(sets) + " node sets, at most " + std::to_string(most_sets) +
                " are supported");
  }
  const Mesh mesh = mesh_of(file);
  if (at == PointsAt::nodes)
    return points_at_nodes(mesh, file.numbers(ExodusFile::On::nodes, 0, std::ssize(mesh.nodes)), path.string(),
                           with_cells);
  PointCloud cloud = points_at_elements(mesh, path.string(), with_cells);
  cloud.element_ids = file.numbers(ExodusFile::On::elements, 0, std::ssize(cloud.volumes));
  return cloud;
}

}  // namespace

PointCloud read_exodus(const std::filesystem::path& file, const Communicator& communicator, PointsAt at,
                       bool with_cells) {
  PointCloud whole;
  run_on_root(communicator, [&] { whole = read_after_trial(file, [&] { return read_cloud(file, at, with_cells); }); });
  return distribute(whole, communicator);
}

}  // namespace strut::io

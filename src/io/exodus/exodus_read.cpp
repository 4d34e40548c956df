// Reads the mesh of a file into material points on all ranks; no rank has more of it than a slice.
#include <algorithm>
#include <optional>

#include "base/errors.hpp"
#include "io/exodus/mesh_points.hpp"
#include "io/exodus/side_nodes.hpp"
#include "io/on_root.hpp"
#include "io/slices.hpp"
#include "topology/coincident.hpp"

namespace strut::io {

namespace {

constexpr std::size_t most_sets = 64;  // one bit each

void check_count_of_sets(std::size_t sets, const std::string& name) {
  if (sets <= most_sets) return;
  throw Error(name + ": " + std::to_string(sets) + " node sets, at most " + std::to_string(most_sets) +
              " are supported");
}

MeshFile opened(const std::filesystem::path& path) {
  ExodusFile file = ExodusFile::open(path);
  check_count_of_sets(file.node_sets().size(), path.string());
  return MeshFile(std::move(file));
}

// Throws the error of the first rank that has one on all ranks.
template <class Action>
PointCloud on_all_ranks(const Communicator& communicator, const Action& action) {
  PointCloud cloud;
  std::string problem;
  try {
    cloud = action();
  } catch (const Error& error) {
    problem = error.what();
  }
  raise_first(communicator, problem);
  return cloud;
}

// Collective. The file's numbers of this rank's slice.
std::vector<std::int64_t> numbers_of(const MeshSource* file, MeshSource::On on, std::int64_t total,
                                     const Communicator& communicator) {
  OnRoot on_root(communicator);
  auto mine = scatterv<std::int64_t>(
      communicator, slice_counts(total, communicator.size()),
      [&](std::int64_t begin, std::span<std::int64_t> values) { on_root([&] { file->numbers(on, begin, values); }); });
  on_root.raise();
  return mine;
}

void check_elements_have_nodes(const MeshLayout& layout, const std::string& file) {
  for (const MeshLayout::Block& block : layout.blocks) {
    if (block.partly_filled) {
      throw Error(file + ": block '" + block.name + "' has elements that are partly filled (attribute " +
                  partial_cell_attributes[0] + " and others); its points can only be at elements");
    }
    if (block.type == "SPHERE" && block.elements > 0) {
      throw Error(file + ": block '" + block.name +
                  "' has spheres; points at nodes need hexahedra (HEX8) or tetrahedra (TET4), points at elements "
                  "may be any of the three");
    }
  }
}

// Collective. Checks for elements given twice, which points at nodes do not show: their nodes have twice the volume.
void check_given_once(const MeshSlice& slice, const NodeRange& own, const std::string& file,
                      const Communicator& communicator) {
  const std::string twins = coincident_points(elements_of(slice, own), communicator, [](int, int) { return false; });
  if (!twins.empty()) throw Error(file + ": " + twins);
}

// Collective. Reports a block all of whose nodes belong to earlier blocks: it would vanish without a message. Blocks
// without elements have no points anyway.
void check_blocks_have_points(const PointCloud& cloud, const MeshLayout& layout, const std::string& file,
                              const Communicator& communicator) {
  std::vector<double> found(cloud.block_names.size(), 0);
  for (const int block : cloud.blocks) found[block] = 1;
  for (std::size_t b = 0; b < found.size(); ++b) found[b] += layout.blocks[b].elements == 0 ? 1 : 0;
  communicator.max(found);
  for (std::size_t b = 0; b < found.size(); ++b) {
    if (found[b] > 0) continue;
    throw Error(
        file + ": block '" + cloud.block_names[b] +
        "' would have no point: all its nodes belong to blocks before it. Put it first in the file, refine it, or "
        "use Points \"Elements\"");
  }
}

PointCloud at_nodes(const MeshSource* file, const MeshLayout& layout, const std::string& name, bool with_cells,
                    const std::vector<Mirror>& planes, const Communicator& communicator, FacesOnPlanes* apart) {
  check_elements_have_nodes(layout, name);
  const MeshSlice slice = elements_around_slice(file, layout, communicator);
  const auto numbers = numbers_of(file, MeshSource::On::nodes, layout.nodes, communicator);
  const std::int64_t begin = slice_begin(layout.nodes, communicator.size(), communicator.rank());
  const NodeRange own{begin, begin + std::ssize(numbers)};
  PointCloud cloud =
      on_all_ranks(communicator, [&] { return points_at_nodes(slice, own, numbers, name, with_cells, planes, apart); });
  check_given_once(slice, own, name, communicator);
  communicator.sum(cloud.taken_volumes);
  check_blocks_have_points(cloud, layout, name, communicator);
  return cloud;
}

PointCloud at_elements(const MeshSource* file, const MeshLayout& layout, const std::string& name, bool with_cells,
                       const std::vector<Mirror>& planes, const Communicator& communicator, FacesOnPlanes* apart) {
  const MeshSlice slice = slice_of_elements(file, layout, communicator);
  PointCloud cloud = on_all_ranks(communicator, [&] { return points_at_elements(slice, name, with_cells); });
  const std::vector<std::int64_t> seams = seams_at_sides(slice, planes, cloud.spacings, communicator);
  add_shared_nodes(slice, planes, seams, cloud);
  if (with_cells) add_surfaces(slice, planes, seams, communicator, cloud, apart);
  cloud.element_ids = numbers_of(file, MeshSource::On::elements, layout.elements, communicator);
  return cloud;
}

// `mesh`: on rank 0; `name`: on all.
PointCloud points_of(const MeshSource* mesh, const std::string& name, PointsAt at, bool with_cells,
                     const std::vector<Mirror>& planes, const Communicator& communicator, FacesOnPlanes* apart) {
  const MeshLayout layout = broadcast_layout(mesh ? mesh->layout() : MeshLayout(), communicator);
  PointCloud cloud =
      (at == PointsAt::nodes ? at_nodes : at_elements)(mesh, layout, name, with_cells, planes, communicator, apart);
  const auto alone = [](const std::vector<std::int64_t>& shared_nodes) { return shared_nodes.empty(); };
  const bool any_alone = std::any_of(cloud.shared_nodes.begin(), cloud.shared_nodes.end(), alone);
  cloud.has_shared_nodes = with_cells && !communicator.any(any_alone);
  return cloud;
}

}  // namespace

PointCloud read_exodus(const std::filesystem::path& file, const Communicator& communicator, PointsAt at,
                       bool with_cells, const std::vector<Mirror>& planes, FacesOnPlanes* apart) {
  std::optional<MeshFile> mesh;
  run_on_root(communicator, [&] { mesh.emplace(opened(file)); });
  return points_of(mesh ? &*mesh : nullptr, file.string(), at, with_cells, planes, communicator, apart);
}

PointCloud points_of(const Mesh& mesh, const Communicator& communicator, PointsAt at, bool with_cells,
                     const std::vector<Mirror>& planes, FacesOnPlanes* apart) {
  const std::string name = "the mesh in memory";
  run_on_root(communicator, [&] {
    if (mesh.blocks.empty()) throw Error(name + " has no elements");
    check_count_of_sets(mesh.node_sets.size(), name);
  });
  const MeshInMemory source(mesh);
  return points_of(&source, name, at, with_cells, planes, communicator, apart);
}

}  // namespace strut::io

// A file's mesh, spread over ranks.
#pragma once

#include "base/parallel/communicator.hpp"
#include "io/exodus/mesh_read.hpp"

namespace strut::io {

// What a rank has of a mesh.
struct MeshSlice {
  Mesh mesh;                           // all blocks, with some of their elements, and the nodes of these; no node sets
  std::vector<std::int64_t> nodes;     // their places in the file, ascending
  std::vector<std::uint64_t> sets;     // bit k of a node: it is in node set k
  std::vector<std::int64_t> elements;  // the places in the file of all elements, ascending
  MeshLayout layout;                   // of the whole
};

// Collective; `file` is used on rank 0. A slice of the elements for each rank.
MeshSlice slice_of_elements(const MeshFile* file, const MeshLayout& layout, const Communicator& communicator);

// The same, of all elements around a slice of the nodes: some are on several ranks.
MeshSlice elements_around_slice(const MeshFile* file, const MeshLayout& layout, const Communicator& communicator);

// That of rank 0.
MeshLayout broadcast_layout(const MeshLayout& layout, const Communicator& communicator);

}  // namespace strut::io

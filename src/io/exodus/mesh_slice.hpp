// The mesh of a file, distributed over the ranks.
#pragma once

#include "base/parallel/communicator.hpp"
#include "io/exodus/mesh_read.hpp"

namespace strut::io {

// A rank's part of a mesh.
struct MeshSlice {
  Mesh mesh;                           // all blocks, with some of their elements and the nodes of these; no node sets
  std::vector<std::int64_t> nodes;     // their indices in the file, ascending
  std::vector<std::uint64_t> sets;     // bit k of a node: it is in node set k
  std::vector<std::int64_t> elements;  // indices of all elements in the file, ascending
  MeshLayout layout;                   // of the whole mesh
};

// Collective; `file` is used on rank 0 only. A slice of the elements for each rank.
MeshSlice slice_of_elements(const MeshSource* file, const MeshLayout& layout, const Communicator& communicator);

// The same with all elements around a slice of the nodes: some elements are on several ranks.
MeshSlice elements_around_slice(const MeshSource* file, const MeshLayout& layout, const Communicator& communicator);

// The layout of rank 0, on all ranks.
MeshLayout broadcast_layout(const MeshLayout& layout, const Communicator& communicator);

}  // namespace strut::io

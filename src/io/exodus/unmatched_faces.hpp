// Faces of elements behind which the mesh goes on with faces of other corners: it does not conform.
#pragma once

#include <filesystem>
#include <vector>

#include "io/exodus/exodus.hpp"

namespace strut::io {

struct UnmatchedFaces {
  int block, other;      // indices of the blocks whose elements have these faces, and those behind them
  std::int64_t count;    // of these faces
  std::int64_t element;  // the first element that has one, in the order of the file, from 1
};

// Collective. By pairs of blocks, the faces without a twin that lie over others at three corners or more: squares that
// are halved along one diagonal by the elements on one side, along the other or not at all by those on the other side,
// and faces of large elements beside several small ones. The mesh of a file, which must be readable (read_exodus), or
// in memory on rank 0.
std::vector<UnmatchedFaces> unmatched_faces(const std::filesystem::path& file, const Communicator& communicator);
std::vector<UnmatchedFaces> unmatched_faces(const Mesh& mesh, const Communicator& communicator);

}  // namespace strut::io

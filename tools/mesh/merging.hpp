// Merges pieces of a body into their neighbors, one by one.
#pragma once

#include <cmath>
#include <functional>
#include <set>
#include <vector>

#include "mesh/pieces.hpp"

namespace strut::mesh {

// Nodes can join only cells at touching positions. So a merge is not made if the merged cell would have a contact
// farther away, which would separate material.
class Merging {
 public:
  // `links`: for each piece, those that it can be merged into.
  Merging(Pieces& pieces, std::vector<std::set<int>> links, const VoxelGrid& grid);

  using Allowed = std::function<bool(int)>;
  // Merges a piece into the one of its links that is `allowed`, gives the most compact result, and is no longer than
  // `longest` cells. The result is at the position of that link or, if only that keeps its neighbors, of the piece.
  // Returns the piece that contains both, or -1.
  int merge(
      int piece, double longest = INFINITY, const Allowed& allowed = [](int) { return true; });
  void drop(int piece) { alive_[piece] = false; }

  bool alive(int piece) const { return alive_[piece]; }
  const std::set<int>& links(int piece) const { return links_[piece]; }

  // Assigns the voxels of merged pieces to the pieces that contain them.
  void finish();

 private:
  struct Choice {
    int into = -1;  // a piece; -1: none is possible
    int place = 0;  // of the merged piece
  };

  bool reaches(int place, int piece, int other) const;
  Choice most_compact(int piece, double longest, const Allowed& allowed, bool is_at_piece) const;
  void join(int piece, const Choice& choice);

  Pieces& pieces_;
  std::vector<Piece>& list_;
  std::vector<std::set<int>> links_;
  const VoxelGrid& grid_;
  std::vector<char> alive_;
  std::vector<int> into_;  // the piece that a merged piece became part of
};

}  // namespace strut::mesh

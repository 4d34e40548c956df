// Cells whose neighbors hardly span space: they are cut in two layers, or merged.
#pragma once

#include <set>
#include <vector>

#include "mesh/pieces.hpp"

namespace strut::mesh {

// A run learns how a cell deforms from where its neighbors go. Where all of them lie in one plane, as in a strut that
// a wall of the box has cut along its length, it learns nothing about the normal of the plane, and leaves the cell out.
// Cut in two along the normal, the cells are each other's neighbors on either side of the plane.
class FlatCells {
 public:
  FlatCells(const Material& material, const Gathering& gathering, Pieces& pieces, Cells& cells)
      : material_(material), gathering_(gathering), pieces_(pieces), cells_(cells) {}

  // Puts what the pieces hold into the cells, and changes both where they are flat.
  void mend();

 private:
  void update();
  void find();
  Tensor spread(int cell) const;
  bool is_cut(int cell) const;
  bool cut();
  void give_upper_halves(const std::vector<int>& upper);
  bool merge();
  void count_left_out();

  const Material& material_;
  const Gathering& gathering_;
  Pieces& pieces_;
  Cells& cells_;
  std::vector<std::set<int>> links_;
  std::vector<std::vector<int>> near_;  // those that share a node
  std::vector<int> flat_;
  std::vector<int> normal_;  // axis of a cell whose neighbors lie in a plane, -1: of others
  std::vector<char> alive_;  // what a run keeps
};

}  // namespace strut::mesh

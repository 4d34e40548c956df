// Cells whose neighbors hardly span space: they are cut into two layers, or merged.
#pragma once

#include <set>
#include <vector>

#include "mesh/pieces.hpp"

namespace strut::mesh {

// The deformation of a cell follows from the motion of its neighbors. If these are all in one plane, as in a strut that
// a wall of the box cuts along its length, it is undetermined along the normal, and a run drops the cell. If the cells
// are cut in two along the normal, they are each other's neighbors on either side of the plane.
class FlatCells {
 public:
  FlatCells(const Material& material, const Gathering& gathering, Pieces& pieces, Cells& cells)
      : material_(material), gathering_(gathering), pieces_(pieces), cells_(cells) {}

  // Sets the cells from the pieces, and changes both where cells are flat.
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
  std::vector<std::vector<int>> near_;  // cells that share a node
  std::vector<int> flat_;
  std::vector<int> normal_;  // axis of a cell whose neighbors are in a plane, else -1
  std::vector<char> alive_;  // kept by a run
};

}  // namespace strut::mesh

// The section Discretization: the positions of the points.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "base/math/tensors.hpp"
#include "deck/forward.hpp"
#include "mechanics/formulation/formulation.hpp"
#include "topology/neighbors/cracks.hpp"

namespace strut::deck {

enum class MeshType { exodus, text, grid, memory };  // memory: from the program that runs the deck
enum class Points { elements, nodes };
enum class DegeneratePoints { error, drop, drop_any, keep };

// Equal cells, with a point at the center of each, x fastest.
struct Grid {
  Vector origin = Vector::Zero(), length = Vector::Ones();  // m
  std::array<int, 3> points = {1, 1, 1};
  bool boxes = false;  // families are boxes of cells, as in Peridigm without a NeighborhoodType
};

struct Discretization {
  MeshType type{};
  std::filesystem::path mesh;  // path that can be opened; in the deck it is relative to the deck's folder
  Grid grid;                   // instead of a mesh
  Points points{};             // position of the points; nodes: of Exodus meshes only
  Influence influence{};
  DegeneratePoints degenerate{};
  std::vector<Crack> cracks;                  // no bond crosses these
  std::vector<std::filesystem::path> shells;  // nor the surfaces in these files, as `mesh`
};

Section discretization_section();
Discretization read_discretization(const Values& deck, const std::filesystem::path& deck_file, Problems& problems);

// Checks that the mesh can be opened.
void check_mesh(const std::filesystem::path& mesh, Problems& problems);

}  // namespace strut::deck

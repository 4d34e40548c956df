// The recipe of a mesh: "key = value" lines, sections "[body]". tools/README.md has the table of keys.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/math/tensors.hpp"

namespace strut::mesh {

struct Body {
  enum class Shape { cylinder, cone, box, foam, lattice, file };
  enum class Method { lattice, fitted };
  enum class Centered { point, corner };  // the point of the lattice on a cylinder's axis
  enum class Elements { hexahedra, spheres };

  std::string name = "body";
  bool named = false;  // by the recipe
  Shape shape = Shape::cylinder;
  Method method = Method::lattice;
  Centered centered = Centered::corner;
  Elements elements = Elements::hexahedra;
  double spacing = 0;                 // m, requested
  int cells = 0;                      // voxels along an edge of a gathered cell; 0: a cell is a voxel
  double smallest_cell = 0.3;         // of a whole cell: smaller ones are merged into a neighbor
  double grading = 1;                 // thickness of a layer over that of the one below, above `uniform`; 1: equal
  double uniform = 0;                 // m, length of equal layers at zmin
  double coarsest = 0;                // m, largest thickness of a layer; 0: no limit
  double length = 0;                  // m, of a cylinder or cone, along z
  double radius = 0;                  // m
  double top_radius = 0;              // m, of a cone, at zmax
  Vector size = Vector::Zero();       // m, of a box, a foam or a lattice
  Vector origin = Vector::Zero();     // m, center of a round body's lower face, lower corner of a box, shift of a file
  double cell = 0;                    // m, mean diameter of a foam's cells; edge of a lattice's cell
  double relative_density = 0;        // volume of a foam's or lattice's material over its box; 0: by the thickness
  std::string lattice;                // its name
  double thickness = 0;               // m, of a lattice's struts or sheets; 0: by the density
  std::array<bool, 3> periodic = {};  // axes along which a foam or lattice repeats
  double sizes = 0;                   // of a foam's cells: standard deviation of the spheres' diameters over their mean
  int relax = 0;                      // steps of Lloyd
  Vector stretch = Vector::Ones();    // of a foam's cells
  double node_thickness = 1;          // of struts, over that in the middle
  bool three_cornered = false;        // section of a foam's struts
  double irregularity = 0.5;          // 0: equal foam cells, 1: the most random ones
  std::uint64_t seed = 1;             // of the random numbers
  std::filesystem::path file;         // of a mesh, relative to the working folder

  // True if it fills one side of a surface: it has no struts, whose thickness could be told.
  bool is_solid() const { return lattice == "gyroid" || lattice == "diamond"; }
};

// Keys before the first "[body]" hold for all bodies; without such a line there is one body. Throws Error with all
// problems, each with its line.
std::vector<Body> read_recipe(const std::filesystem::path& path);

}  // namespace strut::mesh

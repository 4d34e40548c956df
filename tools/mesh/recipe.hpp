// What a mesh shall be: "key = value" lines, sections "[body]". tools/README.md has the table of keys.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/tensors.hpp"

namespace strut::mesh {

struct Body {
  enum class Shape { cylinder, box };
  enum class Method { lattice, fitted };
  enum class Centred { point, corner };  // what of the lattice lies on a cylinder's axis
  enum class Elements { hexahedra, spheres };

  std::string name = "body";
  Shape shape = Shape::cylinder;
  Method method = Method::lattice;
  Centred centred = Centred::corner;
  Elements elements = Elements::hexahedra;
  double spacing = 0;              // m, wanted
  double length = 0;               // m, of a cylinder, along z
  double radius = 0;               // m
  Vector size = Vector::Zero();    // m, of a box
  Vector origin = Vector::Zero();  // m, centre of a cylinder's lower face, lower corner of a box
};

// Keys before the first "[body]" hold for all bodies; without such a line there is one body.
// Throws Error with all that is wrong, each with its line.
std::vector<Body> read_recipe(const std::filesystem::path& path);

}  // namespace strut::mesh

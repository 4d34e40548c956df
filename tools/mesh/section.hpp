// Cross-sections of quadrilaterals, the bodies' shapes in the plane, and the layers in which they are extruded.
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "mesh/recipe.hpp"

namespace strut::mesh {

using Point = Eigen::Vector2d;

// n × m cells, of which some are kept, and the places of their corners, m.
struct Section {
  int n, m;
  std::function<bool(int, int)> keeps;
  std::function<Point(int, int)> place;

  double area(int i, int j) const;  // of a cell
};

// The number of cells across a square that holds all cells with centers within the radius; the axis is at a center or a
// corner of cells.
int cells_across(double radius, double spacing, Body::Centered centered);

// Squares of the spacing with their centers within the radius; the axis is at a center, or at a corner of four.
Section lattice_disc(double radius, double spacing, Body::Centered centered);

// An even number of cells across, all with nearly the same area; the outer nodes are on the circle.
Section fitted_disc(double radius, double spacing);

// The lower corner is at the origin.
Section rectangle(double a, double b, double spacing);

// Heights of the layers' faces over a body of this height (m), from 0 to it: equal layers, as thick as the spacing up
// to rounding; or graded ones: as thick as the spacing up to the height `uniform`, then each `grading` times as thick
// as the one below, at most `coarsest`; finally all are scaled to fit the height.
std::vector<double> levels_of(const Body& body, double height);

}  // namespace strut::mesh

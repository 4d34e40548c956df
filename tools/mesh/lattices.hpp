// Lattices by name: struts along the edges of a cubic cell that repeats, and solids and sheets around minimal surfaces.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mesh/tessellation.hpp"

namespace strut::mesh {

// octet, bcc, fcc (diagonals of faces), kelvin; gyroid, diamond (solid on one side), gyroid-sheet, diamond-sheet.
const std::vector<std::string>& lattice_names();
bool has_struts(const std::string& name);

// The struts of one cell of edge 1, each once; those on its faces belong to one of the cells that share it.
std::vector<Edge> lattice_cell(const std::string& name);

// All struts in a box of this size at the origin, and one cell more around it; `cell`: edge of a cell, m.
std::vector<Edge> lattice_edges(const std::string& name, const Vector& size, double cell);

// The distance from the surface, to first order, m: for a solid positive outside, for a sheet on both sides.
std::function<double(const Vector&)> surface_field(const std::string& name, double cell);

}  // namespace strut::mesh

// Numbers of a run and of meshes as arrays of NumPy, without a copy if their layout in memory permits.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "io/exodus/exodus.hpp"
#include "mechanics/body.hpp"

namespace strut::python {

// Takes the values over; one row for each `width` of them, or a list if that is 1.
pybind11::object array_of(std::vector<double> values, int width);

// The field of that name of this rank's points, as it lies in memory, read-only and current while `owner` lives; None
// if it is computed, or not stored as consecutive numbers. On several ranks a copy, since repartitioning moves points.
pybind11::object view_of(const Body& body, const std::string& name, const pybind11::object& owner);
// The present places of the points, m; likewise.
pybind11::array places(const Body& body, const pybind11::object& owner);

// strut/mesh.py has checked the arrays.
using Reals = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;
using Integers = pybind11::array_t<int, pybind11::array::c_style | pybind11::array::forcecast>;
void set_nodes(io::Mesh& mesh, const Reals& places);
void add_block(io::Mesh& mesh, const std::string& name, const std::string& type, const Integers& nodes,
               const Reals& volumes);
void add_set(io::Mesh& mesh, const std::string& name, const Integers& nodes);

pybind11::array nodes_of(const io::Mesh& mesh);
pybind11::dict elements_of(const io::Mesh& mesh);  // name of a block: nodes of its elements
pybind11::dict sets_of(const io::Mesh& mesh);

}  // namespace strut::python

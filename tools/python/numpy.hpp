// Numbers of a run and of meshes as arrays of NumPy, without a copy if their layout in memory permits.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>

#include "io/exodus/exodus.hpp"
#include "mechanics/body.hpp"

namespace strut {

namespace py = pybind11;

inline constexpr py::ssize_t bytes = sizeof(double);  // of a number

// An array that a run does not read again.
inline py::array read_only(py::array array) {
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

// `rows` rows of `width` numbers, `stride` bytes apart; of a width of 1 a list.
inline py::array view(const double* data, py::ssize_t rows, py::ssize_t width, py::ssize_t stride, const Body& body,
                      const py::object& owner) {
  std::vector<py::ssize_t> shape{rows}, strides{stride};
  if (width > 1) shape.push_back(width), strides.push_back(bytes);
  if (body.domain.communicator.size() > 1) return read_only(py::array_t<double>(shape, strides, data));
  return read_only(py::array_t<double>(shape, strides, data, owner));
}

template <class T>
const T* values_in(const AnyField& field) {
  const auto* typed = dynamic_cast<const FieldOf<std::vector<T>>*>(&field);
  return typed && !typed->values.empty() ? typed->values.data() : nullptr;
}

inline py::array integers(const std::vector<int>& values, int width) {
  const py::ssize_t rows = std::ssize(values) / width;
  if (width == 1) return py::array_t<int>(rows, values.data());
  return py::array_t<int>({rows, py::ssize_t{width}}, values.data());
}

// Takes the values over; one row for each `width` of them, or a list if that is 1.
inline py::array array_of(std::vector<double> values, int width) {
  auto kept = std::make_unique<std::vector<double>>(std::move(values));
  const double* const data = kept->data();
  const py::ssize_t rows = std::ssize(*kept) / width;
  const py::capsule owner(kept.release(), [](void* vector) { delete static_cast<std::vector<double>*>(vector); });
  if (width == 1) return py::array_t<double>(rows, data, owner);
  return py::array_t<double>({rows, py::ssize_t{width}}, data, owner);
}

// The field of that name of this rank's points, as it lies in memory, read-only and current while `owner` lives; None
// if it is computed, or not stored as consecutive numbers. On several ranks a copy, since repartitioning moves points.
inline py::object view_of(const Body& body, const std::string& name, const py::object& owner) {
  for (const auto& field : body.fields.all()) {
    if (!field->in_use || field->parts.size() != 1 || field->parts[0].variable != name) continue;
    if (const auto* scalars = values_in<double>(*field)) return view(scalars, body.owned(), 1, bytes, body, owner);
    if (const auto* vectors = values_in<Vector>(*field))
      return view(vectors->data(), body.owned(), 3, sizeof(Vector), body, owner);
  }
  return py::none();
}

// The present places of the points, m; likewise.
inline py::array places(const Body& body, const py::object& owner) {
  return view(body.domain.sites.data()->current.data(), body.owned(), 3, sizeof(Site), body, owner);
}

// strut/mesh.py has checked the arrays.
using Reals = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Integers = py::array_t<int, py::array::c_style | py::array::forcecast>;

inline void set_nodes(io::Mesh& mesh, const Reals& places) {
  for (py::ssize_t n = 0; n + 2 < places.size(); n += 3) mesh.nodes.emplace_back(places.data() + n);
}

inline void add_block(io::Mesh& mesh, const std::string& name, const std::string& type, const Integers& nodes,
                      const Reals& volumes) {
  mesh.blocks.push_back(
      {name, type, {nodes.data(), nodes.data() + nodes.size()}, {volumes.data(), volumes.data() + volumes.size()}, {}});
}

inline void add_set(io::Mesh& mesh, const std::string& name, const Integers& nodes) {
  mesh.node_sets.push_back({name, {nodes.data(), nodes.data() + nodes.size()}});
}

inline py::array nodes_of(const io::Mesh& mesh) {
  return py::array_t<double>({std::ssize(mesh.nodes), py::ssize_t{3}}, {py::ssize_t{sizeof(Vector)}, bytes},
                             mesh.nodes.empty() ? nullptr : mesh.nodes.front().data());
}

// {name of a block: nodes of its elements}
inline py::dict elements_of(const io::Mesh& mesh) {
  py::dict blocks;
  for (const io::Mesh::Block& block : mesh.blocks)
    blocks[block.name.c_str()] = integers(block.nodes, io::nodes_per_element(block.type));
  return blocks;
}

inline py::dict sets_of(const io::Mesh& mesh) {
  py::dict sets;
  for (const io::Mesh::NodeSet& set : mesh.node_sets) sets[set.name.c_str()] = integers(set.nodes, 1);
  return sets;
}

}  // namespace strut

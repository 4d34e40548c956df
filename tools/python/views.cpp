#include "python/views.hpp"

#include <memory>

namespace py = pybind11;

namespace strut::python {

namespace {

constexpr py::ssize_t number = sizeof(double);

// `rows` rows of `width` numbers, `stride` bytes apart; of a width of 1 a list.
py::array view(const double* data, py::ssize_t rows, py::ssize_t width, py::ssize_t stride, const Body& body,
               const py::object& owner) {
  std::vector<py::ssize_t> shape{rows}, strides{stride};
  if (width > 1) shape.push_back(width), strides.push_back(number);
  if (body.domain.communicator.size() > 1) return py::array_t<double>(shape, strides, data);
  py::array_t<double> array(shape, strides, data, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

template <class T>
const T* values_in(const AnyField& field) {
  const auto* typed = dynamic_cast<const FieldOf<std::vector<T>>*>(&field);
  return typed && !typed->values.empty() ? typed->values.data() : nullptr;
}

py::array integers(const std::vector<int>& values, int width) {
  const py::ssize_t rows = std::ssize(values) / width;
  if (width == 1) return py::array_t<int>(rows, values.data());
  return py::array_t<int>({rows, py::ssize_t{width}}, values.data());
}

}  // namespace

py::object array_of(std::vector<double> values, int width) {
  auto kept = std::make_unique<std::vector<double>>(std::move(values));
  const double* const data = kept->data();
  const py::ssize_t rows = std::ssize(*kept) / width;
  const py::capsule owner(kept.release(), [](void* vector) { delete static_cast<std::vector<double>*>(vector); });
  if (width == 1) return py::array_t<double>(rows, data, owner);
  return py::array_t<double>({rows, py::ssize_t{width}}, data, owner);
}

py::object view_of(const Body& body, const std::string& name, const py::object& owner) {
  for (const auto& field : body.fields.all()) {
    if (!field->in_use || field->parts.size() != 1 || field->parts[0].variable != name) continue;
    if (const auto* scalars = values_in<double>(*field)) return view(scalars, body.owned(), 1, number, body, owner);
    if (const auto* vectors = values_in<Vector>(*field))
      return view(vectors->data(), body.owned(), 3, sizeof(Vector), body, owner);
  }
  return py::none();
}

py::array places(const Body& body, const py::object& owner) {
  return view(body.domain.sites.data()->current.data(), body.owned(), 3, sizeof(Site), body, owner);
}

void set_nodes(io::Mesh& mesh, const Reals& places) {
  for (py::ssize_t n = 0; n + 2 < places.size(); n += 3) mesh.nodes.emplace_back(places.data() + n);
}

void add_block(io::Mesh& mesh, const std::string& name, const std::string& type, const Integers& nodes,
               const Reals& volumes) {
  mesh.blocks.push_back(
      {name, type, {nodes.data(), nodes.data() + nodes.size()}, {volumes.data(), volumes.data() + volumes.size()}, {}});
}

void add_set(io::Mesh& mesh, const std::string& name, const Integers& nodes) {
  mesh.node_sets.push_back({name, {nodes.data(), nodes.data() + nodes.size()}});
}

py::array nodes_of(const io::Mesh& mesh) {
  return py::array_t<double>({std::ssize(mesh.nodes), py::ssize_t{3}}, {py::ssize_t{sizeof(Vector)}, number},
                             mesh.nodes.empty() ? nullptr : mesh.nodes.front().data());
}

py::dict elements_of(const io::Mesh& mesh) {
  py::dict blocks;
  for (const io::Mesh::Block& block : mesh.blocks)
    blocks[block.name.c_str()] = integers(block.nodes, io::nodes_per_element(block.type));
  return blocks;
}

py::dict sets_of(const io::Mesh& mesh) {
  py::dict sets;
  for (const io::Mesh::NodeSet& set : mesh.node_sets) sets[set.name.c_str()] = integers(set.nodes, 1);
  return sets;
}

}  // namespace strut::python

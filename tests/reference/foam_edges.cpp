// The skeleton of the foam, or of the lattice of struts, that a recipe describes, for programs that mesh it in their
// own way.
//   foam_edges RECIPE > edges.txt
// First the size of the box and the radius of the struts, then the ends of each edge whose strut may reach into the
// box: x y z x y z, m. The foam is the union of the capsules around the edges, cut by the box.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "base/errors.hpp"
#include "mesh/lattices.hpp"
#include "mesh/recipe.hpp"
#include "mesh/tessellation.hpp"
#include "mesh/voxels.hpp"

namespace {

using namespace strut::mesh;

VoxelGrid grid_of(const Body& body) {
  return {body.size, (body.size / body.spacing).array().round().max(1).cast<int>()};
}

std::vector<Edge> edges_of(const Body& body) {
  if (body.shape == Body::Shape::lattice) return lattice_edges(body.lattice, body.size, body.cell);
  return foam_skeleton(body.size, {body.cell, body.irregularity, body.seed}).edges;
}

double radius_of(const Body& body, const std::vector<Edge>& edges) {
  if (body.thickness > 0) return body.thickness / 2;
  const VoxelGrid grid = grid_of(body);
  const auto wanted = static_cast<std::size_t>(std::llround(body.relative_density * static_cast<double>(grid.count())));
  return struts_around(edges, grid, wanted).radius;
}

bool may_reach(const Edge& edge, double radius, const strut::Vector& size) {
  return (edge.a.cwiseMax(edge.b).array() > -radius).all() &&
         (edge.a.cwiseMin(edge.b).array() < size.array() + radius).all();
}

void print_edges(const Body& body) {
  const std::vector<Edge> edges = edges_of(body);
  const double radius = radius_of(body, edges);
  std::printf("# size %.17g %.17g %.17g radius %.17g\n", body.size[0], body.size[1], body.size[2], radius);
  for (const Edge& edge : edges) {
    if (!may_reach(edge, radius, body.size)) continue;
    std::printf("%.17g %.17g %.17g %.17g %.17g %.17g\n", edge.a[0], edge.a[1], edge.a[2], edge.b[0], edge.b[1],
                edge.b[2]);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: foam_edges RECIPE > EDGES\n", stderr);
    return EXIT_FAILURE;
  }
  try {
    const auto bodies = read_recipe(argv[1]);
    const auto is_of_struts = [](const Body& body) {
      return body.shape == Body::Shape::foam || (body.shape == Body::Shape::lattice && has_struts(body.lattice));
    };
    if (bodies.size() != 1 || !is_of_struts(bodies[0])) throw strut::Error("expected a recipe of one foam of struts");
    print_edges(bodies[0]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "foam_edges: %s\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

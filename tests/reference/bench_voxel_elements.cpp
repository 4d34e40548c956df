// The stiffness of a voxel mesh between clamped ends by finite elements, and what they cost.
//   build/release/tests/reference/bench_voxel_elements foam.g [Young's modulus, Pa] [Poisson's ratio]
// Both end layers of nodes along z are held, the upper one is moved along z. Conjugate gradients, diagonal
// preconditioner, one core. And the time of explicit steps with the same forces.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>

#include "base/errors.hpp"
#include "voxel_elements.hpp"

namespace strut::reference {
namespace {

// Processor time of this process, so that others on the machine count less.
double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Ends {
  std::vector<int> low, high;  // nodes
};

Ends ends_of(const VoxelMesh& mesh) {
  double bottom = mesh.nodes[0][2], top = bottom;
  for (const Vector& x : mesh.nodes) bottom = std::min(bottom, x[2]), top = std::max(top, x[2]);
  Ends ends;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    if (mesh.nodes[n][2] < bottom + 0.1 * mesh.edge) ends.low.push_back(static_cast<int>(n));
    if (mesh.nodes[n][2] > top - 0.1 * mesh.edge) ends.high.push_back(static_cast<int>(n));
  }
  return ends;
}

// 1/K_ii of the free nodes, 0 of the held ones.
NodeField inverse_diagonal(const VoxelMesh& mesh, const VoxelStiffness& stiffness, const Ends& ends) {
  NodeField diagonal(mesh.nodes.size() + 1, Eigen::Array4d::Zero());
  for (const Corners& corners : mesh.voxels) {
    for (int c = 0; c < 8; ++c) diagonal[corners[c]].head<3>() += stiffness.diagonal().segment<3>(3 * c).array();
  }
  for (Eigen::Array4d& d : diagonal) d = (d > 0).select(1 / d, 0);
  for (const std::vector<int>& nodes : {ends.low, ends.high}) {
    for (const int n : nodes) diagonal[n].setZero();
  }
  return diagonal;
}

double product(const NodeField& a, const NodeField& b) {
  Eigen::Array4d sum = Eigen::Array4d::Zero();
  for (std::size_t n = 0; n < a.size(); ++n) sum += a[n] * b[n];
  return sum.sum();
}

// Moves the free nodes to the equilibrium; the number of iterations until the energy that is left of the residual has
// fallen by 1e-14.
int solve(const VoxelForces& forces, const NodeField& inverse, NodeField& u) {
  NodeField r = forces.field(), p = forces.field(), q = forces.field();
  forces.add(u, r);
  for (std::size_t n = 0; n < r.size(); ++n) r[n] = -r[n], p[n] = inverse[n] * r[n];
  double rz = product(r, p);
  const double enough = 1e-14 * rz;
  for (int iteration = 0; iteration < 100000; ++iteration) {
    if (rz <= enough) return iteration;
    for (Eigen::Array4d& value : q) value.setZero();
    forces.add(p, q);
    const double alpha = rz / product(p, q);
    Eigen::Array4d sum = Eigen::Array4d::Zero();
    for (std::size_t n = 0; n < r.size(); ++n) {
      u[n] += alpha * p[n];
      r[n] -= alpha * q[n];
      sum += r[n] * r[n] * inverse[n];
    }
    const double beta = sum.sum() / rz;
    rz = sum.sum();
    for (std::size_t n = 0; n < r.size(); ++n) p[n] = inverse[n] * r[n] + beta * p[n];
  }
  throw Error("no equilibrium: a piece of the mesh hangs in the air?");
}

double force_at(const std::vector<int>& nodes, const VoxelForces& forces, const NodeField& u) {
  NodeField f = forces.field();
  forces.add(u, f);
  double sum = 0;
  for (const int n : nodes) sum += f[n][2];
  return sum;
}

// Explicit steps so small that nothing moves: s a step, and of it in the forces.
void time_steps(const VoxelForces& forces, const NodeField& inverse, NodeField u, std::size_t voxels) {
  NodeField v = forces.field(), f = forces.field();
  double whole = 0, in_forces = 0;
  int steps = 0;
  for (; whole < 1; ++steps) {
    const double start = seconds();
    for (Eigen::Array4d& value : f) value.setZero();
    forces.add(u, f);
    in_forces += seconds() - start;
    for (std::size_t n = 0; n < f.size(); ++n) {
      v[n] -= 1e-3 * inverse[n] * f[n];
      u[n] += 1e-3 * v[n];
    }
    whole += seconds() - start;
  }
  const double each = 1e9 / (steps * static_cast<double>(voxels));
  std::printf("explicit steps: %.1f ns an element and step, %.1f of them for the forces (%d steps)\n", each * whole,
              each * in_forces, steps);
}

void report(const char* file, double young, double poisson) {
  const VoxelMesh mesh = voxels_of(io::read_mesh(file));
  const VoxelStiffness stiffness = voxel_stiffness(mesh.edge, young, poisson);
  const VoxelForces forces(mesh, stiffness);
  const Ends ends = ends_of(mesh);
  const NodeField inverse = inverse_diagonal(mesh, stiffness, ends);
  NodeField u = forces.field();
  for (const int n : ends.high) u[n][2] = mesh.edge;
  const double start = seconds();
  const int iterations = solve(forces, inverse, u);
  const double taken = seconds() - start;
  std::printf("%s: %zu elements, %zu nodes, stiffness %.6g N/m, %d iterations, %.3g core-s\n", file, mesh.voxels.size(),
              mesh.nodes.size(), force_at(ends.high, forces, u) / mesh.edge, iterations, taken);
  time_steps(forces, inverse, u, mesh.voxels.size());
}

}  // namespace
}  // namespace strut::reference

int main(int argc, char** argv) {
  if (argc < 2 || argc > 4) {
    std::fputs("usage: bench_voxel_elements MESH.g [YOUNG'S MODULUS] [POISSON'S RATIO]\n", stderr);
    return EXIT_FAILURE;
  }
  try {
    strut::reference::report(argv[1], argc > 2 ? std::atof(argv[2]) : 110e9, argc > 3 ? std::atof(argv[3]) : 0.296);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_voxel_elements: %s\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

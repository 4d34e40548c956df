// Free struts a few points thick: how far the frequencies of today's schemes are from the exact ones, as errors of the
// stiffness, (ω/ω_exact)² − 1, of the first six modes; and the highest frequency, ω h/√(E/ρ), which rules the step.
//   build/release/tests/reference/bench_thin_members [most points across [words of a method's name]]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>

#include "../verification/lattice.hpp"
#include "base/errors.hpp"
#include "frequencies.hpp"
#include "schemes.hpp"
#include "thin_members.hpp"
#include "vibration.hpp"
#include "voxel_elements.hpp"

namespace strut::reference {
namespace {

using Frequencies = std::array<double, 6>;

struct Errors {
  Frequencies of_modes{};
  int zeros = 0;
  double highest = 0;  // ω h/c
};

// A vibrating body as a matrix by mass; E = ρ = 1.
struct Method {
  std::string name;
  std::function<SparseMatrix(const PointCloud&)> matrix;
  bool only_whole_elements = false;
};

SparseMatrix matrix_by(const Scheme& scheme, const PointCloud& cloud) {
  const Communicator world;
  Body body = body_by(scheme, cloud, elastic(1, frequencies_poisson), world);
  return by_mass(stiffness_matrix(body), masses_of(body));
}

// The usual alternative: finite elements whose nodes are the corners of the same cells.
SparseMatrix matrix_by_elements(const PointCloud& cloud) {
  const VoxelMesh mesh = voxels_of(cloud);
  return by_mass(matrix_of(mesh, voxel_stiffness(mesh.edge, 1, frequencies_poisson)), masses_of(mesh, 1));
}

std::vector<Method> methods(const std::string& words) {
  std::vector<Method> all;
  for (const Scheme& scheme : schemes) {
    all.push_back({scheme.name, [scheme](const PointCloud& cloud) { return matrix_by(scheme, cloud); }});
  }
  all.push_back({"finite elements on voxels", matrix_by_elements, true});
  std::erase_if(all, [&](const Method& method) { return method.name.find(words) == std::string::npos; });
  return all;
}

std::optional<Errors> errors_of(const Method& method, const PointCloud& cloud, const Frequencies& exact) {
  try {
    const Vibration found = vibration_of(method.matrix(cloud), 6);
    Errors errors{{}, found.zeros, found.highest * cloud.spacings[0]};
    for (std::size_t m = 0; m < exact.size(); ++m) {
      errors.of_modes[m] = std::pow(found.frequencies[m] / exact[m], 2) - 1;
    }
    return errors;
  } catch (const Error& error) {
    std::fprintf(stderr, "%s: %s\n", method.name.c_str(), error.what());
    return std::nullopt;
  }
}

void prism_row(const Method& method, PointsAt at, int across) {
  std::printf("| %s | %ss | %d ", method.name.c_str(), word(at), across);
  const auto errors = errors_of(method, square_prism(across, at), square_frequencies);
  if (!errors) return void(std::printf("| none | | | | | | | |\n"));
  for (const double e : errors->of_modes) std::printf("| %+.1f ", 100 * e);
  std::printf("| %d | %.2f |\n", errors->zeros, errors->highest);
  std::fflush(stdout);
}

// The mean of the sizes and, with its sign, the worst of the errors of some modes.
void print_spread(const std::vector<Errors>& all, std::initializer_list<int> modes) {
  double sum = 0, worst = 0;
  for (const Errors& errors : all) {
    for (const int m : modes) {
      const double error = errors.of_modes[m];
      sum += std::abs(error);
      if (std::abs(error) > std::abs(worst)) worst = error;
    }
  }
  std::printf("| %.1f (%+.1f) ", 100 * sum / static_cast<double>(all.size() * modes.size()), 100 * worst);
}

void cylinder_row(const Method& method, Cells cells, int across) {
  const std::vector<Placement> placements = random_placements(20);
  std::vector<Errors> all;
  for (const Placement& placement : placements) {
    const auto errors = errors_of(method, round_cylinder(across, placement, cells), round_frequencies);
    if (errors) all.push_back(*errors);
  }
  std::printf("| %s | %s | %d ", method.name.c_str(), cells == Cells::whole ? "whole" : "cut", across);
  if (all.empty()) return void(std::printf("| none | | | | 0 | | |\n"));
  print_spread(all, {0, 1, 2, 3, 4, 5});
  print_spread(all, {0, 1});
  print_spread(all, {2});
  print_spread(all, {5});
  int zeros = 0;
  double highest = 0;
  for (const Errors& errors : all) {
    zeros = std::max(zeros, errors.zeros);
    highest = std::max(highest, errors.highest);
  }
  std::printf("| %zu | %d | %.2f |\n", all.size(), zeros, highest);
  std::fflush(stdout);
}

void prisms(int most, const std::vector<Method>& methods) {
  std::printf("Square prisms: errors of the stiffness, %%\n\n");
  std::printf("| scheme | points at | across | bending | bending | torsion | 2nd bending | 2nd bending | extension ");
  std::printf("| modes without stiffness | ω_max h/c |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Method& method : methods) {
    for (const PointsAt at : {PointsAt::elements, PointsAt::nodes}) {
      if (method.only_whole_elements && at == PointsAt::nodes) continue;
      for (const int across : {2, 3, 4, 6}) {
        if (across <= most) prism_row(method, at, across);
      }
    }
  }
}

void cylinders(int most, const std::vector<Method>& methods) {
  std::printf("\nRound cylinders, 20 directions and offsets: mean size (worst) of the errors of the stiffness, %%\n\n");
  std::printf("| scheme | cells | across | all six | bending | torsion | extension | bodies ");
  std::printf("| most modes without stiffness | largest ω_max h/c |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Method& method : methods) {
    for (const Cells cells : {Cells::whole, Cells::cut}) {
      if (method.only_whole_elements && cells == Cells::cut) continue;
      for (const int across : {2, 3, 4, 6}) {
        if (across <= most) cylinder_row(method, cells, across);
      }
    }
  }
}

}  // namespace
}  // namespace strut::reference

int main(int argc, char** argv) {
  strut::Runtime runtime(argc, argv);
  const int most = argc > 1 ? std::atoi(argv[1]) : 6;
  const auto methods = strut::reference::methods(argc > 2 ? argv[2] : "");
  strut::reference::prisms(most, methods);
  strut::reference::cylinders(most, methods);
}

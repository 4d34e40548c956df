// strut-mesh RECIPE OUT.g: bodies of hexahedra or spheres, from a recipe (tools/README.md).
//   strut-mesh inputs/taylor/bar.recipe bar.g
// strut-mesh --arrays OUT.g: a mesh from another program, read from standard input.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

#include "base/errors.hpp"
#include "base/files.hpp"
#include "io/exodus/exodus.hpp"
#include "mesh/arrays.hpp"
#include "mesh/body.hpp"
#include "mesh/recipe.hpp"

namespace {

constexpr std::size_t most_sets = 64;  // the limit of a run

// Input files must not be overwritten.
void check_output(const std::string& output, const std::filesystem::path& read, const std::string& what) {
  if (strut::same_file(output, read))
    throw strut::Error(output + " is " + what + "; expected another file for the mesh");
}

strut::io::Mesh from_recipe(const std::string& recipe, const std::string& output) {
  check_output(output, recipe, "the recipe");
  const std::vector<strut::mesh::Body> bodies = strut::mesh::read_recipe(recipe);
  for (const strut::mesh::Body& body : bodies) check_output(output, body.file, "a mesh that the recipe reads");
  strut::io::check_replaceable(output);
  std::string summary;
  strut::io::Mesh mesh = strut::mesh::mesh_of(bodies, summary);
  std::fputs(summary.c_str(), stdout);
  return mesh;
}

void write(const strut::io::Mesh& mesh, const std::string& source, const std::string& output) {
  if (mesh.node_sets.size() > most_sets) {
    throw strut::Error(source + ": " + std::to_string(mesh.node_sets.size()) + " node sets, at most " +
                       std::to_string(most_sets) + " are supported");
  }
  strut::io::replace_mesh(output, mesh);
  std::size_t points = 0;
  for (const auto& block : mesh.blocks) points += block.elements();
  std::vector<std::string> sets;
  for (const auto& set : mesh.node_sets) sets.push_back(set.name);
  std::printf("%s: %zu points, %zu nodes; node sets %s\n", output.c_str(), points, mesh.nodes.size(),
              strut::joined(sets).c_str());
}

void make(const std::string& source, const std::string& output) {
  if (source != "--arrays") return write(from_recipe(source, output), source, output);
  strut::io::check_replaceable(output);
  std::ios::sync_with_stdio(false);
  std::string summary;
  const strut::io::Mesh mesh = strut::mesh::read_arrays(std::cin, "standard input", &summary);
  std::fputs(summary.c_str(), stdout);
  write(mesh, "standard input", output);
}

}  // namespace

int main(int argc, char** argv) {
  const bool asks = argc == 2 && (std::string(argv[1]) == "--help" || std::string(argv[1]) == "-h");
  if (argc != 3) {
    std::fputs(
        "usage: strut-mesh RECIPE OUT.g            the mesh of a recipe (tools/README.md has its keys)\n"
        "       strut-mesh --arrays OUT.g < STREAM  of the arrays that tools/voxels sends\n",
        asks ? stdout : stderr);
    return asks ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  std::signal(SIGXFSZ, SIG_IGN);  // a write beyond the limit fails, and is reported like a full disk
  try {
    make(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "strut-mesh: %s\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

// Public header of io for Exodus II files: reads points, writes results. No other room includes exodusII.h. Calls with
// a Communicator are collective.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "topology/cloud.hpp"
#include "topology/mirror.hpp"

namespace strut {
class Communicator;
}

namespace strut::io {

// Reads hex8 (volume by exact integration, centroid), tet4 and sphere elements (attributes: radius, volume; a file with
// one attribute has the radius only, one with none has an element variable Volume). Block names: the file's, else
// "block_<id>". Node sets: the file's names, else "nodelist_<id>". Each rank receives a contiguous slice.
// `at` elements: a point per element; it is in a set if any node of its element is. `at` nodes: a point per node of a
// hex8 or tet4 element, in the first of its blocks in the file; ids count the file's nodes from 0.
// Throws Error on all ranks: file missing, not Exodus, unsupported element type, no elements, volume not positive
// (names element and block, or node), more than 64 node sets; points at the nodes of spheres.
// Points at elements have the shared nodes of cloud.hpp. `with_cells`: also shapes, and shared nodes of points at
// nodes; faces on symmetry `planes` are no surface, and go to `apart`. HEX8 blocks with the attributes of PartialCell:
// volume and position of a point at an element are those of the cell; the spacing is the hexahedron's. Throws Error for
// an invalid cell (names element and block), and for points at nodes.
PointCloud read_exodus(const std::filesystem::path& file, const Communicator& communicator,
                       PointsAt at = PointsAt::elements, bool with_cells = false,
                       const std::vector<Mirror>& planes = {}, FacesOnPlanes* apart = nullptr);

// Lines "x y z block volume" (m, m³; block: an integer n, named "block_n"); '#' starts a comment. Errors name the line.
PointCloud read_text(const std::filesystem::path& file, const Communicator& communicator);

using Triangle = std::array<Vector, 3>;  // m
// The triangles of a mesh of shells (TRI, QUAD, SHELL with 3 or 4 nodes), those of a quadrilateral being two. Throws
// Error on all ranks: file missing, not Exodus, other elements, none.
std::vector<Triangle> read_shells(const std::filesystem::path& file, const Communicator& communicator);

struct OutputField {
  std::string name;    // "Displacement", "Cauchy_Stress", …
  int components = 1;  // 1, 3, 6 or 9
  bool nodal = false;  // else an element variable
};
// The suffixes of 3, 6 or 9 (row by row) components; none for another number of them.
std::vector<std::string> component_names(int components);

// Collective. The reason why a result of these points cannot be written, whatever its fields: numbers or names that the
// file format cannot hold. "" if it can; the same on all ranks.
std::string result_problem(const PointCloud& cloud, const Communicator& communicator);

// Writes one file on any number of ranks: sphere elements, one node each, with the blocks, node sets and element ids
// that were read. It is flushed after every frame, so that it stays readable whatever happens next.
class ExodusWriter {
 public:
  // `cloud`: this rank's points, in the order of the columns given to write(). Replaces a file of that name, or
  // continues after its first `frames`, which must have the checksum `sum`, and after the next one, if it is of the
  // time `uncounted`, s. Errors: the file cannot be created, another run writes to it, it does not have these points,
  // fields or frames.
  ExodusWriter(const std::filesystem::path& file, const Communicator& communicator, const PointCloud& cloud,
               std::vector<OutputField> fields, int frames = 0, double sum = 0, std::optional<double> uncounted = {});
  ~ExodusWriter();

  // columns[k]: field k, all components of this rank's points, point by point. Throws Error if the disk is full.
  void write(double time, std::span<const std::vector<double>> columns);

  int frames() const;  // written so far
  double sum() const;  // on rank 0: checksum of the times and of the values of the last frame
  void sync() const;   // collective: forces the frames to the disk

 private:
  struct File;
  std::unique_ptr<File> file_;
};

// The content of a finished result, for comparison and tests. On rank 0 only (serial use).
struct ExodusResult {
  std::vector<double> times;
  std::array<std::vector<double>, 3> places;  // of the nodes, x, y, z, m
  std::vector<std::string> nodal_names, element_names;
  // [variable][time][point in file order]; element variables in element order (block by block).
  std::vector<std::vector<std::vector<double>>> nodal, element;
};
ExodusResult read_result(const std::filesystem::path& file);
// The time of its last frame, s; nullopt if there is no such file, no frame, or if it is damaged.
std::optional<double> last_time_of_result(const std::filesystem::path& file);

// Knows HEX8, TET4 and SPHERE; throws Error for other types.
int nodes_per_element(const std::string& type);

// The material in an element that is partly filled, or that has absorbed the material of a neighbor.
struct PartialCell {
  double volume = 0;                        // m³
  Vector centroid = Vector::Zero();         // m
  Symmetric moments = Symmetric::Zero();    // central second moments per volume, m² (xx yy zz xy yz zx)
  Vector surface = Vector::Zero();          // ∫ n dA over the material's surface, n outward, m²
  Tensor surface_moments = Tensor::Zero();  // ∫ n ⊗ (x − centroid) dA over it, m³
};
// The names of the attributes in the file, in the order of the members.
extern const std::vector<std::string> partial_cell_attributes;

// A mesh made by a tool, for tools/ and tests.
struct Mesh {
  std::vector<Vector> nodes;
  struct Block {
    std::string name;
    std::string type;             // "HEX8", "TET4" or "SPHERE"
    std::vector<int> nodes;       // 0-based, element by element
    std::vector<double> volumes;  // spheres only
    // For HEX8, or empty: partly filled elements; attributes in the file (io/README.md).
    std::vector<PartialCell> cells;

    std::size_t elements() const { return nodes.empty() ? 0 : nodes.size() / nodes_per_element(type); }
  };
  std::vector<Block> blocks;
  struct NodeSet {
    std::string name;
    std::vector<int> nodes;  // 0-based
  };
  std::vector<NodeSet> node_sets;
};
void write_mesh(const std::filesystem::path& file, const Mesh& mesh);

// The same where a mesh, or a link to one, may exist: writes the file beside it, under a name of this process, and
// renames it when it is complete, so that a full disk costs no earlier mesh. Throws Error, as check_replaceable does
// before the work, if another kind of file exists there or it may not be written.
void replace_mesh(const std::filesystem::path& file, const Mesh& mesh);
void check_replaceable(const std::filesystem::path& file);

// Collective. The points of a mesh in memory, which counts on rank 0 only, as read_exodus gives them.
PointCloud points_of(const Mesh& mesh, const Communicator& communicator, PointsAt at = PointsAt::elements,
                     bool with_cells = false, const std::vector<Mirror>& planes = {}, FacesOnPlanes* apart = nullptr);

// Reads a mesh that write_mesh or another program has written: types as above whatever their spelling in the file,
// names and volumes as for read_exodus. Serial. Throws Error like read_exodus, but does not check volumes.
Mesh read_mesh(const std::filesystem::path& file);

}  // namespace strut::io

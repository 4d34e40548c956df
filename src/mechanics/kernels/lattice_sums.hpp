// The sums over the families of points on a lattice (topology/neighbors/lattice.hpp), eight points at a time, without a
// list of bonds:
// clang-format off
//   shapes     K = Σ ω V_j ξ ⊗ ξ                                 (once)
//   moments    H = Σ ω V_j (u_j − u_i) ⊗ ξ                       (F = I + H K⁻¹)
//              Σ ω V_j (y_j − y_i), the pull of a point's own springs, without the factor C_i
//   residuals  Σ ω V_j t and M = Σ ω V_j t ⊗ ξ                   (both ends' gradients, as in bonds.hpp)
//   forces     Σ ω V_j [A_j ξ + C_j (y_j − y_i)], the force of the far ends
// clang-format on
// They equal those of bonds.hpp up to the order of additions.
//
// Method: without the u_i term, Σ ω V_j u_j ⊗ ξ is a convolution of V u, which is zero in empty cells. It is evaluated
// axis by axis for pencils of eight cells (lattice_gather.cpp). Along z, each column of cells sums Σ ω V u and
// Σ ω dz V u, once for each kind of column in the stencil; along y, these and dy times them are summed over the columns
// at one |dx|; along x, these and dx times them. The 122 bonds of a point at three spacings become 25 additions. Forces
// are evaluated in the opposite order, along x, y and z (lattice_scatter.cpp), because there a point gives many numbers
// and receives few. Residuals are not linear in a point's values (C_ij is the lesser of two) and are evaluated bond by
// bond; so are shapes, which as moments of positions would lose digits far from the origin.
//
// The lattice is traversed in strips of rows, and these plane by plane; the sums of a plane of a strip are handed out
// as soon as they are complete. So only the planes that a stencil reaches are stored, in the cache, and nothing per
// point. A sum has the order of the cells, so that results are the same on any number of ranks.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "base/math/pencil.hpp"
#include "mechanics/body.hpp"
#include "mechanics/kernels/bonds.hpp"

namespace strut {

using small::Indices;

// Prefetches a record: points are visited in the order of memory, so the next ones are a few records further on.
template <class Record>
inline void fetch_ahead(const Record* records, int i) {
  constexpr int ahead = 24;
  const char* first = reinterpret_cast<const char*>(records + i + ahead);
  for (std::size_t line = 0; line < sizeof(Record); line += 64) __builtin_prefetch(first + line);
}

// Some points, one per lane. side_by_side: they are adjacent in one pencil, and so are their sums.
struct LaneIndices {
  Indices i;
  bool side_by_side = false;
};

// The field that is summed: u = y − X of sites, or a field that is stored in place of y.
struct Displacements {
  const Site* sites;
  bool is_field = false;

  Eigen::Array4d operator()(int i) const {
    return is_field ? sites[i].current : Eigen::Array4d(sites[i].current - sites[i].reference);
  }
  // Displacements and volumes of the sites that begin at at(lane).
  struct OfLanes {
    small::Vector3<small::Lanes> u;
    small::Lanes volume;
  };
  template <class At>
  OfLanes of(const At& at) const {
    const auto site = small::numbers_of<8>(at);  // X, V, y, δ
    OfLanes result{{}, site[3]};
    for (int c = 0; c < 3; ++c) {
      result.u.c[c] = is_field ? site[4 + c] : small::Lanes(site[4 + c] - site[c]);
    }
    return result;
  }
};

class LatticeSums {
 public:
  // The sums of a sweep for the points in the slots begin … end − 1. They are valid only during the call of a Take.
  class Chunk {
   public:
    // The indices from `low` to `high` of `points` (ascending local indices) that are in these slots: first and end.
    std::pair<int, int> part_of(const std::vector<int>& points, int low, int high) const;

    // True if points i and j are `apart` cells apart in one pencil.
    bool are_side_by_side(int i, int j, int apart) const {
      const int cell = all->lattice_->cell(i), end = all->lattice_->cell(j);
      return end - cell == apart && cell / pencil_width == end / pencil_width;
    }

    // The sums of some points, after the sweep of the same name.
    small::Tensor3<small::Lanes> shapes(const LaneIndices& points) const;                           // K
    bonds::Moments<small::Lanes> moments(const LaneIndices& points, const Displacements& u) const;  // H
    small::Vector3<small::Lanes> residual_forces(const LaneIndices& points) const;
    small::Tensor3<small::Lanes> residual_moments(const LaneIndices& points) const;                // M
    small::Vector3<small::Lanes> forces(const LaneIndices& points, const Displacements& u) const;  // N/m³
    // Σ ω V |y_j − y_i − F ξ|²
    double squared_residual(int i, const Displacements& u, const Tensor& F, const Symmetric& shape_inverse) const;

   private:
    friend class LatticeSums;
    // The sums of a point: its column c is at [c · pencil_width].
    const double* at(int i) const {
      const int cell = all->lattice_->cell(i);
      return reinterpret_cast<const double*>(sums + static_cast<std::size_t>(cell / pencil_width - begin) * columns) +
             cell % pencil_width;
    }
    Vector vector(int i, int column) const {
      const double* numbers = at(i) + column * pencil_width;
      return {numbers[0], numbers[pencil_width], numbers[2 * pencil_width]};
    }
    struct OfGroup;

    const LatticeSums* all;
    int begin, end;
    const Pencil* sums;
    int columns;
  };
  using Take = std::function<void(const Chunk&)>;

  // Keeps a pointer to the lattice, and passes the shapes of all owned points to `take`.
  LatticeSums(const Body& body, const LatticeFamilies& lattice, const Take& take);
  LatticeSums(const LatticeSums&) = delete;  // traversals refer to their owner
  LatticeSums& operator=(const LatticeSums&) = delete;

  Vector first_moment(int i) const { return constants_[i].head<3>().matrix(); }  // Σ ω V ξ of an owned point, m⁴

  // Each passes the sums of all owned points to `take`, chunk by chunk. The fields must be current on ghosts, too, and
  // must not change meanwhile.
  void moments(const Displacements& u, const Take& take);
  void squares(const Displacements& u, const Take& take);
  // The residuals of the stabilization at `kind` of the variant. `gradients`: F, or δF of a field, and C.
  void residuals(std::size_t kind, const Displacements& u, const std::vector<GradientState>& gradients,
                 const Take& take);
  void forces(const Displacements& u, const std::vector<ForceState>& states, const Take& take);

  double bytes() const;

 private:
  static constexpr int residual_inputs = 15;  // of a point: F − I, u, C̄, V and the fraction of the step

  // A row of the stencil.
  struct Row {
    double y, z;  // m
    int dy, dz, offset, kind;
  };
  // A column of the stencil, along z.
  struct Column {
    double y;  // m
    int dy, kind;
  };
  // The weights of rows or columns that are alike: ω and ω times the distance, 0 … reach cells along them.
  struct Kind {
    int reach = 0;
    double weight[pencil_width + 1] = {}, first[pencil_width + 1] = {};
    bool operator==(const Kind&) const = default;
  };
  // Sums over the family of a point and itself: S = Σ ω V ξ, and in the fourth lane W = Σ ω V.
  using Constants = Eigen::Array4d;
  // The traversal of the lattice by one thread, with its workspaces (lattice_traversal.hpp).
  class Traversal;
  template <int reach>
  struct SquareSweep;
  template <int reach, bool with_springs>
  struct ForceSweep;

  void make_rows(Influence influence);
  void make_columns(Influence influence);
  static int place_in(std::vector<Kind>& kinds, const Kind& kind);
  template <class Weight>
  Kind kind_of(int reach, double spacing, const Eigen::Array2d& aside, Weight weight) const;
  void mark_places();
  void gather_shapes(const Body& body, const Take& take);
  int far_z() const { return static_cast<int>(above_.size()) - 1; }
  int far_y() const { return lattice_->rows_across() / 2; }
  int slots_before(int z, int y) const { return row_begins_[static_cast<std::size_t>(z) * lattice_->shape()[1] + y]; }
  const std::uint64_t* row_of(const std::vector<std::uint64_t>& bits, int z, int y) const {
    return &bits[(static_cast<std::size_t>(z) * lattice_->shape()[1] + y) * words_];
  }
  void set_bits_near(const std::vector<std::uint64_t>& bits, int z, int y, std::uint64_t* row) const;
  template <class Fill>
  void pack(int slot, const Fill& fill, Pencil* to) const;
  template <class Work>
  void over_strips(int pencils, const Work& work);

  // Sums by gathering.
  template <class Fill, class Gather>
  void gather_planes(int inputs, int outputs, const Fill& fill, const Gather& gather, const Take& take);
  template <class Fill, class Gather>
  void gather_pencils(int inputs, int outputs, const Fill& fill, const Gather& gather, const Take& take);
  template <bool with_springs, class Fill>
  void gather_moments(const Fill& fill, const Take& take);
  template <class S>
  void gather_residuals_of(std::size_t kind, const Displacements& u, const std::vector<GradientState>& gradients,
                           const Take& take);

  // Sums by scattering.
  template <class Sweep, class Fill>
  void sweep(const Fill& fill, const Take& take);

  const LatticeFamilies* lattice_;
  std::vector<Row> rows_;
  std::vector<std::vector<Row>> above_;       // rows by dz = 0, 1, …; those below are mirror images
  std::vector<Kind> kinds_;                   // of rows
  std::vector<std::vector<Column>> columns_;  // by |dx| = 0, 1, …
  std::vector<Kind> column_kinds_;
  // A bit for each position in the grid: it has a slot; the slot has points that this rank owns.
  std::vector<std::uint64_t> filled_, owned_;
  int words_ = 0;                // of these bits per row
  std::vector<int> row_begins_;  // the first slot of each row of the grid, or of the next row if it has none
  std::vector<int> slots_at_;    // number of slots in the rows at each y
  int rows_with_slots_ = 0;
  Deduplicated<Constants> constants_;  // of owned points
  bool has_springs_ = false;

  std::vector<std::shared_ptr<Traversal>> traversals_;  // one per thread
};

}  // namespace strut

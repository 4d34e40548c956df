// The sums over the families of points on a lattice (topology/neighbors/lattice.hpp), eight points at a time, without a
// list of bonds:
// clang-format off
//   shapes     K = Σ ω V_j ξ ⊗ ξ                                 (once)
//   moments    H = Σ ω V_j (u_j − u_i) ⊗ ξ                       (F = I + H K⁻¹)
//              Σ ω V_j (y_j − y_i), the pull of its own springs on a point, without the factor C_i
//   residuals  Σ ω V_j t and M = Σ ω V_j t ⊗ ξ                   (both ends' gradients, as in bonds.hpp)
//   forces     Σ ω V_j [A_j ξ + C_j (y_j − y_i)], what the far ends give
// clang-format on
// They are those of bonds.hpp in another order of additions.
//
// Method: with u_i taken out, Σ ω V_j u_j ⊗ ξ is a convolution of V u, zero in empty cells, and is done axis by axis
// for pencils of eight cells (lattice_gather.cpp). A column of cells adds up Σ ω V u and Σ ω dz V u, once for each kind
// of column that the stencil has (along z); those at one |dx| are added up, and dy times these (along y); and what lies
// dx cells aside, and dx times that (along x). Of the 122 bonds of a point at three spacings 25 additions are left.
// Forces go the other way round, along x, y and z (lattice_scatter.cpp): there it is what a point gives that is wide,
// and its sum is narrow. Residuals are not linear in what a point has (C_ij is the lesser of two), and go bond by
// bond; and so do shapes, which as moments of places would lose digits far from the origin.
//
// The lattice is gone through in strips of rows, and these plane by plane; what a plane of a strip has added up is
// handed out as soon as it is complete. So only the planes that a stencil reaches are kept, in the cache, and nothing a
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

// Points are taken in the order in which they stand in memory: what is read soon is a few records on.
template <class Record>
inline void fetch_ahead(const Record* records, int i) {
  constexpr int ahead = 24;
  const char* first = reinterpret_cast<const char*>(records + i + ahead);
  for (std::size_t line = 0; line < sizeof(Record); line += 64) __builtin_prefetch(first + line);
}

// Some points, one a lane, and whether they stand side by side in one pencil, as their sums then do.
struct LaneIndices {
  Indices i;
  bool side_by_side = false;
};

// What is summed: u = y − X of sites, or a field that stands in the place of y.
struct Displacements {
  const Site* sites;
  bool is_field = false;

  Eigen::Array4d operator()(int i) const {
    return is_field ? sites[i].current : Eigen::Array4d(sites[i].current - sites[i].reference);
  }
  // Of the sites that begin at(lane), and their volumes.
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
  // The sums of a sweep over the points in the slots begin … end − 1. They last as long as a Take of them.
  class Chunk {
   public:
    // Which of `points`, ascending local indices, from place `low` to `high`, are in these slots: first and end.
    std::pair<int, int> part_of(const std::vector<int>& points, int low, int high) const;

    // Whether a point and the one `apart` places after it stand so far apart in one pencil.
    bool are_side_by_side(int i, int j, int apart) const {
      const int cell = all->lattice_->cell(i), end = all->lattice_->cell(j);
      return end - cell == apart && cell / pencil_width == end / pencil_width;
    }

    // After the sweep that is named alike: of some points.
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

  // Keeps a pointer to the lattice, and hands the shapes of all owned points to `take`.
  LatticeSums(const Body& body, const LatticeFamilies& lattice, const Take& take);
  LatticeSums(const LatticeSums&) = delete;  // traversals know whose they are
  LatticeSums& operator=(const LatticeSums&) = delete;

  Vector first_moment(int i) const { return constants_[i].head<3>().matrix(); }  // Σ ω V ξ of an owned point, m⁴

  // Each hands the sums of all owned points to `take`, some at a time, from fields that are current in ghosts too and
  // stay as they are meanwhile.
  void moments(const Displacements& u, const Take& take);
  void squares(const Displacements& u, const Take& take);
  // Of the stabilization at `kind` of the variant. `gradients`: F, or δF of a field, and C.
  void residuals(std::size_t kind, const Displacements& u, const std::vector<GradientState>& gradients,
                 const Take& take);
  void forces(const Displacements& u, const std::vector<ForceState>& states, const Take& take);

  double bytes() const;

 private:
  static constexpr int residual_inputs = 15;  // of a point: F − I, u, C̄, V and the share of the step

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
  // Rows or columns of the same weights: ω and ω times the way, 0 … reach cells along them.
  struct Kind {
    int reach = 0;
    double weight[pencil_width + 1] = {}, first[pencil_width + 1] = {};
    bool operator==(const Kind&) const = default;
  };
  // Of a point, over its family and itself: S = Σ ω V ξ, and in the fourth lane W = Σ ω V.
  using Constants = Eigen::Array4d;
  // One thread's way through the lattice, and its workspaces (lattice_traversal.hpp).
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

  // Gathered.
  template <class Fill, class Gather>
  void gather_planes(int inputs, int outputs, const Fill& fill, const Gather& gather, const Take& take);
  template <class Fill, class Gather>
  void gather_pencils(int inputs, int outputs, const Fill& fill, const Gather& gather, const Take& take);
  template <bool with_springs, class Fill>
  void gather_moments(const Fill& fill, const Take& take);
  template <class S>
  void gather_residuals_of(std::size_t kind, const Displacements& u, const std::vector<GradientState>& gradients,
                           const Take& take);

  // Handed over.
  template <class Sweep, class Fill>
  void sweep(const Fill& fill, const Take& take);

  const LatticeFamilies* lattice_;
  std::vector<Row> rows_;
  std::vector<std::vector<Row>> above_;       // rows by dz = 0, 1, …; those below are alike
  std::vector<Kind> kinds_;                   // of rows
  std::vector<std::vector<Column>> columns_;  // by |dx| = 0, 1, …
  std::vector<Kind> column_kinds_;
  // A bit for each place of the grid: whether there is a slot; one with points of this rank's own.
  std::vector<std::uint64_t> filled_, owned_;
  int words_ = 0;                // of these bits a row
  std::vector<int> row_begins_;  // the first slot of each row of the grid, and of the next ones if it has none
  std::vector<int> slots_at_;    // of the rows at each y
  int rows_with_slots_ = 0;
  Deduplicated<Constants> constants_;  // of owned points
  bool has_springs_ = false;

  std::vector<std::shared_ptr<Traversal>> traversals_;  // of threads
};

}  // namespace strut

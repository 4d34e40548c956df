// The sums over the families of points on a lattice (points/lattice.hpp), eight points at a time, without a list of
// bonds:
//   moments    H = Σ ω V_j (u_j − u_i) ⊗ ξ                                      (F = I + H K⁻¹)
//   residuals  Σ ω V_j C_ij z and M = Σ ω V_j C_ij z ⊗ ξ                         (the mean gradient's, as in bonds.hpp)
//   forces     f_i = Σ ω V_j [(A_i + A_j) ξ + (C_i + C_j)(y_j − y_i)]
// They are those of bonds.hpp in another order of additions.
//
// Method: with u_i taken out, Σ ω V_j u_j ⊗ ξ is a convolution of V u, zero in empty cells, and is done axis by axis. A
// pencil of eight cells adds up its own row, Σ ω V u and Σ ω dx V u, once for each kind of row that the stencil has
// (along x); a plane adds up these, and dy times these, for each |dz| (along y); and hands that, and dz times that, to
// the planes above and below (along z). Of the 122 bonds of a point at three spacings 25 additions are left. Forces
// alike. Residuals are not linear in what a point has (C_ij is the lesser of two), and go bond by bond. Sums are added
// up in the order of the planes of the whole lattice, whoever owns them, so that results are the same on any number of
// ranks.
#pragma once

#include <cstdint>
#include <vector>

#include "base/pencil.hpp"
#include "mechanics/body.hpp"

namespace strut {

// What is summed: u = y − X of sites, or a field that stands in the place of y, less `origin`.
struct Displacements {
  const Site* sites;
  bool is_field = false;
  Eigen::Array4d origin = Eigen::Array4d::Zero();

  Eigen::Array4d operator()(int i) const {
    return is_field ? Eigen::Array4d(sites[i].current - origin) : Eigen::Array4d(sites[i].current - sites[i].reference);
  }
};

class LatticeSums {
 public:
  // Keeps a pointer to the lattice.
  LatticeSums(const Body& body, const LatticeFamilies& lattice);

  // Each fills the sums of all owned points from fields that are current in ghosts too; they are to be read before the
  // next one is called. Forces need what moments of the same u leave behind.
  void add_moments(const Body& body, const Displacements& u);
  Tensor moment(int i, const Displacements& u) const {  // H
    return tensor(sums_at(i)) - u(i).head<3>().matrix() * constants_[i].first.transpose();
  }

  // Squares follow upon the moments of the same u.
  void add_squares(const Body& body, const Displacements& u);
  double squared_residual(int i, const Displacements& u, const MaterialPoint& point) const;  // Σ ω V |y_j − y_i − F ξ|²

  // `gradients`: F, or δF of a field, and C̄.
  void add_residuals(const Body& body, const Displacements& u, const std::vector<ForceState>& gradients);
  Vector residual_force(int i) const { return vector(sums_at(i), residual_force_); }
  Tensor residual_moment(int i) const { return tensor(sums_at(i)); }  // M

  void add_forces(const Body& body, const Displacements& u, const std::vector<ForceState>& states);
  Vector force(int i, const Displacements& u, const ForceState& state) const;  // N/m³

  double bytes() const { return static_cast<double>(sizeof(Pencil) * (moved_.size() + source_.size() + sums_.size())); }

 private:
  // A row of the stencil.
  struct Row {
    double y, z;  // m
    int dy, offset, kind;
  };
  // Rows of the same weights: ω and ω dx, at dx = 0 … reach cells.
  struct Kind {
    int reach = 0;
    double weight[pencil_width + 1] = {}, first[pencil_width + 1] = {};
    bool operator==(const Kind&) const = default;
  };
  // Of a point, over its family and itself: Σ ω V ξ, Σ ω V.
  struct Constants {
    Vector first = Vector::Zero();
    double weight = 0;
  };
  // A row of three pencils whose middle stands above, below or beside the one that is looked at.
  struct Triple {
    const Pencil *before, *here, *after;
  };
  // The sums of a row for one kind of rows, from x = 0; how far it is in the grid, and in m.
  struct RowOfSums {
    const Pencil* sums;
    int offset;
    double y;
  };
  struct Residuals;
  class Ring;

  void make_rows(Influence influence);
  void mark_places();
  void set_weights(const Body& body);
  void add_packed_moments();
  template <class Fill>
  void pack(std::vector<Pencil>& source, int columns, const Fill& fill) const;
  void clear(int columns);
  template <class Sweep>
  void over_planes();
  template <class Sweep>
  void over_plane(int z, Ring& ring);
  template <class Sweep>
  void over_row(int z, int y, Ring& ring);
  template <class Sweep>
  void hand_over(int place, int dz, const std::vector<RowOfSums>& near, int first);
  template <int reach>
  struct MomentSweep;
  template <int reach>
  struct SquareSweep;
  template <int reach, bool with_springs>
  struct ForceSweep;
  void gather_residuals(int slot);

  Triple around(int place, const std::vector<Pencil>& source, int columns) const {
    const auto at = [&](int p) { return &source[static_cast<std::size_t>(lattice_->slot_at(p)) * columns]; };
    return {at(place - 1), at(place), at(place + 1)};
  }
  Pencil* sums_of(int slot) { return &sums_[static_cast<std::size_t>(slot) * stride_]; }
  // The sums of a point: its column c is at [c · pencil_width].
  const double* sums_at(int i) const {
    const unsigned cell = lattice_->cell(i);
    return reinterpret_cast<const double*>(&sums_[static_cast<std::size_t>(cell / pencil_width) * stride_]) +
           cell % pencil_width;
  }
  static Vector vector(const double* sums, int column) {
    const double* at = sums + column * pencil_width;
    return {at[0], at[pencil_width], at[2 * pencil_width]};
  }
  static Tensor tensor(const double* sums) {
    Tensor t;
    for (int c = 0; c < 9; ++c) t.data()[c] = sums[c * pencil_width];
    return t;
  }

  const LatticeFamilies* lattice_;
  std::vector<Row> rows_;
  std::vector<std::vector<Row>> above_;  // rows by dz = 0, 1, …; those below are alike
  std::vector<Kind> kinds_;
  // A bit for each place of the grid: whether there is a slot; one with points of this rank's own.
  std::vector<std::uint64_t> filled_, owned_;
  int words_ = 0;                              // of these bits a row
  std::vector<Constants> constants_;           // of owned points
  std::vector<Pencil> moved_, source_, sums_;  // V u; what forces and residuals are made of; some columns a slot each
  bool has_springs_ = false;
  int source_columns_ = 0;
  int stride_ = 0, residual_force_ = 0;  // columns of sums_: a tensor, q = Σ ω V u, and the force of residuals
};

}  // namespace strut

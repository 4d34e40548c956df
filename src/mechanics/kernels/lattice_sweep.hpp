// Inside the sums over lattices: code for the sums that gather (lattice_gather.cpp) and for those that scatter
// (lattice_scatter.cpp).
#pragma once

#include <algorithm>
#include <bit>

#include "mechanics/kernels/bonds.hpp"
#include "mechanics/kernels/lattice_traversal.hpp"

namespace strut {

namespace lattice {

using small::Lanes;
using LaneVector = small::Vector3<Lanes>;
using LaneTensor = small::Tensor3<Lanes>;

// Calls work(n) with the number n as a type, 1 ≤ n ≤ the width of a pencil.
template <int n = 1, class Work>
void with_constant(int value, const Work& work) {
  if (value <= n || n == pencil_width) return work(std::integral_constant<int, n>{});
  if constexpr (n < pencil_width) with_constant<n + 1>(value, work);
}

// Pointers to the records of some points, for numbers_of.
template <class Record>
auto records(const Record* all, const Indices& i) {
  return [all, &i](int l) { return reinterpret_cast<const double*>(all + i[l]); };
}

// The points in some adjacent cells of a pencil; −1 in an empty cell.
struct Cells {
  Indices i;

  // Pointers to the records of these points; to zeros in an empty cell.
  template <class Record>
  auto of(const Record* records) const {
    alignas(64) static constexpr double zeros[sizeof(Record) / sizeof(double)] = {};
    std::array<const double*, small::lane_count> at;
    for (int l = 0; l < small::lane_count; ++l) {
      at[l] = i[l] < 0 ? zeros : reinterpret_cast<const double*>(records + i[l]);
      fetch_ahead(records, i[l]);
    }
    return [at](int l) { return at[l]; };
  }
};

// Writes a column of these cells.
struct Put {
  double* to;
  void operator()(int column, const Lanes& values) const { Eigen::Map<Lanes>(to + column * pencil_width) = values; }
};

// Calls visit(k) for each bit k that is set in a row of words.
template <class Visit>
inline void for_each_bit(const std::uint64_t* words, int count, const Visit& visit) {
  for (int w = 0; w < count; ++w) {
    for (std::uint64_t left = words[w]; left != 0; left &= left - 1) visit(64 * w + std::countr_zero(left));
  }
}

// Sums and differences of the values 1 … reach positions to either side of a column.
template <int reach>
struct Pairs {
  Pencil here, plus[reach + 1], minus[reach + 1];

  template <class Kind>
  Pencil sum(const Kind& kind) const {  // Σ ω a
    Pencil s = kind.weight[0] * here;
    for (int d = 1; d <= reach; ++d) s += kind.weight[d] * plus[d];
    return s;
  }
  template <class Kind>
  Pencil first(const Kind& kind) const {  // Σ ω d a
    Pencil s{};
    for (int d = 1; d <= reach; ++d) s += kind.first[d] * minus[d];
    return s;
  }
};

}  // namespace lattice

// The sums of some points.
struct LatticeSums::Chunk::OfGroup {
  const Chunk& chunk;
  const LaneIndices& points;
  std::array<const double*, small::lane_count> at;  // only the first, if the points are side by side

  OfGroup(const Chunk& c, const LaneIndices& some) : chunk(c), points(some) {
    const int apart = points.side_by_side ? 1 : small::lane_count;
    for (int l = 0; l < apart; ++l) at[l] = chunk.at(points.i[l]);
  }
  small::Lanes column(int c) const {
    if (points.side_by_side) return Eigen::Map<const small::Lanes>(at[0] + c * pencil_width);
    return small::lanes_of([&](int l) { return at[l][c * pencil_width]; });
  }
  lattice::LaneVector vector(int c) const { return {{column(c), column(c + 1), column(c + 2)}}; }
  lattice::LaneTensor tensor(int first) const {  // by columns
    lattice::LaneTensor t;
    for (int c = 0; c < 9; ++c) t.c[c % 3][c / 3] = column(first + c);
    return t;
  }
  std::array<small::Lanes, 4> constants() const {
    return small::numbers_of<4>([&](int l) { return chunk.all->constants_[points.i[l]].data(); });
  }
};

// Fills the columns of a pencil: fill(cells, put) calls put(column, values). In empty cells V and C are 0, and all
// other numbers are finite.
template <class Fill>
void LatticeSums::pack(int slot, const Fill& fill, Pencil* to) const {
  for (int first = 0; first < pencil_width; first += small::lane_count) {
    lattice::Cells cells;
    for (int l = 0; l < small::lane_count; ++l) cells.i[l] = lattice_->point(slot, first + l);
    fill(cells, lattice::Put{reinterpret_cast<double*>(to) + first});
  }
}

}  // namespace strut

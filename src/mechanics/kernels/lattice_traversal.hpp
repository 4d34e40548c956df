// Inside the sums over lattices: how one thread traverses the lattice, strip by strip and plane by plane, and its
// workspaces. Strips are independent of each other, and a sum does not depend on how the rows are divided into
// strips. Also code for both the sums that gather (lattice_gather.cpp) and those that scatter (lattice_scatter.cpp).
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "base/parallel/threads.hpp"
#include "mechanics/kernels/bonds.hpp"
#include "mechanics/kernels/lattice_sums.hpp"

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

// The rows y0 … y1 − 1 of all planes.
struct Strip {
  int y0, y1;
};

// The sums of a row for one kind of row, from x = 0; the offset of the row in the grid; its distance, m.
struct RowOfSums {
  const Pencil* sums;
  int offset;
  double y;
};

// The sums of the columns of one kind in a row, from x = 0; bits of the x that have any; the distance of the row, m.
struct ColumnOfSums {
  const Pencil* sums;
  const std::uint64_t* filled;
  double y;
};

// Some numbers of each point in the slots of a strip, for as many planes as are kept.
class Planes {
 public:
  void keep(int planes);
  // Opens plane z for the slots from `begin` to `end`; its values are undefined.
  void open(int z, int begin, int end, int columns);
  void clear(int z) { std::fill(of(z, begin(z)), of(z, end(z)), Pencil{}); }
  int begin(int z) const { return begins_[z % count_]; }
  int end(int z) const { return ends_[z % count_]; }
  Pencil* of(int z, int slot) {
    return storage_[z % count_].data() + static_cast<std::size_t>(slot - begin(z)) * columns_;
  }
  std::size_t pencils() const;

 private:
  int columns_ = 0, count_ = 1;
  std::vector<std::vector<Pencil>> storage_;
  std::vector<int> begins_, ends_;  // slots
};

// The sums along x or z at each x of the rows that a stencil reaches in a plane.
struct Ring {
  int rows = 1, columns = 0;  // per x
  std::vector<Pencil> storage;
  void open(int across, int of_a_place, int places) {
    rows = across, columns = of_a_place;
    storage.resize(std::max(storage.size(), static_cast<std::size_t>(rows) * places * columns));
  }
  Pencil* row(int y, int places) { return storage.data() + static_cast<std::size_t>(y % rows) * places * columns; }
};

// Divides a lattice whose rows hold slots_at[y] slots into `count` strips or more, a multiple of the threads, with
// about as many slots each. Rows beside a strip are summed again for the next one.
std::vector<Strip> strips(const std::vector<int>& slots_at, int far_y, int count);

}  // namespace lattice

class LatticeSums::Traversal {
 public:
  explicit Traversal(const LatticeSums& all);

  // Gathers: packs the sources, `inputs` per point, plane by plane; gather(z) computes the `outputs` of the strip's
  // points in a plane as soon as all planes that a stencil reaches are packed.
  template <class Fill, class Gather>
  void gather_strip(const lattice::Strip& strip, int inputs, int outputs, const Fill& fill, const Gather& gather,
                    const Take& take);
  template <class Gather>
  void for_each_slot(int z, const Gather& gather) {
    for (int slot = sums_.begin(z); slot < sums_.end(z); ++slot) {
      if (lattice_->is_owned(slot)) gather(slot);
    }
  }
  void gather_shape(int slot, int z);
  template <class S>
  void gather_residuals(int slot, int z);
  template <int reach, bool with_springs>
  void gather_moments(int z, const lattice::Strip& strip);

  // Hands over.
  template <class Sweep, class Fill>
  void sweep_strip(const lattice::Strip& strip, const Fill& fill, const Take& take);

  double bytes() const;

 private:
  struct Shapes;
  template <class S>
  struct Residuals;

  int far_z() const { return all_.far_z(); }
  int far_y() const { return all_.far_y(); }
  void open(lattice::Planes& planes, int z, int y0, int y1, int columns) {
    planes.open(z, all_.slots_before(z, y0), all_.slots_before(z, y1), columns);
  }
  void take_plane(int z, int columns, const Take& take);

  template <int reach>
  void sum_columns(int z, int y);
  void sum_across(int x, Pencil* to) const;
  template <bool with_springs>
  void gather_row(int z, int y);
  std::uint64_t* column_bits(int y) { return &column_bits_[static_cast<std::size_t>(y % ring_.rows) * all_.words_]; }
  const Pencil* source_at(int place, int z) {
    const int slot = lattice_->slot_at(place);
    return slot == 0 ? nothing_.data() : sources_.of(z, slot);
  }

  template <class Sweep, class Fill>
  void sum_plane(int z, const lattice::Strip& strip, const Fill& fill);
  template <class Sweep, class Fill>
  void sum_row(int z, int y, const Fill& fill);
  template <class Sweep>
  void hand_over_row(int z, int y);
  template <class Sweep>
  void hand_over(int place, int z, int dz, int first);

  const LatticeSums& all_;
  const LatticeFamilies* lattice_;
  lattice::Ring ring_;
  lattice::Planes sums_, sources_;
  std::vector<Pencil> nothing_;
  // For gathering: columns by |dx|; bits of the x at which the rows of the ring have columns; their sums at four
  // positions.
  std::vector<std::vector<lattice::ColumnOfSums>> columns_near_;
  std::vector<std::uint64_t> column_bits_;
  std::vector<Pencil> across_;
  // For handing over: numbers of all positions of a row, zero between rows; rows by |dz|; bits of the positions that
  // receive something.
  std::vector<Pencil> row_;
  std::vector<std::vector<lattice::RowOfSums>> near_;
  std::vector<std::uint64_t> targets_;
};

// Calls work(traversal, strip) for strips whose planes take about a megabyte, at `pencils` pencils per slot. There is
// at least one strip per thread, even if it is hardly higher than the rows beside it that are summed twice.
template <class Work>
void LatticeSums::over_strips(int pencils, const Work& work) {
  constexpr double budget = 1 << 20;
  const int y_rows = static_cast<int>(slots_at_.size()) - 2 * far_y();
  const double a_row = sizeof(Pencil) * pencils * lattice_->slots() / (1.0 + rows_with_slots_);
  const int height =
      std::max(4 * far_y() + 2, static_cast<int>(budget / a_row));  // because the rows beside a strip are summed twice
  const std::vector<lattice::Strip> strips = lattice::strips(slots_at_, far_y(), (y_rows + height - 1) / height);
  while (traversals_.size() < static_cast<std::size_t>(threads())) {
    traversals_.push_back(std::make_shared<Traversal>(*this));
  }
  side_by_side(static_cast<int>(strips.size()),
               [&](int s) { work(*traversals_[static_cast<std::size_t>(this_thread())], strips[s]); });
}

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

// Sums that each point hands over to its neighbors: many numbers per point, few per result.
#include "mechanics/kernels/lattice_traversal.hpp"

namespace strut {

using namespace lattice;

// ---- Sweeps --------------------------------------------------------------------------------------------------------

// A Sweep defines a sum: its `inputs` per point, its `columns` per row and kind, row_sums(pencils, to) along x,
// add(sums of a row, dy) along y, and hand(to, dz) along z, to the `outputs` of a point. Points are at least as far
// from the first and last plane and row as a stencil reaches.
template <class Sweep, class Fill>
void LatticeSums::sweep(const Fill& fill, const Take& take) {
  over_strips((2 * far_z() + 1) * Sweep::outputs,
              [&](Traversal& traversal, const Strip& strip) { traversal.sweep_strip<Sweep>(strip, fill, take); });
}

template <class Sweep, class Fill>
void LatticeSums::Traversal::sweep_strip(const Strip& strip, const Fill& fill, const Take& take) {
  const Eigen::Array3i& shape = lattice_->shape();
  const int planes = shape[2], far = far_z();
  row_.assign(static_cast<std::size_t>(shape[0]) * Sweep::inputs, Pencil{});
  ring_.open(lattice_->rows_across(), static_cast<int>(all_.kinds_.size()) * Sweep::columns, shape[0]);
  sums_.keep(2 * far + 1);
  for (int z = 0; z < planes; ++z) {
    if (z + far < planes) {
      open(sums_, z + far, strip.y0, strip.y1, Sweep::outputs);
      sums_.clear(z + far);
    }
    if (z >= far && z < planes - far) sum_plane<Sweep>(z, strip, fill);
    if (z >= 2 * far) take_plane(z - far, Sweep::outputs, take);
  }
}

template <class Sweep, class Fill>
void LatticeSums::Traversal::sum_plane(int z, const Strip& strip, const Fill& fill) {
  if (all_.slots_before(z, strip.y0 - far_y()) == all_.slots_before(z, strip.y1 + far_y())) return;
  int next = strip.y0 - far_y();  // next row to be summed along x
  for (int y = strip.y0; y < strip.y1; ++y) {
    for (; next <= y + far_y(); ++next) sum_row<Sweep>(z, next, fill);
    hand_over_row<Sweep>(z, y);
  }
}

template <class Sweep, class Fill>
void LatticeSums::Traversal::sum_row(int z, int y, const Fill& fill) {
  const int places = lattice_->shape()[0], row = z * lattice_->shape()[1] + y;
  const std::uint64_t* filled = all_.row_of(all_.filled_, z, y);
  Pencil* const sums = ring_.row(y, places);
  for_each_bit(filled, all_.words_, [&](int x) {
    all_.pack(lattice_->slot_at(row * places + x), fill, &row_[static_cast<std::size_t>(x) * Sweep::inputs]);
  });
  for_each_bit(filled, all_.words_, [&](int x) {
    const Pencil* here = &row_[static_cast<std::size_t>(x) * Sweep::inputs];
    Sweep::row_sums(all_.kinds_, here, sums + static_cast<std::size_t>(x) * ring_.columns);
  });
  for_each_bit(filled, all_.words_, [&](int x) {
    std::fill_n(&row_[static_cast<std::size_t>(x) * Sweep::inputs], Sweep::inputs, Pencil{});
  });
}

// Adds the sums of the rows around row y of plane z to the pencils above and below it.
template <class Sweep>
void LatticeSums::Traversal::hand_over_row(int z, int y) {
  const int places = lattice_->shape()[0];
  for (int dz = 0; dz <= far_z(); ++dz) {
    near_[dz].clear();
    for (const Row& r : all_.above_[dz]) {
      near_[dz].push_back({ring_.row(y + r.dy, places) + Sweep::columns * r.kind, r.dy * places, r.y});
    }
  }
  all_.set_bits_near(all_.owned_, z, y, targets_.data());
  const int row = (z * lattice_->shape()[1] + y) * places;
  for_each_bit(targets_.data(), all_.words_, [&](int x) {
    for (int dz = 0; dz <= far_z(); ++dz) hand_over<Sweep>(row + x, z, dz, x * ring_.columns);
  });
}

// `first`: index of the pencil's own x in the sums of each row. Inlined, because a call costs a fifth of a sweep.
template <class Sweep>
__attribute__((always_inline)) inline void LatticeSums::Traversal::hand_over(int place, int z, int dz, int first) {
  const int away = dz * lattice_->shape()[0] * lattice_->shape()[1];
  const int below = lattice_->slot_at(place - away), over = lattice_->slot_at(place + away);
  const bool to_below = lattice_->is_owned(below), to_over = dz > 0 && lattice_->is_owned(over);
  if (!to_below && !to_over) return;
  Sweep sums;
  for (const RowOfSums& row : near_[dz]) {
    if (lattice_->slot_at(place + row.offset) != 0) sums.add(row.sums + first, row.y);
  }
  const double height = all_.above_[dz][0].z;
  if (to_below) sums.hand(sums_.of(z - dz, below), height);
  if (to_over) sums.hand(sums_.of(z + dz, over), -height);
}

namespace {

template <int dx, int reach>
__attribute__((always_inline)) inline void add_pairs(const Pencil& before, const Pencil& here, const Pencil& after,
                                                     Pairs<reach>& pairs) {
  const Pencil right = shifted<dx>(before, here, after), left = shifted<-dx>(before, here, after);
  pairs.plus[dx] = right + left;
  pairs.minus[dx] = right - left;
  if constexpr (dx < reach) add_pairs<dx + 1>(before, here, after, pairs);
}

// The pairs of one column of three adjacent pencils with `inputs` columns each.
template <int reach, int inputs>
__attribute__((always_inline)) inline Pairs<reach> pairs_of(const Pencil* middle, int column) {
  const Pencil &before = middle[column - inputs], &here = middle[column], &after = middle[column + inputs];
  Pairs<reach> pairs{.here = here};
  add_pairs<1>(before, here, after, pairs);
  return pairs;
}

}  // namespace

// ---- Squares -------------------------------------------------------------------------------------------------------

template <int reach>
struct LatticeSums::SquareSweep {
  static constexpr int inputs = 4, columns = 4, outputs = 4;  // V |u|², V u; Σ ω V |u|², q = Σ ω V u
  Pencil sum[4] = {};

  static void row_sums(const std::vector<Kind>& kinds, const Pencil* here, Pencil* to) {
    for (int c = 0; c < columns; ++c) {
      const auto u = pairs_of<reach, inputs>(here, c);
      for (std::size_t k = 0; k < kinds.size(); ++k) to[k * columns + c] = u.sum(kinds[k]);
    }
  }
  void add(const Pencil* row, double) {
    for (int c = 0; c < columns; ++c) sum[c] += row[c];
  }
  void hand(Pencil* to, double) const {
    for (int c = 0; c < columns; ++c) to[c] += sum[c];
  }
};

void LatticeSums::squares(const Displacements& u, const Take& take) {
  const auto fill = [&](const Cells& cells, const Put& put) {
    const auto [ui, V] = u.of(cells.of(u.sites));
    put(0, V * bonds::dot(ui, ui));
    for (int c = 0; c < 3; ++c) put(1 + c, V * ui.c[c]);
  };
  with_constant(lattice_->reach(), [&](auto reach) { sweep<SquareSweep<reach>>(fill, take); });
}

// Σ ω V |u_j − u_i|² − H : (F − I), where H = (F − I) K are the moments; the first sum is Σ ω V |u_j|² − 2 u_i·q + W
// |u_i|².
double LatticeSums::Chunk::squared_residual(int i, const Displacements& u, const Tensor& F,
                                            const Symmetric& shape_inverse) const {
  const Vector ui = u(i).head<3>().matrix();
  const double squares = *at(i) - 2 * ui.dot(vector(i, 1)) + all->constants_[i][3] * ui.squaredNorm();
  const Tensor gradient = F - Tensor::Identity();
  const Tensor shape = to_tensor(shape_inverse).inverse();
  return std::max(0.0, squares - (gradient * shape).cwiseProduct(gradient).sum());
}

// ---- Forces --------------------------------------------------------------------------------------------------------

template <int reach, bool with_springs>
struct LatticeSums::ForceSweep {
  static constexpr int inputs = with_springs ? 13 : 9;   // V A, and with springs V C u and V C
  static constexpr int columns = with_springs ? 10 : 9;  // Σ ω V (dx A_x + C u), Σ ω V A_y, Σ ω V A_z; Σ ω V C
  static constexpr int outputs = with_springs ? 4 : 3;   // Σ ω V (A ξ + C u); Σ ω V C
  Pencil sum[3] = {}, along_z[3] = {}, stiffness = {};

  static void row_sums(const std::vector<Kind>& kinds, const Pencil* here, Pencil* to) {
    const auto pairs = [&](int column) { return pairs_of<reach, inputs>(here, column); };
    for (int c = 0; c < 3; ++c) {
      const Pairs<reach> x = pairs(c), y = pairs(3 + c), z = pairs(6 + c);
      for (std::size_t k = 0; k < kinds.size(); ++k) {
        Pencil* of_kind = to + k * columns;
        of_kind[c] = x.first(kinds[k]);
        of_kind[3 + c] = y.sum(kinds[k]);
        of_kind[6 + c] = z.sum(kinds[k]);
      }
      if constexpr (with_springs) {
        const Pairs<reach> pull = pairs(9 + c);
        for (std::size_t k = 0; k < kinds.size(); ++k) to[k * columns + c] += pull.sum(kinds[k]);
      }
    }
    if constexpr (with_springs) {
      const Pairs<reach> spring = pairs(12);
      for (std::size_t k = 0; k < kinds.size(); ++k) to[k * columns + 9] = spring.sum(kinds[k]);
    }
  }
  void add(const Pencil* row, double y) {
    for (int c = 0; c < 3; ++c) {
      sum[c] += row[c] + y * row[3 + c];
      along_z[c] += row[6 + c];
    }
    if constexpr (with_springs) stiffness += row[9];
  }
  void hand(Pencil* to, double z) const {
    for (int c = 0; c < 3; ++c) to[c] += sum[c] + z * along_z[c];
    if constexpr (with_springs) to[3] += stiffness;
  }
};

// Σ ω V_j (A_j ξ + C_j (ξ + u_j)) − u_i Σ ω V_j C_j, over the family and the point itself; for a field, without C_j ξ.
void LatticeSums::forces(const Displacements& u, const std::vector<ForceState>& states, const Take& take) {
  const auto fill = [&](const Cells& cells, const Put& put) {
    const auto [ui, V] = u.of(cells.of(u.sites));
    const auto A = small::numbers_of<12>(cells.of(states.data()));
    const Lanes& C = A[3];
    for (int axis = 0; axis < 3; ++axis) {
      for (int c = 0; c < 3; ++c) {
        put(3 * axis + c, c == axis && !u.is_field ? Lanes(V * (A[4 * axis + c] + C)) : Lanes(V * A[4 * axis + c]));
      }
    }
    if (!has_springs_) return;
    for (int c = 0; c < 3; ++c) put(9 + c, V * C * ui.c[c]);
    put(12, V * C);
  };
  with_constant(lattice_->reach(), [&](auto reach) {
    has_springs_ ? sweep<ForceSweep<reach, true>>(fill, take) : sweep<ForceSweep<reach, false>>(fill, take);
  });
}

LaneVector LatticeSums::Chunk::forces(const LaneIndices& points, const Displacements& u) const {
  const OfGroup group(*this, points);
  LaneVector f = group.vector(0);
  if (!all->has_springs_) return f;
  const LaneVector ui = u.of(records(u.sites, points.i)).u;
  const Lanes stiffness = group.column(3);
  for (int r = 0; r < 3; ++r) f.c[r] -= stiffness * ui.c[r];
  return f;
}

}  // namespace strut

#include "mechanics/lattice_sums.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "mechanics/bonds.hpp"
#include "points/parallel.hpp"

namespace strut {

namespace {

// Columns of a source: V u; V A and V C u; F − I, u, C̄ and V.
constexpr int moment_columns = 3, force_columns = 9, spring_columns = 13, residual_columns = 15;
constexpr int tensor_sums = 9;  // columns of the sums: a tensor, then q

// Calls work(n) with the number as a type, 1 ≤ n ≤ a pencil's width.
template <int n = 1, class Work>
void with_constant(int value, const Work& work) {
  if (value <= n || n == pencil_width) return work(std::integral_constant<int, n>{});
  if constexpr (n < pencil_width) with_constant<n + 1>(value, work);
}

}  // namespace

LatticeSums::LatticeSums(const Body& body, const LatticeFamilies& lattice)
    : lattice_(&lattice), constants_(body.owned()) {
  make_rows(body.influence);
  mark_places();
  has_springs_ = std::any_of(body.blocks.begin(), body.blocks.end(),
                             [](const MaterialBlock& block) { return block.material.stabilization > 0; });
  const bool has_residuals = !body.force_states.gradients.empty();
  residual_force_ = has_springs_ ? tensor_sums + 3 : tensor_sums;
  stride_ = has_springs_ && has_residuals ? tensor_sums + 6 : tensor_sums + 3;
  source_columns_ = has_residuals ? residual_columns : has_springs_ ? spring_columns : force_columns;
  moved_.assign(static_cast<std::size_t>(lattice.slots()) * moment_columns, Pencil{});
  source_.assign(static_cast<std::size_t>(lattice.slots()) * source_columns_, Pencil{});
  sums_.assign(static_cast<std::size_t>(lattice.slots()) * stride_, Pencil{});
  set_weights(body);
}

void LatticeSums::make_rows(Influence influence) {
  const Vector& h = lattice_->frame().spacing;
  bonds::with_influence(influence, [&](auto weight) {
    for (const LatticeFamilies::Row& row : lattice_->rows()) {
      const double y = row.y * h[1], z = row.z * h[2];
      Kind kind{.reach = row.reach};
      for (int dx = 0; dx <= row.reach; ++dx) {
        const double x = dx * h[0];
        kind.weight[dx] = weight.of(std::sqrt(x * x + y * y + z * z) / lattice_->frame().horizon);
        kind.first[dx] = kind.weight[dx] * x;
      }
      const auto known = std::find(kinds_.begin(), kinds_.end(), kind);
      rows_.push_back({y, z, row.y, row.offset, static_cast<int>(known - kinds_.begin())});
      if (known == kinds_.end()) kinds_.push_back(kind);
      if (row.z < 0) continue;
      above_.resize(row.z + 1);
      above_[row.z].push_back(rows_.back());
    }
  });
}

void LatticeSums::mark_places() {
  const Eigen::Array3i& shape = lattice_->shape();
  words_ = (shape[0] + 63) / 64;
  filled_.assign(static_cast<std::size_t>(shape[1]) * shape[2] * words_, 0);
  owned_ = filled_;
  for (int slot = 1; slot < lattice_->slots(); ++slot) {
    const int row = lattice_->place(slot) / shape[0], x = lattice_->place(slot) % shape[0];
    const std::size_t word = static_cast<std::size_t>(row) * words_ + x / 64;
    const std::uint64_t bit = std::uint64_t{1} << x % 64;
    filled_[word] |= bit;
    if (lattice_->is_owned(slot)) owned_[word] |= bit;
  }
}

// With V or V C in the place of V u, moments and q are what is looked for.
void LatticeSums::set_weights(const Body& body) {
  pack(moved_, moment_columns, [&](int i, const auto& put) { put(0, body.domain.volumes[i]); });
  add_packed_moments();
  for (const int i : lattice_->members()) {
    if (i >= body.owned()) continue;
    const double* sums = sums_at(i);
    constants_[i].first = tensor(sums).row(0);
    constants_[i].weight = vector(sums, tensor_sums)[0];
  }
}

// Fills a source, `columns` pencils a slot, by fill(point, put) with put(column, value). Empty cells stay zero.
template <class Fill>
void LatticeSums::pack(std::vector<Pencil>& source, int columns, const Fill& fill) const {
  for_each_point(1, lattice_->slots(), [&](int slot) {
    double* cells = reinterpret_cast<double*>(&source[static_cast<std::size_t>(slot) * columns]);
    for (int lane = 0; lane < pencil_width; ++lane) {
      const int i = lattice_->point(slot, lane);
      if (i >= 0) fill(i, [&](int column, double value) { cells[column * pencil_width + lane] = value; });
    }
  });
}

// The first `columns` of the sums.
void LatticeSums::clear(int columns) {
  for_each_point(0, lattice_->slots(), [&](int slot) {
    if (lattice_->is_owned(slot)) std::fill_n(sums_of(slot), columns, Pencil{});
  });
}

// The row sums of the rows of a plane that a stencil reaches from the row at hand.
class LatticeSums::Ring {
 public:
  Ring(int rows, int places, int columns)
      : rows_(rows), columns_(columns), stride_(places * columns), room_(static_cast<std::size_t>(rows) * stride_) {}
  Pencil* row(int y) { return &room_[static_cast<std::size_t>(y % rows_) * stride_]; }
  int columns() const { return columns_; }  // of a place

 private:
  int rows_, columns_, stride_;
  std::vector<Pencil> room_;
};

namespace {

// Calls visit(k) for the bits that are set in a row of words.
template <class Visit>
inline void for_each_bit(const std::uint64_t* words, int count, const Visit& visit) {
  for (int w = 0; w < count; ++w) {
    for (std::uint64_t left = words[w]; left != 0; left &= left - 1) visit(64 * w + std::countr_zero(left));
  }
}

}  // namespace

// A Sweep says what is summed: its columns a row and kind, row_sums(place, to) along x, add(sums of a row, dy) along
// y, and hand(to, dz) along z. What a plane adds to lies within a slab's thickness, so every other slab may run at a
// time.
template <class Sweep>
void LatticeSums::over_planes() {
  const Eigen::Array3i& shape = lattice_->shape();
  const int planes = shape[2], first = lattice_->first_plane(), far = static_cast<int>(above_.size()) - 1;
  const int thickness = std::max(1, 2 * far);
  const auto slab_of = [&](int plane) { return static_cast<int>(std::floor(1.0 * plane / thickness)); };
  for (const int odd : {0, 1}) {
    for_each_point(slab_of(first), slab_of(first + planes - 1) + 1, [&](int slab) {
      if (std::abs(slab) % 2 != odd) return;
      Ring ring(lattice_->rows_across(), shape[0], static_cast<int>(kinds_.size()) * Sweep::columns);
      // Points are at least as far from the first and last plane as a stencil reaches.
      const int begin = std::max(far, slab * thickness - first);
      const int end = std::min(planes - far, (slab + 1) * thickness - first);
      for (int z = begin; z < end; ++z) over_plane<Sweep>(z, ring);
    });
  }
}

template <class Sweep>
void LatticeSums::over_plane(int z, Ring& ring) {
  const Eigen::Array3i& shape = lattice_->shape();
  const int far_y = lattice_->rows_across() / 2;
  int next = 0;  // row to be summed along x
  for (int y = far_y; y < shape[1] - far_y; ++y) {
    for (; next <= y + far_y; ++next) {
      const int row = z * shape[1] + next;
      for_each_bit(&filled_[static_cast<std::size_t>(row) * words_], words_,
                   [&](int x) { Sweep::row_sums(*this, row * shape[0] + x, ring.row(next) + x * ring.columns()); });
    }
    over_row<Sweep>(z, y, ring);
  }
}

// What the rows about row y of plane z give to the pencils above and below it.
template <class Sweep>
void LatticeSums::over_row(int z, int y, Ring& ring) {
  const Eigen::Array3i& shape = lattice_->shape();
  const int far_z = static_cast<int>(above_.size()) - 1, row = z * shape[1] + y;
  std::vector<std::vector<RowOfSums>> near(above_.size());
  for (int dz = 0; dz <= far_z; ++dz) {
    for (const Row& r : above_[dz]) {
      near[dz].push_back({ring.row(y + r.dy) + Sweep::columns * r.kind, r.dy * shape[0], r.y});
    }
  }
  std::vector<std::uint64_t> targets(words_, 0);
  for (int dz = -far_z; dz <= far_z; ++dz) {
    const std::uint64_t* owned = &owned_[static_cast<std::size_t>(row + dz * shape[1]) * words_];
    for (int w = 0; w < words_; ++w) targets[w] |= owned[w];
  }
  for_each_bit(targets.data(), words_, [&](int x) {
    for (int dz = 0; dz <= far_z; ++dz) hand_over<Sweep>(row * shape[0] + x, dz, near[dz], x * ring.columns());
  });
}

// `first`: where the sums of the pencil's own x stand in each row. Inlined: as a call it costs a fifth of a sweep.
template <class Sweep>
__attribute__((always_inline)) inline void LatticeSums::hand_over(int place, int dz, const std::vector<RowOfSums>& near,
                                                                  int first) {
  const int away = dz * lattice_->shape()[0] * lattice_->shape()[1];
  const int below = lattice_->slot_at(place - away), over = lattice_->slot_at(place + away);
  const bool to_below = lattice_->is_owned(below), to_over = dz > 0 && lattice_->is_owned(over);
  if (!to_below && !to_over) return;
  Sweep sums;
  for (const RowOfSums& row : near) {
    if (lattice_->slot_at(place + row.offset) != 0) sums.add(row.sums + first, row.y);
  }
  if (to_below) sums.hand(sums_of(below), above_[dz][0].z);
  if (to_over) sums.hand(sums_of(over), -above_[dz][0].z);
}

namespace {

// What lies dx = 1 … reach cells to the right and to the left in one column of a row: sums and differences.
template <int reach>
struct Pairs {
  Pencil here, plus[reach + 1], minus[reach + 1];

  Pairs(const Pencil& before, const Pencil& middle, const Pencil& after) : here(middle) { fill(before, after); }

  template <class Kind>
  Pencil sum(const Kind& kind) const {  // Σ ω a
    Pencil s = kind.weight[0] * here;
    for (int dx = 1; dx <= reach; ++dx) s += kind.weight[dx] * plus[dx];
    return s;
  }
  template <class Kind>
  Pencil first(const Kind& kind) const {  // Σ ω dx a
    Pencil s{};
    for (int dx = 1; dx <= reach; ++dx) s += kind.first[dx] * minus[dx];
    return s;
  }

 private:
  template <int dx = 1>
  void fill(const Pencil& before, const Pencil& after) {
    if constexpr (dx <= reach) {
      const Pencil right = shifted<dx>(before, here, after), left = shifted<-dx>(before, here, after);
      plus[dx] = right + left;
      minus[dx] = right - left;
      fill<dx + 1>(before, after);
    }
  }
};

}  // namespace

// ---- Moments -------------------------------------------------------------------------------------------------------

template <int reach>
struct LatticeSums::MomentSweep {
  static constexpr int columns = 6;  // Σ ω V u, Σ ω dx V u
  Pencil sum[3] = {}, along_x[3] = {}, along_y[3] = {};

  static void row_sums(const LatticeSums& all, int place, Pencil* to) {
    const Triple row = all.around(place, all.moved_, moment_columns);
    for (int c = 0; c < 3; ++c) {
      const Pairs<reach> u(row.before[c], row.here[c], row.after[c]);
      for (std::size_t k = 0; k < all.kinds_.size(); ++k) {
        to[k * columns + c] = u.sum(all.kinds_[k]);
        to[k * columns + 3 + c] = u.first(all.kinds_[k]);
      }
    }
  }
  void add(const Pencil* row, double y) {
    for (int c = 0; c < 3; ++c) {
      sum[c] += row[c];
      along_x[c] += row[3 + c];
      along_y[c] += y * row[c];
    }
  }
  void hand(Pencil* to, double z) const {
    for (int c = 0; c < 3; ++c) {
      to[c] += along_x[c];
      to[3 + c] += along_y[c];
      to[6 + c] += z * sum[c];
      to[tensor_sums + c] += sum[c];
    }
  }
};

void LatticeSums::add_moments(const Body& body, const Displacements& u) {
  pack(moved_, moment_columns, [&](int i, const auto& put) {
    const Eigen::Array4d Vu = body.domain.volumes[i] * u(i);
    for (int c = 0; c < 3; ++c) put(c, Vu[c]);
  });
  add_packed_moments();
}

void LatticeSums::add_packed_moments() {
  clear(tensor_sums + 3);
  with_constant(lattice_->reach(), [this](auto reach) { over_planes<MomentSweep<reach>>(); });
}

// ---- Squares -------------------------------------------------------------------------------------------------------

template <int reach>
struct LatticeSums::SquareSweep {
  static constexpr int columns = 1;  // Σ ω V |u|²
  Pencil sum = {};

  static void row_sums(const LatticeSums& all, int place, Pencil* to) {
    const Triple row = all.around(place, all.moved_, moment_columns);
    const Pairs<reach> square(row.before[0], row.here[0], row.after[0]);
    for (std::size_t k = 0; k < all.kinds_.size(); ++k) to[k] = square.sum(all.kinds_[k]);
  }
  void add(const Pencil* row, double) { sum += *row; }
  void hand(Pencil* to, double) const { *to += sum; }
};

void LatticeSums::add_squares(const Body& body, const Displacements& u) {
  pack(moved_, moment_columns,
       [&](int i, const auto& put) { put(0, body.domain.volumes[i] * u(i).head<3>().square().sum()); });
  clear(1);
  with_constant(lattice_->reach(), [this](auto reach) { over_planes<SquareSweep<reach>>(); });
}

// Σ ω V |u_j − u_i|² − H : (F − I), H = (F − I) K being the moments; the first sum is Σ ω V |u_j|² − 2 u_i·q + W
// |u_i|².
double LatticeSums::squared_residual(int i, const Displacements& u, const MaterialPoint& point) const {
  const double* sums = sums_at(i);
  const Vector ui = u(i).head<3>().matrix();
  const double squares = sums[0] - 2 * ui.dot(vector(sums, tensor_sums)) + constants_[i].weight * ui.squaredNorm();
  const Tensor gradient = point.deformation_gradient - Tensor::Identity();
  const Tensor shape = to_tensor(point.shape_inverse).inverse();
  return std::max(0.0, squares - (gradient * shape).cwiseProduct(gradient).sum());
}

// ---- Forces --------------------------------------------------------------------------------------------------------

template <int reach, bool with_springs>
struct LatticeSums::ForceSweep {
  // Σ ω V (dx A_x + C u), Σ ω V A_y, Σ ω V A_z; Σ ω V C
  static constexpr int columns = with_springs ? 10 : 9;
  Pencil sum[3] = {}, along_z[3] = {}, springs = {};

  static void row_sums(const LatticeSums& all, int place, Pencil* to) {
    const Triple row = all.around(place, all.source_, all.source_columns_);
    const auto pairs = [&](int column) {
      return Pairs<reach>(row.before[column], row.here[column], row.after[column]);
    };
    for (int c = 0; c < 3; ++c) {
      const Pairs<reach> x = pairs(c), y = pairs(3 + c), z = pairs(6 + c);
      for (std::size_t k = 0; k < all.kinds_.size(); ++k) {
        Pencil* of_kind = to + k * columns;
        of_kind[c] = x.first(all.kinds_[k]);
        of_kind[3 + c] = y.sum(all.kinds_[k]);
        of_kind[6 + c] = z.sum(all.kinds_[k]);
      }
      if constexpr (with_springs) {
        const Pairs<reach> pull = pairs(force_columns + c);
        for (std::size_t k = 0; k < all.kinds_.size(); ++k) to[k * columns + c] += pull.sum(all.kinds_[k]);
      }
    }
    if constexpr (with_springs) {
      const Pairs<reach> C = pairs(force_columns + 3);
      for (std::size_t k = 0; k < all.kinds_.size(); ++k) to[k * columns + 9] = C.sum(all.kinds_[k]);
    }
  }
  void add(const Pencil* row, double y) {
    for (int c = 0; c < 3; ++c) {
      sum[c] += row[c] + y * row[3 + c];
      along_z[c] += row[6 + c];
    }
    if constexpr (with_springs) springs += row[9];
  }
  void hand(Pencil* to, double z) const {
    for (int c = 0; c < 3; ++c) to[c] += sum[c] + z * along_z[c];
    if constexpr (with_springs) to[3] += springs;
  }
};

// f_i = Σ ω V_j (A_j ξ + C_j (ξ + u_j)) + A_i S + C_i (S + q − W u_i) − u_i Σ ω V_j C_j, where S = Σ ω V_j ξ, W = Σ ω
// V_j, q = Σ ω V_j u_j, over the family and the point itself; of a field without C_j ξ and C_i S.
void LatticeSums::add_forces(const Body& body, const Displacements& u, const std::vector<ForceState>& states) {
  pack(source_, source_columns_, [&](int i, const auto& put) {
    const double V = body.domain.volumes[i], C = states[i].column[0][3], stretched = u.is_field ? 0 : C;
    for (int axis = 0; axis < 3; ++axis) {
      for (int c = 0; c < 3; ++c) put(3 * axis + c, V * (states[i].column[axis][c] + (c == axis ? stretched : 0)));
    }
    if (!has_springs_) return;
    const Eigen::Array4d pull = V * C * u(i);
    for (int c = 0; c < 3; ++c) put(force_columns + c, pull[c]);
    put(force_columns + 3, V * C);
  });
  clear(4);
  with_constant(lattice_->reach(), [this](auto reach) {
    has_springs_ ? over_planes<ForceSweep<reach, true>>() : over_planes<ForceSweep<reach, false>>();
  });
}

Vector LatticeSums::force(int i, const Displacements& u, const ForceState& state) const {
  const Constants& own = constants_[i];
  Tensor A;
  for (int c = 0; c < 3; ++c) A.col(c) = state.column[c].head<3>().matrix();
  const double* sums = sums_at(i);
  Vector f = vector(sums, 0) + A * own.first;
  if (!has_springs_) return f;
  const Vector ui = u(i).head<3>().matrix();
  Vector stretch = vector(sums, tensor_sums) - own.weight * ui;
  if (!u.is_field) stretch += own.first;
  const double springs = sums[3 * pencil_width];
  return f + state.column[0][3] * stretch - springs * ui;
}

// ---- Residuals -----------------------------------------------------------------------------------------------------

void LatticeSums::add_residuals(const Body& body, const Displacements& u, const std::vector<ForceState>& gradients) {
  pack(source_, source_columns_, [&](int i, const auto& put) {
    const Eigen::Array4d ui = u(i);
    for (int axis = 0; axis < 3; ++axis) {
      for (int c = 0; c < 3; ++c) {
        put(3 * axis + c, gradients[i].column[axis][c] - (c == axis && !u.is_field ? 1 : 0));
      }
      put(9 + axis, ui[axis]);
    }
    put(12, gradients[i].column[0][3]);
    put(13, body.domain.volumes[i]);
    put(14, gradients[i].column[1][3]);
  });
  for_each_point(1, lattice_->slots(), [this](int slot) { gather_residuals(slot); });
}

// The bonds of eight points with one row of their stencils.
struct LatticeSums::Residuals {
  const Pencil* own;     // columns of the points
  const Triple& there;   // columns of the row
  const Pencil* fitted;  // u − ½ (H_y dy + H_z dz) of the row: before, here and after, three each
  const Pencil* base;    // u + ½ (H_y dy + H_z dz) of the points
  const Kind& kind;
  double spacing;                     // along x, m
  Pencil sum[3] = {}, first[3] = {};  // Σ t and Σ dx t, t = ω V_j C_ij z

  template <int dx>
  void add_bond() {
    const double x = dx * spacing;
    const auto far = [this](int column) {
      return shifted<dx>(there.before[column], there.here[column], there.after[column]);
    };
    const Pencil C = far(12), share = far(14);
    const Pencil stiffness = (own[12] < C ? own[12] : C) * (own[14] < share ? share : own[14]);
    const Pencil weight = (2 * kind.weight[dx < 0 ? -dx : dx]) * far(13) * stiffness;
    for (int c = 0; c < 3; ++c) {
      const Pencil u = shifted<dx>(fitted[c], fitted[3 + c], fitted[6 + c]);
      const Pencil t = weight * (u - base[c] - (0.5 * x) * (own[c] + far(c)));
      sum[c] += t;
      first[c] += x * t;
    }
  }

  template <int dx = 1>
  void add_bonds() {
    if constexpr (dx <= pencil_width) {
      if (dx > kind.reach) return;
      add_bond<dx>();
      add_bond<-dx>();
      add_bonds<dx + 1>();
    }
  }
};

void LatticeSums::gather_residuals(int slot) {
  if (!lattice_->is_owned(slot)) return;
  const int place = lattice_->place(slot);
  const Pencil* own = around(place, source_, source_columns_).here;
  Pencil M[9] = {}, force[3] = {};
  for (const Row& row : rows_) {
    const Triple there = around(place + row.offset, source_, source_columns_);
    const Pencil* ends[] = {there.before, there.here, there.after};
    Pencil fitted[9], base[3];
    for (int c = 0; c < 3; ++c) {
      for (int end = 0; end < 3; ++end) {
        fitted[3 * end + c] = ends[end][9 + c] - 0.5 * (row.y * ends[end][3 + c] + row.z * ends[end][6 + c]);
      }
      base[c] = own[9 + c] + 0.5 * (row.y * own[3 + c] + row.z * own[6 + c]);
    }
    Residuals bonds{own, there, fitted, base, kinds_[row.kind], lattice_->frame().spacing[0]};
    bonds.add_bond<0>();
    bonds.add_bonds();
    for (int c = 0; c < 3; ++c) {
      force[c] += bonds.sum[c];
      M[c] += bonds.first[c];
      M[3 + c] += row.y * bonds.sum[c];
      M[6 + c] += row.z * bonds.sum[c];
    }
  }
  std::copy_n(M, 9, sums_of(slot));
  std::copy_n(force, 3, sums_of(slot) + residual_force_);
}

}  // namespace strut

#include "mechanics/lattice_sums.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/bonds.hpp"
#include "points/parallel.hpp"

namespace strut {

namespace {

// Columns of a source: V u; V A and V C u; F − I, u, C̄ and V.
constexpr int moment_columns = 3, force_columns = 9, spring_columns = 12, residual_columns = 14;
constexpr int tensor_sums = 9;  // columns of the sums: a tensor, then q

}  // namespace

LatticeSums::LatticeSums(const Body& body, const LatticeFamilies& lattice, const std::vector<double>& springs)
    : lattice_(&lattice) {
  make_rows(body.influence);
  has_springs_ = std::any_of(springs.begin(), springs.end(), [](double C) { return C > 0; });
  const bool has_residuals = !body.force_states.gradients.empty();
  residual_force_ = has_springs_ ? tensor_sums + 3 : tensor_sums;
  stride_ = has_springs_ && has_residuals ? tensor_sums + 6 : tensor_sums + 3;
  const int columns = has_residuals ? residual_columns : has_springs_ ? spring_columns : force_columns;
  source_.assign(static_cast<std::size_t>(lattice.slots()) * columns, Pencil{});
  sums_.assign(static_cast<std::size_t>(lattice.slots()) * stride_, Pencil{});
  set_constants(body, springs);
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
      rows_.push_back({y, z, row.offset, row.reach, static_cast<int>(known - kinds_.begin())});
      if (known == kinds_.end()) kinds_.push_back(kind);
    }
  });
}

// With V and V C in the place of V u, moments and q are what is looked for.
void LatticeSums::set_constants(const Body& body, const std::vector<double>& springs) {
  pack(moment_columns, [&](int i, const auto& put) {
    put(0, body.domain.volumes[i]);
    put(1, body.domain.volumes[i] * springs[i]);
  });
  clear(stride_);
  over_slots([this](int slot, Pencil* room) { scatter_moments(slot, room); });
  constants_.resize(body.owned());
  for (const int i : lattice_->members()) {
    if (i < body.owned()) {
      constants_[i] = {{sum(i, 0), sum(i, 3), sum(i, 6)}, sum(i, tensor_sums), sum(i, tensor_sums + 1)};
    }
  }
}

// Fills the source, `columns` pencils a slot, by fill(point, put) with put(column, value); zero in empty cells.
template <class Fill>
void LatticeSums::pack(int columns, const Fill& fill) {
  for_each_point(1, lattice_->slots(), [&](int slot) {
    Pencil* pencils = &source_[static_cast<std::size_t>(slot) * columns];
    std::fill_n(pencils, columns, Pencil{});
    for (int lane = 0; lane < pencil_width; ++lane) {
      const int i = lattice_->point(slot, lane);
      if (i >= 0) fill(i, [&](int column, double value) { pencils[column][lane] = value; });
    }
  });
  std::fill_n(source_.begin(), columns, Pencil{});
}

// The first `columns` of all sums.
void LatticeSums::clear(int columns) {
  for_each_point(0, lattice_->slots(), [&](int slot) { std::fill_n(sums_of(slot), columns, Pencil{}); });
}

// Calls scatter(slot, room for row sums) for all slots. What a slot adds to lies within a slab's thickness of its plane, so
// every other slab may run at a time.
template <class Scatter>
void LatticeSums::over_slots(const Scatter& scatter) {
  const std::vector<int>& begin = lattice_->plane_begin();
  const int planes = static_cast<int>(begin.size()) - 1, first = lattice_->first_plane();
  const int thickness = std::max(1, 2 * lattice_->rows().back().z);
  const auto slab_of = [&](int plane) { return static_cast<int>(std::floor(1.0 * plane / thickness)); };
  for (const int odd : {0, 1}) {
    for_each_point(slab_of(first), slab_of(first + planes - 1) + 1, [&](int slab) {
      if (std::abs(slab) % 2 != odd) return;
      std::vector<Pencil> room(kinds_.size() * spring_columns);
      const int from = std::max(0, slab * thickness - first), to = std::min(planes, (slab + 1) * thickness - first);
      for (int slot = begin[from]; slot < begin[to]; ++slot) scatter(slot, room.data());
    });
  }
}

// Calls add(sums of a slot, row) for the slots in whose stencils the pencil at `place` lies, its row in each of them.
template <class Add>
void LatticeSums::hand_out(int place, const Add& add) {
  for (const Row& row : rows_) {
    const int target = lattice_->slot_at(place - row.offset);
    if (lattice_->is_owned(target)) add(sums_of(target), row);
  }
}

namespace {

// The sums and differences of what lies dx cells to the right and to the left, dx = 1 … reach.
template <int dx = 1>
inline void pairs(const Pencil& before, const Pencil& here, const Pencil& after, int reach, Pencil* plus,
                  Pencil* minus) {
  if constexpr (dx <= pencil_width) {
    if (dx > reach) return;
    const Pencil right = shifted<dx>(before, here, after), left = shifted<-dx>(before, here, after);
    plus[dx] = right + left;
    minus[dx] = right - left;
    pairs<dx + 1>(before, here, after, reach, plus, minus);
  }
}

}  // namespace

// Σ ω a and Σ ω dx a along a row of one column, a pencil for each kind.
template <bool with_sum, bool with_first>
inline void LatticeSums::row_sums(const Triple& row, int column, Pencil* sum, Pencil* first, int stride) const {
  Pencil plus[pencil_width + 1], minus[pencil_width + 1];
  const Pencil here = row.here[column];
  pairs(row.before[column], here, row.after[column], lattice_->reach(), plus, minus);
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    const Kind& kind = kinds_[k];
    Pencil s = kind.weight[0] * here, f{};
    for (int dx = 1; dx <= kind.reach; ++dx) {
      if constexpr (with_sum) s += kind.weight[dx] * plus[dx];
      if constexpr (with_first) f += kind.first[dx] * minus[dx];
    }
    if constexpr (with_sum) sum[k * stride] = s;
    if constexpr (with_first) first[k * stride] = f;
  }
}

// ---- Moments -------------------------------------------------------------------------------------------------------

void LatticeSums::add_moments(const Body& body, const Displacements& u) {
  pack(moment_columns, [&](int i, const auto& put) {
    const Eigen::Array4d Vu = body.domain.volumes[i] * u(i);
    for (int c = 0; c < 3; ++c) put(c, Vu[c]);
  });
  clear(tensor_sums + 3);
  over_slots([this](int slot, Pencil* room) { scatter_moments(slot, room); });
}

void LatticeSums::scatter_moments(int slot, Pencil* room) {
  const int place = lattice_->place(slot);
  const Triple row = around(place, moment_columns);
  for (int c = 0; c < 3; ++c) row_sums<true, true>(row, c, room + c, room + 3 + c, 6);
  hand_out(place, [room](Pencil* to, const Row& row) {
    const Pencil* from = room + 6 * row.kind;
    for (int c = 0; c < 3; ++c) {
      to[c] += from[3 + c];
      to[3 + c] += row.y * from[c];
      to[6 + c] += row.z * from[c];
      to[tensor_sums + c] += from[c];
    }
  });
}

Tensor LatticeSums::moment(int i, const Displacements& u) const {
  return tensor(i) - u(i).head<3>().matrix() * constants_[i].first.transpose();
}

// ---- Forces --------------------------------------------------------------------------------------------------------

// f_i = Σ ω V_j (A_j ξ + C_j (ξ + u_j)) + A_i S + C_i (S + q − W u_i) − u_i Σ ω V_j C_j, where S = Σ ω V_j ξ, W = Σ ω V_j,
// q = Σ ω V_j u_j, over the family and the point itself; of a field without C_j ξ and C_i S.
void LatticeSums::add_forces(const Body& body, const Displacements& u, const std::vector<ForceState>& states) {
  pack(has_springs_ ? spring_columns : force_columns, [&](int i, const auto& put) {
    const double V = body.domain.volumes[i], C = states[i].column[0][3], stretched = u.is_field ? 0 : C;
    for (int axis = 0; axis < 3; ++axis) {
      for (int c = 0; c < 3; ++c) put(3 * axis + c, V * (states[i].column[axis][c] + (c == axis ? stretched : 0)));
    }
    if (!has_springs_) return;
    const Eigen::Array4d pull = V * C * u(i);
    for (int c = 0; c < 3; ++c) put(force_columns + c, pull[c]);
  });
  clear(3);
  if (has_springs_) {
    over_slots([this](int slot, Pencil* room) { scatter_forces<true>(slot, room); });
  } else {
    over_slots([this](int slot, Pencil* room) { scatter_forces<false>(slot, room); });
  }
}

template <bool with_springs>
void LatticeSums::scatter_forces(int slot, Pencil* room) {
  const int place = lattice_->place(slot);
  const Triple row = around(place, with_springs ? spring_columns : force_columns);
  for (int c = 0; c < 3; ++c) {
    row_sums<false, true>(row, c, nullptr, room + c, spring_columns);
    row_sums<true, false>(row, 3 + c, room + 3 + c, nullptr, spring_columns);
    row_sums<true, false>(row, 6 + c, room + 6 + c, nullptr, spring_columns);
    if constexpr (with_springs) {
      row_sums<true, false>(row, force_columns + c, room + force_columns + c, nullptr, spring_columns);
      for (std::size_t k = 0; k < kinds_.size(); ++k) {
        room[k * spring_columns + c] += room[k * spring_columns + force_columns + c];
      }
    }
  }
  hand_out(place, [room](Pencil* to, const Row& row) {
    const Pencil* from = room + spring_columns * row.kind;
    for (int c = 0; c < 3; ++c) to[c] += from[c] + row.y * from[3 + c] + row.z * from[6 + c];
  });
}

Vector LatticeSums::force(int i, const Displacements& u, const ForceState& state) const {
  const Constants& own = constants_[i];
  Tensor A;
  for (int c = 0; c < 3; ++c) A.col(c) = state.column[c].head<3>().matrix();
  Vector f = vector(i, 0) + A * own.first;
  if (!has_springs_) return f;
  const Vector ui = u(i).head<3>().matrix();
  Vector stretch = vector(i, tensor_sums) - own.weight * ui;
  if (!u.is_field) stretch += own.first;
  return f + state.column[0][3] * stretch - own.springs * ui;
}

// ---- Residuals -----------------------------------------------------------------------------------------------------

void LatticeSums::add_residuals(const Body& body, const Displacements& u, const std::vector<ForceState>& gradients) {
  pack(residual_columns, [&](int i, const auto& put) {
    const Eigen::Array4d ui = u(i);
    for (int axis = 0; axis < 3; ++axis) {
      for (int c = 0; c < 3; ++c) {
        put(3 * axis + c, gradients[i].column[axis][c] - (c == axis && !u.is_field ? 1 : 0));
      }
      put(9 + axis, ui[axis]);
    }
    put(12, gradients[i].column[0][3]);
    put(13, body.domain.volumes[i]);
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
  double spacing;              // along x, m
  Pencil sum[3] = {}, first[3] = {};  // Σ t and Σ dx t, t = ω V_j C_ij z

  template <int dx>
  void add_bond() {
    const double x = dx * spacing;
    const auto far = [this](int column) {
      return shifted<dx>(there.before[column], there.here[column], there.after[column]);
    };
    const Pencil C = far(12);
    const Pencil weight = (2 * kind.weight[dx < 0 ? -dx : dx]) * far(13) * (own[12] < C ? own[12] : C);
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
  const Pencil* own = around(place, residual_columns).here;
  Pencil M[9] = {}, force[3] = {};
  for (const Row& row : rows_) {
    const Triple there = around(place + row.offset, residual_columns);
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

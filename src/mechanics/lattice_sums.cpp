#include "mechanics/lattice_sums.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "mechanics/bonds.hpp"

namespace strut {

namespace {

using small::Lanes;
using LaneVector = small::Vector3<Lanes>;
using LaneTensor = small::Tensor3<Lanes>;

// What is summed of a point for residuals: F − I, u, C̄, V and the share of the step; and what comes of it: M, a force.
constexpr int residual_inputs = 15, residual_outputs = 12;

// Calls work(n) with the number as a type, 1 ≤ n ≤ a pencil's width.
template <int n = 1, class Work>
void with_constant(int value, const Work& work) {
  if (value <= n || n == pencil_width) return work(std::integral_constant<int, n>{});
  if constexpr (n < pencil_width) with_constant<n + 1>(value, work);
}

// Where the records of some points begin, for numbers_of.
template <class Record>
auto records(const Record* all, const Indices& i) {
  return [all, &i](int l) { return reinterpret_cast<const double*>(all + i[l]); };
}

// The points in some cells side by side of a pencil; −1 where there is none.
struct Cells {
  Indices i;

  // Where the records of these points begin; where there is no point, at zeros.
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

// Where a column of these cells is put.
struct Put {
  double* to;
  void operator()(int column, const Lanes& values) const { Eigen::Map<Lanes>(to + column * pencil_width) = values; }
};

// Calls visit(k) for the bits that are set in a row of words.
template <class Visit>
inline void for_each_bit(const std::uint64_t* words, int count, const Visit& visit) {
  for (int w = 0; w < count; ++w) {
    for (std::uint64_t left = words[w]; left != 0; left &= left - 1) visit(64 * w + std::countr_zero(left));
  }
}

}  // namespace

LatticeSums::LatticeSums(const Body& body, const LatticeFamilies& lattice) : lattice_(&lattice) {
  make_rows(body.influence);
  mark_places();
  has_springs_ = body.has_springs();
  near_.resize(above_.size());
  targets_.resize(words_);
  nothing_.assign(residual_inputs, Pencil{});
  set_constants(body);
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
      rows_.push_back({y, z, row.y, row.z, row.offset, static_cast<int>(known - kinds_.begin())});
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
  row_begins_.assign(static_cast<std::size_t>(shape[1]) * shape[2] + 1, 0);
  for (int slot = 1; slot < lattice_->slots(); ++slot) {
    const int row = lattice_->place(slot) / shape[0], x = lattice_->place(slot) % shape[0];
    const std::size_t word = static_cast<std::size_t>(row) * words_ + x / 64;
    const std::uint64_t bit = std::uint64_t{1} << x % 64;
    filled_[word] |= bit;
    if (lattice_->is_owned(slot)) owned_[word] |= bit;
    row_begins_[row + 1] = slot + 1;
  }
  row_begins_[0] = 1;
  for (std::size_t row = 1; row < row_begins_.size(); ++row) {
    row_begins_[row] = std::max(row_begins_[row], row_begins_[row - 1]);
  }
}

// With V in the place of V u, moments are what is looked for.
void LatticeSums::set_constants(const Body& body) {
  std::vector<Constants> constants(body.owned(), Constants::Zero());
  const Displacements u{body.domain.sites.data()};
  const auto volume = [&](const Cells& cells, const Put& put) { put(0, u.of(cells.of(u.sites)).volume); };
  const auto each_owned = [&](const Chunk& chunk, const auto& set) {
    for (int cell = pencil_width * chunk.begin; cell < pencil_width * chunk.end; ++cell) {
      const int i = lattice_->point(cell / pencil_width, cell % pencil_width);
      if (i >= 0 && i < body.owned()) set(i);
    }
  };
  with_constant(lattice_->reach(), [&](auto reach) {
    sweep<MomentSweep<reach, true>>(volume, [&](const Chunk& chunk) {
      each_owned(chunk, [&](int i) {
        for (int c = 0; c < 4; ++c) constants[i][c] = chunk.at(i)[3 * c * pencil_width];
      });
    });
  });
  // As round-off of their sums, and of alike families the same.
  const double length = lattice_->frame().horizon;
  for (Constants& c : constants) {
    if (!(c[3] > 0)) continue;
    for (int k = 0; k < 4; ++k) c[k] = rounded(c[k], k < 3 ? c[3] * length : c[3], 48);
  }
  constants_ = Repeated<Constants>(std::move(constants));
}

double LatticeSums::bytes() const {
  const std::size_t rows = row_begins_.size() * sizeof(int) + 2 * filled_.size() * sizeof(std::uint64_t);
  return static_cast<double>(rows + sizeof(Pencil) * (row_.size() + ring_.room.size())) + constants_.bytes() +
         sums_.bytes() + sources_.bytes();
}

std::pair<int, int> LatticeSums::Chunk::part_of(const std::vector<int>& points, int low, int high) const {
  const auto place_of = [&](int slot) {
    const auto is_before = [this](int i, int cell) { return all->lattice_->cell(i) < cell; };
    const auto at = std::lower_bound(points.begin() + low, points.begin() + high, pencil_width * slot, is_before);
    return static_cast<int>(at - points.begin());
  };
  return {place_of(begin), place_of(end)};
}

// The sums of some points.
struct LatticeSums::Chunk::OfGroup {
  const Chunk& chunk;
  const Abreast& points;
  std::array<const double*, small::lane_count> at;  // the first alone, of points side by side

  OfGroup(const Chunk& c, const Abreast& some) : chunk(c), points(some) {
    const int apart = points.side_by_side ? 1 : small::lane_count;
    for (int l = 0; l < apart; ++l) at[l] = chunk.at(points.i[l]);
  }
  Lanes column(int c) const {
    if (points.side_by_side) return Eigen::Map<const Lanes>(at[0] + c * pencil_width);
    return small::lanes_of([&](int l) { return at[l][c * pencil_width]; });
  }
  LaneVector vector(int c) const { return {{column(c), column(c + 1), column(c + 2)}}; }
  LaneTensor tensor(int first) const {  // by columns
    LaneTensor t;
    for (int c = 0; c < 9; ++c) t.c[c % 3][c / 3] = column(first + c);
    return t;
  }
  std::array<Lanes, 4> constants() const {
    return small::numbers_of<4>([&](int l) { return chunk.all->constants_[points.i[l]].data(); });
  }
};

LaneVector LatticeSums::Chunk::residual_forces(const Abreast& points) const { return OfGroup(*this, points).vector(9); }
LaneTensor LatticeSums::Chunk::residual_moments(const Abreast& points) const {
  return OfGroup(*this, points).tensor(0);
}

// ---- Strips --------------------------------------------------------------------------------------------------------

// As many rows as leave what is kept of the planes, `columns` a slot, in half a megabyte; twice what a stencil reaches
// at least, for the rows beside a strip are summed along x once more for the next one.
std::vector<LatticeSums::Strip> LatticeSums::strips(int columns) const {
  constexpr double room = 1 << 19;
  const Eigen::Array3i& shape = lattice_->shape();
  double rows = 1;  // that hold anything
  for (std::size_t row = 1; row < row_begins_.size(); ++row) rows += row_begins_[row] > row_begins_[row - 1];
  const double a_row = sizeof(Pencil) * columns * (2 * far_z() + 1) * lattice_->slots() / rows;
  const int height = std::max(4 * far_y() + 2, static_cast<int>(room / a_row));
  std::vector<Strip> strips;
  for (int y = far_y(); y < shape[1] - far_y(); y += height) {
    strips.push_back({y, std::min(y + height, shape[1] - far_y())});
  }
  return strips;
}

void LatticeSums::Planes::open(const LatticeSums& all, int z, int y0, int y1, int columns) {
  const std::size_t count = 2 * all.far_z() + 1;
  columns_ = columns;
  room_.resize(count), begins_.resize(count), ends_.resize(count);
  begins_[z % count] = all.slots_before(z, y0), ends_[z % count] = all.slots_before(z, y1);
  room_[z % count].assign(static_cast<std::size_t>(end(z) - begin(z)) * columns, Pencil{});
}

double LatticeSums::Planes::bytes() const {
  std::size_t pencils = 0;
  for (const auto& plane : room_) pencils += plane.capacity();
  return static_cast<double>(sizeof(Pencil) * pencils);
}

void LatticeSums::take_plane(int z, int columns, const Take& take) {
  Chunk chunk;
  chunk.all = this, chunk.begin = sums_.begin(z), chunk.end = sums_.end(z), chunk.columns = columns;
  if (chunk.begin == chunk.end) return;
  chunk.sums = sums_.of(z, chunk.begin);
  take(chunk);
}

// ---- Sweeps --------------------------------------------------------------------------------------------------------

// A Sweep says what is summed: its `inputs` a point, its `columns` a row and kind, row_sums(pencils, to) along x,
// add(sums of a row, dy) along y, and hand(to, dz) along z, to the `outputs` of a point. Points are at least as far
// from the first and last plane and row as a stencil reaches.
template <class Sweep, class Fill>
void LatticeSums::sweep(const Fill& fill, const Take& take) {
  const Eigen::Array3i& shape = lattice_->shape();
  const int planes = shape[2], far = far_z();
  row_.assign(static_cast<std::size_t>(shape[0]) * Sweep::inputs, Pencil{});
  ring_.rows = lattice_->rows_across(), ring_.columns = static_cast<int>(kinds_.size()) * Sweep::columns;
  ring_.room.resize(static_cast<std::size_t>(ring_.rows) * shape[0] * ring_.columns);
  for (const Strip& strip : strips(Sweep::outputs)) {
    for (int z = 0; z < planes; ++z) {
      if (z + far < planes) sums_.open(*this, z + far, strip.y0, strip.y1, Sweep::outputs);
      if (z >= far && z < planes - far) sum_plane<Sweep>(z, strip, fill);
      if (z >= 2 * far) take_plane(z - far, Sweep::outputs, take);
    }
  }
}

template <class Sweep, class Fill>
void LatticeSums::sum_plane(int z, const Strip& strip, const Fill& fill) {
  if (slots_before(z, strip.y0 - far_y()) == slots_before(z, strip.y1 + far_y())) return;
  int next = strip.y0 - far_y();  // row to be summed along x
  for (int y = strip.y0; y < strip.y1; ++y) {
    for (; next <= y + far_y(); ++next) sum_row<Sweep>(z, next, fill);
    hand_over_row<Sweep>(z, y);
  }
}

// Fills the columns of a pencil by fill(cells, put) with put(column, values). In empty cells V and C are 0, and all
// else is finite.
template <class Fill>
void LatticeSums::pack(int slot, const Fill& fill, Pencil* to) const {
  for (int first = 0; first < pencil_width; first += small::lane_count) {
    Cells cells;
    for (int l = 0; l < small::lane_count; ++l) cells.i[l] = lattice_->point(slot, first + l);
    fill(cells, Put{reinterpret_cast<double*>(to) + first});
  }
}

template <class Sweep, class Fill>
void LatticeSums::sum_row(int z, int y, const Fill& fill) {
  const int places = lattice_->shape()[0], row = z * lattice_->shape()[1] + y;
  const std::uint64_t* filled = row_of(filled_, z, y);
  Pencil* const sums = ring_.row(y, places);
  for_each_bit(filled, words_, [&](int x) {
    pack(lattice_->slot_at(row * places + x), fill, &row_[static_cast<std::size_t>(x) * Sweep::inputs]);
  });
  for_each_bit(filled, words_, [&](int x) {
    const Pencil* here = &row_[static_cast<std::size_t>(x) * Sweep::inputs];
    Sweep::row_sums(kinds_, here, sums + static_cast<std::size_t>(x) * ring_.columns);
  });
  for_each_bit(filled, words_, [&](int x) {
    std::fill_n(&row_[static_cast<std::size_t>(x) * Sweep::inputs], Sweep::inputs, Pencil{});
  });
}

// What the rows about row y of plane z give to the pencils above and below it.
template <class Sweep>
void LatticeSums::hand_over_row(int z, int y) {
  const int places = lattice_->shape()[0];
  for (int dz = 0; dz <= far_z(); ++dz) {
    near_[dz].clear();
    for (const Row& r : above_[dz]) {
      near_[dz].push_back({ring_.row(y + r.dy, places) + Sweep::columns * r.kind, r.dy * places, r.y});
    }
  }
  std::fill(targets_.begin(), targets_.end(), 0);
  for (int dz = -far_z(); dz <= far_z(); ++dz) {
    const std::uint64_t* owned = row_of(owned_, z + dz, y);
    for (int w = 0; w < words_; ++w) targets_[w] |= owned[w];
  }
  const int row = (z * lattice_->shape()[1] + y) * places;
  for_each_bit(targets_.data(), words_, [&](int x) {
    for (int dz = 0; dz <= far_z(); ++dz) hand_over<Sweep>(row + x, z, dz, x * ring_.columns);
  });
}

// `first`: where the sums of the pencil's own x stand in each row. Inlined: as a call it costs a fifth of a sweep.
template <class Sweep>
__attribute__((always_inline)) inline void LatticeSums::hand_over(int place, int z, int dz, int first) {
  const int away = dz * lattice_->shape()[0] * lattice_->shape()[1];
  const int below = lattice_->slot_at(place - away), over = lattice_->slot_at(place + away);
  const bool to_below = lattice_->is_owned(below), to_over = dz > 0 && lattice_->is_owned(over);
  if (!to_below && !to_over) return;
  Sweep sums;
  for (const RowOfSums& row : near_[dz]) {
    if (lattice_->slot_at(place + row.offset) != 0) sums.add(row.sums + first, row.y);
  }
  const double height = above_[dz][0].z;
  if (to_below) sums.hand(sums_.of(z - dz, below), height);
  if (to_over) sums.hand(sums_.of(z + dz, over), -height);
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

// Of the column of three pencils in a row, so many columns each.
template <int reach, int inputs>
Pairs<reach> pairs_of(const Pencil* here, int column) {
  return Pairs<reach>(here[column - inputs], here[column], here[column + inputs]);
}

}  // namespace

// ---- Moments -------------------------------------------------------------------------------------------------------

template <int reach, bool with_springs>
struct LatticeSums::MomentSweep {
  // V u; Σ ω V u, Σ ω dx V u; H with u_i taken out, and with springs q = Σ ω V u
  static constexpr int inputs = 3, columns = 6, outputs = with_springs ? 12 : 9;
  Pencil sum[3] = {}, along_x[3] = {}, along_y[3] = {};

  static void row_sums(const std::vector<Kind>& kinds, const Pencil* here, Pencil* to) {
    for (int c = 0; c < 3; ++c) {
      const auto u = pairs_of<reach, inputs>(here, c);
      for (std::size_t k = 0; k < kinds.size(); ++k) {
        to[k * columns + c] = u.sum(kinds[k]);
        to[k * columns + 3 + c] = u.first(kinds[k]);
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
      if constexpr (with_springs) to[9 + c] += sum[c];
    }
  }
};

void LatticeSums::moments(const Displacements& u, const Take& take) {
  const auto fill = [&](const Cells& cells, const Put& put) {
    const auto [ui, V] = u.of(cells.of(u.sites));
    for (int c = 0; c < 3; ++c) put(c, V * ui.c[c]);
  };
  with_constant(lattice_->reach(), [&](auto reach) {
    has_springs_ ? sweep<MomentSweep<reach, true>>(fill, take) : sweep<MomentSweep<reach, false>>(fill, take);
  });
}

// The stretch is S + q − W u_i over the family and the point itself, of a field without S.
LaneTensor LatticeSums::Chunk::moments(const Abreast& points, const Displacements& u,
                                       std::vector<Vector>* stretches) const {
  const Indices& i = points.i;
  const OfGroup group(*this, points);
  const LaneVector ui = u.of(records(u.sites, i)).u;
  const auto S = group.constants();
  LaneTensor H = group.tensor(0);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) H.c[r][c] -= ui.c[r] * S[c];
  }
  if (!stretches || !all->has_springs_) return H;
  LaneVector stretch = group.vector(9);
  for (int r = 0; r < 3; ++r) {
    stretch.c[r] -= S[3] * ui.c[r];
    if (!u.is_field) stretch.c[r] += S[r];
  }
  for (int l = 0; l < small::lane_count; ++l) (*stretches)[i[l]] = small::at(stretch, l);
  return H;
}

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

// Σ ω V |u_j − u_i|² − H : (F − I), H = (F − I) K being the moments; the first sum is Σ ω V |u_j|² − 2 u_i·q + W
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

// f_i = Σ ω V_j (A_j ξ + C_j (ξ + u_j)) + A_i S − u_i Σ ω V_j C_j, over the family and the point itself; of a field
// without C_j ξ.
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

LaneVector LatticeSums::Chunk::forces(const Abreast& points, const Displacements& u,
                                      const std::vector<ForceState>& states) const {
  const Indices& i = points.i;
  const OfGroup group(*this, points);
  const auto S = group.constants();
  LaneVector f = group.vector(0);
  if ((S[0] != 0 || S[1] != 0 || S[2] != 0).any()) {  // not in the interior
    const auto A = small::numbers_of<12>(records(states.data(), i));
    for (int r = 0; r < 3; ++r) f.c[r] += A[r] * S[0] + A[4 + r] * S[1] + A[8 + r] * S[2];
  }
  if (!all->has_springs_) return f;
  const LaneVector ui = u.of(records(u.sites, i)).u;
  const Lanes stiffness = group.column(3);
  for (int r = 0; r < 3; ++r) f.c[r] -= stiffness * ui.c[r];
  return f;
}

// ---- Residuals -----------------------------------------------------------------------------------------------------

void LatticeSums::residuals(const Displacements& u, const std::vector<ForceState>& gradients, const Take& take) {
  const auto fill = [&](const Cells& cells, const Put& put) {
    const auto [ui, V] = u.of(cells.of(u.sites));
    const auto F = small::numbers_of<12>(cells.of(gradients.data()));
    for (int axis = 0; axis < 3; ++axis) {
      for (int c = 0; c < 3; ++c) put(3 * axis + c, F[4 * axis + c] - (c == axis && !u.is_field ? 1 : 0));
      put(9 + axis, ui.c[axis]);
    }
    put(12, F[3]), put(13, V), put(14, F[7]);
  };
  const int planes = lattice_->shape()[2], far = far_z();
  for (const Strip& strip : strips(residual_inputs)) {
    for (int z = 0; z < planes; ++z) {
      sources_.open(*this, z, strip.y0 - far_y(), strip.y1 + far_y(), residual_inputs);
      for (int slot = sources_.begin(z); slot < sources_.end(z); ++slot) pack(slot, fill, sources_.of(z, slot));
      const int complete = z - far;
      if (complete < far) continue;
      sums_.open(*this, complete, strip.y0, strip.y1, residual_outputs);
      for (int slot = sums_.begin(complete); slot < sums_.end(complete); ++slot) {
        if (lattice_->is_owned(slot)) gather_residuals(slot, complete);
      }
      take_plane(complete, residual_outputs, take);
    }
  }
}

// The bonds of eight points with one row of their stencils.
struct LatticeSums::Residuals {
  const Pencil* own;           // columns of the points
  const Pencil* const* there;  // columns of the row: before, here and after
  const Pencil* fitted;        // u − ½ (H_y dy + H_z dz) of the row: before, here and after, three each
  const Pencil* base;          // u + ½ (H_y dy + H_z dz) of the points
  const Kind& kind;
  double spacing;                     // along x, m
  Pencil sum[3] = {}, first[3] = {};  // Σ t and Σ dx t, t = ω V_j C_ij z

  template <int dx>
  void add_bond() {
    const double x = dx * spacing;
    const auto far = [this](int column) { return shifted<dx>(there[0][column], there[1][column], there[2][column]); };
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

void LatticeSums::gather_residuals(int slot, int z) {
  const int place = lattice_->place(slot);
  const Pencil* own = sources_.of(z, slot);
  Pencil M[9] = {}, force[3] = {};
  for (const Row& row : rows_) {
    const int beside = place + row.offset, plane = z + row.dz;
    const Pencil* ends[] = {source_at(beside - 1, plane), source_at(beside, plane), source_at(beside + 1, plane)};
    Pencil fitted[9], base[3];
    for (int c = 0; c < 3; ++c) {
      for (int end = 0; end < 3; ++end) {
        fitted[3 * end + c] = ends[end][9 + c] - 0.5 * (row.y * ends[end][3 + c] + row.z * ends[end][6 + c]);
      }
      base[c] = own[9 + c] + 0.5 * (row.y * own[3 + c] + row.z * own[6 + c]);
    }
    Residuals bonds{own, ends, fitted, base, kinds_[row.kind], lattice_->frame().spacing[0]};
    bonds.add_bond<0>();
    bonds.add_bonds();
    for (int c = 0; c < 3; ++c) {
      force[c] += bonds.sum[c];
      M[c] += bonds.first[c];
      M[3 + c] += row.y * bonds.sum[c];
      M[6 + c] += row.z * bonds.sum[c];
    }
  }
  std::copy_n(M, 9, sums_.of(z, slot));
  std::copy_n(force, 3, sums_.of(z, slot) + 9);
}

}  // namespace strut

// Sums that each point gathers from its neighbors: few numbers per neighbor, many per result.
#include "mechanics/kernels/lattice_traversal.hpp"

namespace strut {

using namespace lattice;

// ---- Sweeps --------------------------------------------------------------------------------------------------------

template <class Fill, class Gather>
void LatticeSums::Traversal::gather_strip(const Strip& strip, int inputs, int outputs, const Fill& fill,
                                          const Gather& gather, const Take& take) {
  const int planes = lattice_->shape()[2], far = far_z();
  sources_.keep(2 * far + 1), sums_.keep(1);
  for (int z = 0; z < planes; ++z) {
    open(sources_, z, strip.y0 - far_y(), strip.y1 + far_y(), inputs);
    for (int slot = sources_.begin(z); slot < sources_.end(z); ++slot) all_.pack(slot, fill, sources_.of(z, slot));
    const int complete = z - far;
    if (complete < far) continue;
    open(sums_, complete, strip.y0, strip.y1, outputs);
    gather(complete);
    take_plane(complete, outputs, take);
  }
}

// gather(traversal, z, strip)
template <class Fill, class Gather>
void LatticeSums::gather_planes(int inputs, int outputs, const Fill& fill, const Gather& gather, const Take& take) {
  over_strips((2 * far_z() + 1) * inputs + outputs, [&](Traversal& traversal, const Strip& strip) {
    traversal.gather_strip(
        strip, inputs, outputs, fill, [&](int z) { gather(traversal, z, strip); }, take);
  });
}

// Calls gather(traversal, slot, z) for each pencil.
template <class Fill, class Gather>
void LatticeSums::gather_pencils(int inputs, int outputs, const Fill& fill, const Gather& gather, const Take& take) {
  const auto plane = [&gather](Traversal& traversal, int z, const Strip&) {
    traversal.for_each_slot(z, [&](int slot) { gather(traversal, slot, z); });
  };
  gather_planes(inputs, outputs, fill, plane, take);
}

// ---- Shapes and constants ------------------------------------------------------------------------------------------

namespace {

constexpr int shape_outputs = 13;  // K by columns, S and W

}  // namespace

// Sums over one row of the stencils of eight points: Σ ω V, Σ ω dx V and Σ ω dx² V.
struct LatticeSums::Traversal::Shapes {
  const std::array<const Pencil*, 3>& there;  // V of the row: the pencils before, at and after
  const Kind& kind;
  double spacing;  // along x, m
  Pencil sum = kind.weight[0] * *there[1], first = {}, second = {};

  template <int dx = 1>
  void add() {
    if constexpr (dx <= pencil_width) {
      if (dx > kind.reach) return;
      const Pencil right = shifted<dx>(*there[0], *there[1], *there[2]),
                   left = shifted<-dx>(*there[0], *there[1], *there[2]);
      sum += kind.weight[dx] * (right + left);
      first += kind.first[dx] * (right - left);
      second += (kind.first[dx] * dx * spacing) * (right + left);
      add<dx + 1>();
    }
  }
};

void LatticeSums::Traversal::gather_shape(int slot, int z) {
  const int index = lattice_->index(slot);
  Pencil K[9] = {}, S[3] = {}, W = {};
  for (const Row& row : all_.rows_) {
    const int beside = index + row.offset, plane = z + row.dz;
    const std::array<const Pencil*, 3> there{source_at(beside - 1, plane), source_at(beside, plane),
                                             source_at(beside + 1, plane)};
    Shapes sums{there, all_.kinds_[row.kind], lattice_->frame().spacing[0]};
    sums.add();
    K[0] += sums.second, K[4] += (row.y * row.y) * sums.sum, K[8] += (row.z * row.z) * sums.sum;
    K[1] += row.y * sums.first, K[2] += row.z * sums.first, K[5] += (row.y * row.z) * sums.sum;
    S[0] += sums.first, S[1] += row.y * sums.sum, S[2] += row.z * sums.sum;
    W += sums.sum;
  }
  K[3] = K[1], K[6] = K[2], K[7] = K[5];
  Pencil* const to = sums_.of(z, slot);
  std::copy_n(K, 9, to), std::copy_n(S, 3, to + 9), to[12] = W;
}

LaneTensor LatticeSums::Chunk::shapes(const LaneIndices& points) const { return OfGroup(*this, points).tensor(0); }

// Sets the constants together with the shapes.
void LatticeSums::gather_shapes(const Body& body, const Take& take) {
  std::vector<Constants> constants(body.owned(), Constants::Zero());
  const double length = lattice_->frame().horizon;
  const auto set = [&](int i, const double* sums) {
    const auto constant = [sums](int c) { return sums[(9 + c) * pencil_width]; };
    const double W = constant(3);
    // Rounded above the round-off of their sums, so that identical families have identical constants.
    for (int c = 0; c < 4; ++c) constants[i][c] = rounded(constant(c), c < 3 ? W * length : W, 48);
  };
  const Displacements places{body.domain.sites.data()};
  const auto volume = [&](const Cells& cells, const Put& put) { put(0, places.of(cells.of(places.sites)).volume); };
  const auto shape = [](Traversal& traversal, int slot, int z) { traversal.gather_shape(slot, z); };
  gather_pencils(1, shape_outputs, volume, shape, [&](const Chunk& chunk) {
    for (int cell = pencil_width * chunk.begin; cell < pencil_width * chunk.end; ++cell) {
      const int i = lattice_->point(cell / pencil_width, cell % pencil_width);
      if (i >= 0 && i < body.owned()) set(i, chunk.at(i));
    }
    take(chunk);
  });
  constants_ = Deduplicated<Constants>(std::move(constants));
}

// ---- Moments -------------------------------------------------------------------------------------------------------

namespace {

// Numbers gathered: V u of a point; Σ ω V u and Σ ω dz V u of a column of cells along z; of the columns at one |dx|,
// the sums of both and of dy times the first.
constexpr int moment_inputs = 3, of_a_column = 6, of_columns = 9;

// The sums of eight points over the columns at dx = 0, ±1, … from them.
template <bool with_springs>
struct MomentsOfPencil {
  static constexpr int outputs = with_springs ? 12 : 9;  // H without the u_i term, and with springs q = Σ ω V u
  Pencil H[9] = {}, q[3] = {};

  // `at`: the sums over columns of the pencils before, at and after.
  MomentsOfPencil(const std::array<const Pencil*, 3>& at, int reach, double spacing) {
    for (int c = 0; c < 3; ++c) q[c] = at[1][c], H[6 + c] = at[1][3 + c], H[3 + c] = at[1][6 + c];
    add(at, reach, spacing, std::integral_constant<int, 1>{});
  }
  void store(Pencil* to) const {
    for (int c = 0; c < 9; ++c) to[c] = H[c];
    if constexpr (with_springs) to[9] = q[0], to[10] = q[1], to[11] = q[2];
  }

 private:
  template <int dx>
  void add(const std::array<const Pencil*, 3>& at, int reach, double spacing, std::integral_constant<int, dx>) {
    if (dx > reach) return;
    const auto right = [&](int c) { return shifted<dx>(at[0][c], at[1][c], at[2][c]); };
    const auto left = [&](int c) { return shifted<-dx>(at[0][c], at[1][c], at[2][c]); };
    for (int c = 0; c < 3; ++c) {
      const int sum = of_columns * dx + c, along_z = sum + 3, along_y = sum + 6;
      H[c] += (dx * spacing) * (right(sum) - left(sum));
      H[3 + c] += right(along_y) + left(along_y);
      H[6 + c] += right(along_z) + left(along_z);
      if constexpr (with_springs) q[c] += right(sum) + left(sum);
    }
    if constexpr (dx < pencil_width) add(at, reach, spacing, std::integral_constant<int, dx + 1>{});
  }
};

}  // namespace

// Sums along z, of the columns at each x of a row: once for each kind of column.
template <int reach>
void LatticeSums::Traversal::sum_columns(int z, int y) {
  const int places = lattice_->shape()[0], plane = places * lattice_->shape()[1];
  std::uint64_t* const columns = column_bits(y);
  all_.set_bits_near(all_.filled_, z, y, columns);
  const int row = z * plane + y * places;
  for_each_bit(columns, all_.words_, [&](int x) {
    const Pencil* here = source_at(row + x, z);
    const Pencil *above[reach + 1], *below[reach + 1];
    for (int dz = 1; dz <= reach; ++dz) {
      above[dz] = source_at(row + x + dz * plane, z + dz);
      below[dz] = source_at(row + x - dz * plane, z - dz);
    }
    Pencil* const to = ring_.row(y, places) + static_cast<std::size_t>(x) * ring_.columns;
    for (int c = 0; c < 3; ++c) {
      Pairs<reach> u{.here = here[c]};
      for (int dz = 1; dz <= reach; ++dz) {
        u.plus[dz] = above[dz][c] + below[dz][c];
        u.minus[dz] = above[dz][c] - below[dz][c];
      }
      for (std::size_t k = 0; k < all_.column_kinds_.size(); ++k) {
        to[k * of_a_column + c] = u.sum(all_.column_kinds_[k]);
        to[k * of_a_column + 3 + c] = u.first(all_.column_kinds_[k]);
      }
    }
  });
}

// Sums along y, at one x of the present row: for each |dx| over the columns of a stencil there.
void LatticeSums::Traversal::sum_across(int x, Pencil* to) const {
  for (const std::vector<ColumnOfSums>& columns : columns_near_) {
    Pencil sum[3] = {}, along_z[3] = {}, along_y[3] = {};
    for (const ColumnOfSums& column : columns) {
      if ((column.filled[x / 64] >> x % 64 & 1) == 0) continue;
      const Pencil* of = column.sums + static_cast<std::size_t>(x) * ring_.columns;
      for (int c = 0; c < 3; ++c) {
        sum[c] += of[c];
        along_z[c] += of[3 + c];
        along_y[c] += column.y * of[c];
      }
    }
    for (int c = 0; c < 3; ++c) to[c] = sum[c], to[3 + c] = along_z[c], to[6 + c] = along_y[c];
    to += of_columns;
  }
}

// Sums along x, of the pencils in a row.
template <bool with_springs>
void LatticeSums::Traversal::gather_row(int z, int y) {
  const int places = lattice_->shape()[0], row = (z * lattice_->shape()[1] + y) * places;
  for (std::size_t dx = 0; dx < all_.columns_.size(); ++dx) {
    columns_near_[dx].clear();
    for (const Column& column : all_.columns_[dx]) {
      const int beside = y + column.dy;
      columns_near_[dx].push_back(
          {ring_.row(beside, places) + of_a_column * column.kind, column_bits(beside), column.y});
    }
  }
  const auto across = [&](int x) { return &across_[(x % 4) * of_columns * columns_near_.size()]; };
  int next = 0;  // next x to be summed along y
  for_each_bit(all_.row_of(all_.owned_, z, y), all_.words_, [&](int x) {
    for (next = std::max(next, x - 1); next <= x + 1; ++next) sum_across(next, across(next));
    const std::array<const Pencil*, 3> at{across(x - 1), across(x), across(x + 1)};
    const MomentsOfPencil<with_springs> sums(at, lattice_->reach(), lattice_->frame().spacing[0]);
    sums.store(sums_.of(z, lattice_->slot_at(row + x)));
  });
}

template <int reach, bool with_springs>
void LatticeSums::Traversal::gather_moments(int z, const Strip& strip) {
  ring_.open(lattice_->rows_across(), static_cast<int>(all_.column_kinds_.size()) * of_a_column, lattice_->shape()[0]);
  column_bits_.resize(static_cast<std::size_t>(ring_.rows) * all_.words_);
  across_.resize(4 * of_columns * columns_near_.size());
  int next = strip.y0 - far_y();  // next row whose columns are to be summed
  for (int y = strip.y0; y < strip.y1; ++y) {
    const std::uint64_t* owned = all_.row_of(all_.owned_, z, y);
    if (std::all_of(owned, owned + all_.words_, [](std::uint64_t word) { return word == 0; })) continue;
    for (next = std::max(next, y - far_y()); next <= y + far_y(); ++next) sum_columns<reach>(z, next);
    gather_row<with_springs>(z, y);
  }
}

// `fill`: gives V u of the points.
template <bool with_springs, class Fill>
void LatticeSums::gather_moments(const Fill& fill, const Take& take) {
  with_constant(far_z(), [&](auto far) {
    constexpr int reach = far;
    const auto gather = [](Traversal& traversal, int z, const Strip& strip) {
      traversal.gather_moments<reach, with_springs>(z, strip);
    };
    gather_planes(moment_inputs, MomentsOfPencil<with_springs>::outputs, fill, gather, take);
  });
}

void LatticeSums::moments(const Displacements& u, const Take& take) {
  const auto fill = [&](const Cells& cells, const Put& put) {
    const auto [ui, V] = u.of(cells.of(u.sites));
    for (int c = 0; c < 3; ++c) put(c, V * ui.c[c]);
  };
  has_springs_ ? gather_moments<true>(fill, take) : gather_moments<false>(fill, take);
}

// The pull is S + q − W u_i over the family and the point itself; for a field, without S.
bonds::Moments<Lanes> LatticeSums::Chunk::moments(const LaneIndices& points, const Displacements& u) const {
  const OfGroup group(*this, points);
  const LaneVector ui = u.of(records(u.sites, points.i)).u;
  const auto S = group.constants();
  bonds::Moments<Lanes> sums{group.tensor(0)};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) sums.tensor.c[r][c] -= ui.c[r] * S[c];
  }
  if (!all->has_springs_) return sums;
  sums.pull = group.vector(9);
  for (int r = 0; r < 3; ++r) {
    sums.pull.c[r] -= S[3] * ui.c[r];
    if (!u.is_field) sums.pull.c[r] += S[r];
  }
  return sums;
}

// ---- Residuals -----------------------------------------------------------------------------------------------------

namespace {

constexpr int residual_outputs = 12;  // M and a force

}  // namespace

template <class S>
void LatticeSums::gather_residuals_of(std::size_t kind, const Displacements& u,
                                      const std::vector<GradientState>& gradients, const Take& take) {
  const auto fill = [&](const Cells& cells, const Put& put) {
    const auto [ui, V] = u.of(cells.of(u.sites));
    const auto F = small::numbers_of<12>(cells.of(gradients.data()));
    for (int axis = 0; axis < 3; ++axis) {
      for (int c = 0; c < 3; ++c) put(3 * axis + c, F[4 * axis + c] - (c == axis && !u.is_field ? 1 : 0));
      put(9 + axis, ui.c[axis]);
    }
    put(12, bonds::stiffness_of(kind, F[3], F[11])), put(13, V), put(14, F[7]);
  };
  const auto gather = [](Traversal& traversal, int slot, int z) { traversal.gather_residuals<S>(slot, z); };
  gather_pencils(residual_inputs, residual_outputs, fill, gather, take);
}

// The bonds of eight points to one row of their stencils.
template <class S>
struct LatticeSums::Traversal::Residuals {
  const Pencil* own;           // numbers of the points, by column
  const Pencil* const* there;  // numbers of the row: the pencils before, at and after
  const Pencil* fitted;        // u − ½ (H_y dy + H_z dz) of the row: before, at and after, three each
  const Pencil* base;          // u + ½ (H_y dy + H_z dz) of the points
  const Kind& kind;
  double spacing;                     // along x, m
  double y, z;                        // of the row, m
  Pencil sum[3] = {}, first[3] = {};  // Σ t and Σ dx t

  template <int dx>
  void add_bond() {
    const double x = dx * spacing;
    const auto far = [this](int column) { return shifted<dx>(there[0][column], there[1][column], there[2][column]); };
    const Pencil C = far(12), factor = far(14);
    const Pencil stiffness = (own[12] < C ? own[12] : C) * (own[14] < factor ? factor : own[14]);
    const Pencil weight = (2 * kind.weight[dx < 0 ? -dx : dx]) * far(13) * stiffness;
    small::Vector3<Pencil> residual;
    for (int c = 0; c < 3; ++c) {
      const Pencil u = shifted<dx>(fitted[c], fitted[3 + c], fitted[6 + c]);
      residual.c[c] = u - base[c] - (0.5 * x) * (own[c] + far(c));
    }
    const small::Vector3<Pencil> t = S::bond_force(weight, residual, small::Vector3<double>{{x, y, z}});
    for (int c = 0; c < 3; ++c) {
      sum[c] += t.c[c];
      first[c] += x * t.c[c];
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

template <class S>
void LatticeSums::Traversal::gather_residuals(int slot, int z) {
  const int index = lattice_->index(slot);
  const Pencil* own = sources_.of(z, slot);
  Pencil M[9] = {}, force[3] = {};
  for (const Row& row : all_.rows_) {
    const int beside = index + row.offset, plane = z + row.dz;
    const Pencil* ends[] = {source_at(beside - 1, plane), source_at(beside, plane), source_at(beside + 1, plane)};
    Pencil fitted[9], base[3];
    for (int c = 0; c < 3; ++c) {
      for (int end = 0; end < 3; ++end) {
        fitted[3 * end + c] = ends[end][9 + c] - 0.5 * (row.y * ends[end][3 + c] + row.z * ends[end][6 + c]);
      }
      base[c] = own[9 + c] + 0.5 * (row.y * own[3 + c] + row.z * own[6 + c]);
    }
    Residuals<S> bonds{own, ends, fitted, base, all_.kinds_[row.kind], lattice_->frame().spacing[0], row.y, row.z};
    bonds.template add_bond<0>();
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

void LatticeSums::residuals(std::size_t kind, const Displacements& u, const std::vector<GradientState>& gradients,
                            const Take& take) {
  for_each_bond_stabilization([&]<class S>(const S&, std::size_t place) {
    if (place == kind) gather_residuals_of<S>(kind, u, gradients, take);
  });
}

LaneVector LatticeSums::Chunk::residual_forces(const LaneIndices& points) const {
  return OfGroup(*this, points).vector(9);
}
LaneTensor LatticeSums::Chunk::residual_moments(const LaneIndices& points) const {
  return OfGroup(*this, points).tensor(0);
}

}  // namespace strut
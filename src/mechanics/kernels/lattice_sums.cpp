#include "mechanics/kernels/lattice_sums.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace strut {

LatticeSums::LatticeSums(const Body& body, const LatticeFamilies& lattice, const Take& take) : lattice_(&lattice) {
  make_rows(body.influence);
  if (far_y() == 0 || far_z() == 0) throw std::logic_error("a stencil spans space");
  make_columns(body.influence);
  mark_places();
  has_springs_ = body.has_springs(ResidualKind::own_gradient);
  gather_shapes(body, take);
}

// Index of a kind in `kinds`, to which it is added if it is new.
int LatticeSums::place_in(std::vector<Kind>& kinds, const Kind& kind) {
  const auto known = std::find(kinds.begin(), kinds.end(), kind);
  const auto place = static_cast<int>(known - kinds.begin());
  if (known == kinds.end()) kinds.push_back(kind);
  return place;
}

// The weights along a line of cells that are `spacing` (m) apart; `aside`: offset of the line, m.
template <class Weight>
LatticeSums::Kind LatticeSums::kind_of(int reach, double spacing, const Eigen::Array2d& aside, Weight weight) const {
  Kind kind{.reach = reach};
  for (int d = 0; d <= reach; ++d) {
    const double offset = d * spacing, length = std::sqrt(offset * offset + aside.square().sum());
    kind.weight[d] = weight.of(length / lattice_->frame().horizon);
    kind.first[d] = kind.weight[d] * offset;
  }
  return kind;
}

void LatticeSums::make_rows(Influence influence) {
  const Vector& h = lattice_->frame().spacing;
  bonds::with_influence(influence, [&](auto weight) {
    for (const LatticeFamilies::Row& row : lattice_->rows()) {
      const double y = row.y * h[1], z = row.z * h[2];
      const int kind = place_in(kinds_, kind_of(row.reach, h[0], {y, z}, weight));
      rows_.push_back({y, z, row.y, row.z, row.offset, kind});
      if (row.z < 0) continue;
      above_.resize(row.z + 1);
      above_[row.z].push_back(rows_.back());
    }
  });
}

// A column reaches as far as the rows that it crosses.
void LatticeSums::make_columns(Influence influence) {
  const Vector& h = lattice_->frame().spacing;
  columns_.resize(lattice_->reach() + 1);
  bonds::with_influence(influence, [&](auto weight) {
    for (int dx = 0; dx <= lattice_->reach(); ++dx) {
      for (int dy = -far_y(); dy <= far_y(); ++dy) {
        int reach = -1;
        for (const Row& row : rows_) {
          if (row.dy == dy && kinds_[row.kind].reach >= dx) reach = std::max(reach, row.dz);
        }
        if (reach < 0) continue;
        const double y = dy * h[1];
        columns_[dx].push_back({y, dy, place_in(column_kinds_, kind_of(reach, h[2], {dx * h[0], y}, weight))});
      }
    }
  });
}

void LatticeSums::mark_places() {
  const Eigen::Array3i& shape = lattice_->shape();
  words_ = (shape[0] + 63) / 64;
  filled_.assign(static_cast<std::size_t>(shape[1]) * shape[2] * words_, 0);
  owned_ = filled_;
  row_begins_.assign(static_cast<std::size_t>(shape[1]) * shape[2] + 1, 0);
  slots_at_.assign(shape[1], 0);
  for (int slot = 1; slot < lattice_->slots(); ++slot) {
    const int row = lattice_->index(slot) / shape[0], x = lattice_->index(slot) % shape[0];
    const std::size_t word = static_cast<std::size_t>(row) * words_ + x / 64;
    const std::uint64_t bit = std::uint64_t{1} << x % 64;
    filled_[word] |= bit;
    if (lattice_->is_owned(slot)) owned_[word] |= bit;
    row_begins_[row + 1] = slot + 1;
    ++slots_at_[row % shape[1]];
  }
  row_begins_[0] = 1;
  for (std::size_t row = 1; row < row_begins_.size(); ++row) {
    rows_with_slots_ += row_begins_[row] > 0;
    row_begins_[row] = std::max(row_begins_[row], row_begins_[row - 1]);
  }
}

// Sets the bits of a row that are set in any plane that a stencil reaches from plane z.
void LatticeSums::set_bits_near(const std::vector<std::uint64_t>& bits, int z, int y, std::uint64_t* row) const {
  std::fill_n(row, words_, 0);
  for (int dz = -far_z(); dz <= far_z(); ++dz) {
    const std::uint64_t* there = row_of(bits, z + dz, y);
    for (int w = 0; w < words_; ++w) row[w] |= there[w];
  }
}

std::pair<int, int> LatticeSums::Chunk::part_of(const std::vector<int>& points, int low, int high) const {
  const auto place_of = [&](int slot) {
    const auto is_before = [this](int i, int cell) { return all->lattice_->cell(i) < cell; };
    const auto at = std::lower_bound(points.begin() + low, points.begin() + high, pencil_width * slot, is_before);
    return static_cast<int>(at - points.begin());
  };
  return {place_of(begin), place_of(end)};
}

}  // namespace strut

#include "integrators/quasi_static/separate_parts.hpp"

#include <cmath>
#include <numeric>
#include <utility>

#include "topology/pieces.hpp"

namespace strut {

SeparateParts::SeparateParts(const Domain& domain) : sets_(0) {
  auto [of_points, count] = numbered_pieces(domain);
  of_points_ = std::move(of_points);
  parts_.resize(count > 1 ? count + 1 : 1);
  points_.assign(parts_.size(), 0);
  for (const int piece : of_points_) ++points_[piece];
  domain.communicator.sum(points_);
  separate();
}

void SeparateParts::separate() {
  sets_ = UnionFind(parts_.size());
  std::iota(parts_.begin(), parts_.end(), 0);
}

// Ranks join what they see, and then take over the least number that any rank has for each piece, until they agree.
void SeparateParts::join(const contact::Contact& contact, const Communicator& ranks) {
  bool changed = false;
  const auto join = [&](int a, int b) {
    changed = changed || sets_.first(a) != sets_.first(b);
    sets_.join(a, b);
  };
  contact.for_each_near(of_points_, [&](int a, int b, bool through_side) {
    join(a, b);
    if (through_side) join(a, contact_through_sides());
  });
  while (ranks.any(std::exchange(changed, false))) {
    std::vector<double> least(parts_.size());
    for (int p = 0; p < pieces(); ++p) least[p] = -sets_.first(p);
    ranks.max(least);
    for (int p = 0; p < pieces(); ++p) join(p, static_cast<int>(-least[p]));
  }
  for (int p = 0; p < pieces(); ++p) parts_[p] = sets_.first(p);
}

std::vector<double> SeparateParts::norms(std::span<const Vector> field, const Communicator& ranks) const {
  std::vector<double> all(parts_.size(), 0);
  for (std::size_t i = 0; i < field.size(); ++i) all[of_points_[i]] += field[i].squaredNorm();
  ranks.sum(all);
  for (double& one : all) one = std::sqrt(one);
  return all;
}

std::vector<double> SeparateParts::of_parts(const std::vector<double>& of_pieces) const {
  std::vector<double> all(parts_.size(), 0);
  for (std::size_t p = 0; p < all.size(); ++p) all[parts_[p]] = std::hypot(all[parts_[p]], of_pieces[p]);
  return all;
}

}  // namespace strut

#include "integrators/quasi_static/separate_parts.hpp"

#include <cmath>

#include "base/union_find.hpp"

namespace strut {

namespace {

// Forces through periodic sides are known for all bodies together only.
bool are_connected(int a, int b, const Domain& domain, const contact::Contact& contact) {
  return !domain.periods.empty() || domain.blocks[a].body == domain.blocks[b].body || contact.between(a, b);
}

}  // namespace

SeparateParts::SeparateParts(const Domain& domain, const contact::Contact& contact) {
  const int blocks = static_cast<int>(domain.blocks.size());
  UnionFind sets(blocks);
  for (int b = 1; b < blocks; ++b) {
    for (int a = 0; a < b; ++a) {
      if (are_connected(a, b, domain, contact)) sets.join(a, b);
    }
  }
  std::vector<int> parts(blocks);
  for (int b = 0; b < blocks; ++b) parts[b] = sets.first(b) == b ? count_++ : parts[sets.first(b)];
  of_points_.resize(domain.owned);
  for (int i = 0; i < domain.owned; ++i) of_points_[i] = parts[domain.cloud.blocks[i]];
}

std::vector<double> SeparateParts::norms(std::span<const Vector> field, const Communicator& ranks) const {
  std::vector<double> all(count_, 0);
  for (std::size_t i = 0; i < field.size(); ++i) all[of_points_[i]] += field[i].squaredNorm();
  ranks.sum(all);
  for (double& one : all) one = std::sqrt(one);
  return all;
}

}  // namespace strut

// Union-find: the sets of items that result when pairs of them are joined.
#pragma once

#include <numeric>
#include <utility>
#include <vector>

namespace strut {

class UnionFind {
 public:
  explicit UnionFind(std::size_t items) : parent_(items) { std::iota(parent_.begin(), parent_.end(), 0); }

  // The first item of the set of this one.
  int first(int item) {
    while (parent_[item] != item) item = parent_[item] = parent_[parent_[item]];
    return item;
  }

  void join(int a, int b) {
    a = first(a);
    b = first(b);
    if (a > b) std::swap(a, b);
    parent_[b] = a;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace strut

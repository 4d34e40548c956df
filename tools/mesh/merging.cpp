#include "mesh/merging.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <utility>

namespace strut::mesh {

namespace {

using Triple = Eigen::Array3i;

// The length of a bar with these moments, in spacings.
double length_of(const io::PartialCell& part, const Vector& spacing) {
  const auto scale = spacing.cwiseInverse().asDiagonal();
  const Tensor moments = scale * to_tensor(part.moments) * scale;
  return std::sqrt(12 * Eigen::SelfAdjointEigenSolver<Tensor>(moments, Eigen::EigenvaluesOnly).eigenvalues()[2]);
}

}  // namespace

Merging::Merging(Pieces& pieces, std::vector<std::set<int>> links, const VoxelGrid& grid)
    : pieces_(pieces),
      list_(pieces.list),
      links_(std::move(links)),
      grid_(grid),
      alive_(list_.size(), true),
      into_(list_.size(), -1) {}

void Merging::finish() {
  for (int& piece : pieces_.of) {
    while (piece >= 0 && into_[piece] >= 0) piece = into_[piece];
    if (piece >= 0 && !alive_[piece]) piece = -1;
  }
}

// True if a piece at `place` would touch all pieces that `piece` has contacts with, except `other`.
bool Merging::reaches(int place, int piece, int other) const {
  const Triple at = grid_.cell(place);
  return std::all_of(links_[piece].begin(), links_[piece].end(), [&](int linked) {
    return linked == other || ((grid_.cell(list_[linked].place) - at).abs() <= 1).all();
  });
}

Merging::Choice Merging::most_compact(int piece, double longest, const Allowed& allowed, bool is_at_piece) const {
  Choice best;
  double least = 0;
  for (const int other : links_[piece]) {
    const int place = list_[is_at_piece ? piece : other].place;
    if (!allowed(other) || !reaches(place, piece, other) || !reaches(place, other, piece)) continue;
    io::PartialCell both = list_[other].part;
    absorb(both, list_[piece].part);
    const double extent = both.moments.head<3>().sum();
    if (best.into >= 0 && extent >= least) continue;
    if (std::isfinite(longest) && length_of(both, grid_.spacing()) > longest) continue;
    best = {other, place};
    least = extent;
  }
  return best;
}

int Merging::merge(int piece, double longest, const Allowed& allowed) {
  Choice choice = most_compact(piece, longest, allowed, false);
  if (choice.into < 0) choice = most_compact(piece, longest, allowed, true);
  if (choice.into >= 0) join(piece, choice);
  return choice.into;
}

void Merging::join(int piece, const Choice& choice) {
  const int into = choice.into;
  absorb(list_[into].part, list_[piece].part);
  list_[into].filled += list_[piece].filled;
  list_[into].place = choice.place;
  for (const int other : links_[piece]) {
    links_[other].erase(piece);
    if (other == into) continue;
    links_[other].insert(into);
    links_[into].insert(other);
  }
  links_[piece].clear();
  alive_[piece] = false;
  into_[piece] = into;
}

}  // namespace strut::mesh

// The parts of a scene that neither bonds nor contact connect. Each is in equilibrium by its own forces: those of a
// part that bears much are no measure for another one. A part is one piece that bonds connect, or several that contact
// joins while they are so near that it may act; these have the number of their first piece.
#pragma once

#include <span>
#include <vector>

#include "base/union_find.hpp"
#include "contact/contact.hpp"
#include "topology/domain.hpp"

namespace strut {

class SeparateParts {
 public:
  // Collective. Each piece is a part.
  explicit SeparateParts(const Domain& domain);

  // Numbers of pieces are the same on all ranks, and on any number of them. The last of several has no points: it
  // stands for contact through periodic sides, and is a part with all pieces that have it.
  int pieces() const { return static_cast<int>(parts_.size()); }
  bool several() const { return pieces() > 1; }
  int contact_through_sides() const { return pieces() - 1; }
  int piece_of(int i) const { return of_points_[i]; }           // of an owned point
  int part_of_piece(int piece) const { return parts_[piece]; }  // and of a point:
  int of(int i) const { return parts_[of_points_[i]]; }
  double points(int piece) const { return points_[piece]; }  // number of its points

  void separate();  // each piece is a part again
  // Collective, after the forces of contact. Joins parts that may touch where they are.
  void join(const contact::Contact& contact, const Communicator& ranks);

  // Collective. For each piece, the root of the sum of squares of a field of the owned points.
  std::vector<double> norms(std::span<const Vector> field, const Communicator& ranks) const;
  // For each part, the root of the sum of squares of numbers of its pieces.
  std::vector<double> of_parts(const std::vector<double>& of_pieces) const;

 private:
  std::vector<int> of_points_, parts_;  // pieces of the owned points; parts of the pieces
  std::vector<double> points_;
  UnionFind sets_;  // of pieces
};

}  // namespace strut

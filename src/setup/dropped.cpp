#include "setup/dropped.hpp"

#include <algorithm>
#include <iomanip>
#include <map>
#include <span>

#include "base/errors.hpp"
#include "base/parallel/gather_scatter.hpp"
#include "base/text.hpp"
#include "topology/pieces.hpp"

namespace strut {

namespace {

constexpr double most_lost = 0.01;  // of all points

// Number of points that are in the piece `now` and were in the piece `before`.
struct PiecePart {
  std::int64_t before, now, points;
};

std::vector<PiecePart> parts_of_this_rank(const Domain& left, const PiecesOfPoints& before) {
  const std::vector<std::int64_t> now = piece_ids(left);
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> counts;
  for (int i = 0; i < left.owned; ++i) {
    const auto was = std::lower_bound(before.begin(), before.end(), std::pair(left.id(i), std::int64_t{-1}));
    ++counts[{was->second, now[i]}];
  }
  std::vector<PiecePart> parts;
  for (const auto& [key, points] : counts) parts.push_back({key.first, key.second, points});
  return parts;
}

std::string lost(const Dropped& dropped) {
  const std::string few = text_of(dropped.points, " points with too few neighbors");
  if (dropped.parts == 0) return few;
  return text_of(few, "; without them ", dropped.points_cut_off, " more, in ", dropped.parts, " piece",
                 dropped.parts == 1 ? "" : "s", ", are cut off");
}

}  // namespace

PiecesOfPoints pieces_of_points(const Domain& domain) {
  const std::vector<std::int64_t> pieces = piece_ids(domain);
  PiecesOfPoints all;
  for (int i = 0; i < domain.owned; ++i) all.emplace_back(domain.id(i), pieces[i]);
  std::sort(all.begin(), all.end());
  return all;
}

// The pieces are counted on rank 0.
void take_pieces(const Domain& left, const PiecesOfPoints& before, Dropped& dropped) {
  const std::vector<PiecePart> mine = parts_of_this_rank(left, before);
  std::map<std::int64_t, std::map<std::int64_t, std::int64_t>> pieces;
  for (const PiecePart& part : gather(left.communicator, std::span(mine))) pieces[part.before][part.now] += part.points;
  Dropped cut;
  for (const auto& [piece, parts] : pieces) {
    std::int64_t all = 0, largest = 0;
    for (const auto& [now, points] : parts) all += points, largest = std::max(largest, points);
    cut.parts += std::ssize(parts) - 1, cut.points_cut_off += all - largest;
  }
  dropped.parts = left.communicator.sum(cut.parts);
  dropped.points_cut_off = left.communicator.sum(cut.points_cut_off);
}

void check_dropped(const Domain& left, const Dropped& dropped) {
  const std::int64_t points = left.communicator.sum(static_cast<std::int64_t>(left.owned)) + dropped.points;
  const double part = static_cast<double>(dropped.points + dropped.points_cut_off) / static_cast<double>(points);
  if (!(part > most_lost)) return;
  raise_together(left.communicator,
                 text_of(std::setprecision(3), "Discretization > Degenerate Points: \"Drop\" would leave out ",
                         lost(dropped), ": ", 100 * part, " % of ", points,
                         " points; expected 1 % at most. Enlarge the horizon, mend the mesh, or say \"Drop Any\" ",
                         "to go on with what is left"));
}

std::string describe_dropped(const Dropped& dropped) {
  return dropped.points == 0 ? "" : "dropped " + lost(dropped) + " (Degenerate Points)\n";
}

}  // namespace strut

#include "contact/own_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "contact/laws/surface.hpp"
#include "topology/bounding_box.hpp"
#include "topology/cloud.hpp"
#include "topology/mirror.hpp"
#include "topology/nearby_ranks.hpp"
#include "topology/neighbors/cell_grid.hpp"

namespace strut::contact {

namespace {

// |Σ V ξ| over the family, divided by its volume and the horizon: about 0 inside a body.
double one_sidedness(const Domain& domain, int i) {
  Vector sum = Vector::Zero();
  double volume = 0;
  domain.families.for_each(i, [&](int j) {
    sum += domain.volume(j) * (domain.reference(j) - domain.reference(i));
    volume += domain.volume(j);
  });
  return volume > 0 ? sum.norm() / (volume * domain.horizon(i)) : 1;
}

}  // namespace

bool is_at_surface(const Domain& domain, int i) {
  constexpr double least_one_sided = 0.15, least_full = 0.85;
  const double full = 4 * std::numbers::pi / 3 * std::pow(domain.horizon(i), 3);
  return one_sidedness(domain, i) > least_one_sided || family_volume(domain, i) < least_full * full;
}

namespace {

// Lengths are in spacings of the point's own body.
constexpr double least_area = 0.1;     // of a cell: below it the surface has no direction
constexpr double smooth = 0.2;         // largest spread of a cell's surface along its normals for a plane
constexpr double rim = 0.55;           // spread from which a cell contains an edge of the body
constexpr double around = 1.6;         // radius in which surface pieces give the curvature
constexpr double alike = 0.1;          // least cosine between the normals of these pieces
constexpr double sharpest = 0.5;       // largest mean curvature, that of a strut of two cells
constexpr double planes_within = 1.8;  // radius in which a point uses surface planes
constexpr double deepest = 0.8;        // largest depth of a point without surface of its own that still touches

// In spacings: distance of the other body's points in front of the surface when they touch; radius in
// which a piece of surface corrects volumes.
constexpr double before = 0.4, tells = 2;
constexpr double least_missing = 0.7, most_missing = 4;  // beyond them the body goes on in front, or behind a plane

// The surface of a cell as a plane, in the form in which it is sent to other ranks.
struct Piece {
  double place[3], normal[3];
  double area;           // m²
  double spread;         // of its positions along its normals, m: 0 for a plane
  double curvature = 0;  // mean curvature, 1/m
  double missing = 1;    // ρ before a flat face divided by ρ before the piece; 0: no free surface
  double spacing;        // m
  std::int64_t body, id;

  Vector at() const { return {place[0], place[1], place[2]}; }
  Vector out() const { return {normal[0], normal[1], normal[2]}; }
  bool is_smooth() const { return spread < smooth * spacing && missing > 0; }
};

// A point with its contribution to ρ.
struct Grain {
  double place[3], volume;
  std::int64_t body, id;

  Vector at() const { return {place[0], place[1], place[2]}; }
};

// Records of all ranks near this rank's points, in the order of ids, so that sums over them are the same on any number
// of ranks.
template <class Record>
class Near {
 public:
  Near(std::vector<Record> own, const Eigen::AlignedBox3d& mine, double reach, const Communicator& communicator)
      : all_(with_others(std::move(own), mine, reach, communicator)), grid_(places_of(all_), reach) {}

  // Calls visit(record, its position relative to x) for those of a body within `reach` of x.
  template <class Visit>
  void over(const Vector& x, double reach, std::int64_t body, const Visit& visit) const {
    std::vector<int> found;
    grid_.visit_near(x, [&](int n, const Vector& y) {
      if (all_[n].body == body && (y - x).squaredNorm() < reach * reach) found.push_back(n);
    });
    std::sort(found.begin(), found.end());
    for (const int n : found) visit(all_[n], Vector(all_[n].at() - x));
  }

 private:
  static std::vector<Record> with_others(std::vector<Record> own, const Eigen::AlignedBox3d& mine, double reach,
                                         const Communicator& communicator) {
    add_nearby(own, mine, reach, communicator);
    std::sort(own.begin(), own.end(), [](const Record& a, const Record& b) { return a.id < b.id; });
    return own;
  }

  std::vector<Record> all_;
  CellGrid grid_;
};

bool is_of(const Domain& domain, const BlockPair& blocks, int i) {
  const std::int64_t body = domain.body_of(i);
  return body == domain.blocks[blocks.first].body || body == domain.blocks[blocks.second].body;
}

// The pieces, and those behind periodic sides that are within `reach` of a box.
std::vector<Piece> with_periods(std::vector<Piece> pieces, const Domain& domain, const Eigen::AlignedBox3d& mine,
                                double reach) {
  const std::size_t count = pieces.size();
  const Images images(domain.periods, reach);
  for (const int image : images.of_body(0)) {
    for (std::size_t n = 0; n < count; ++n) {
      Piece other = pieces[n];
      const Vector at = images[image](other.at());
      std::ranges::copy(at, other.place);
      other.id = Images::id(other.id, image);
      // Another rank may be near it, too.
      if (domain.communicator.size() > 1 || mine.exteriorDistance(at) <= reach) pieces.push_back(other);
    }
  }
  return pieces;
}

// n·M n is the mean height of the cell's surface over its projection along n; the trace of M is the mean over the
// surface, each position along its own normal. They are equal for a plane.
void add_piece(const Domain& domain, int i, std::vector<Piece>& pieces) {
  const CellShape& shape = domain.cloud.shapes[i];
  const double spacing = domain.cloud.spacings[i], area = shape.surface.norm();
  if (!(area > least_area * spacing * spacing)) return;
  const Vector out = shape.surface / area, at = domain.reference(i) + shape.surface_moments.transpose() * out / area;
  const double spread = (shape.surface_moments.trace() - out.dot(shape.surface_moments * out)) / area;
  pieces.push_back({.place = {at[0], at[1], at[2]},
                    .normal = {out[0], out[1], out[2]},
                    .area = area,
                    .spread = spread,
                    .spacing = spacing,
                    .body = domain.body_of(i),
                    .id = domain.id(i)});
}

// Collective. The curvature κ is the mean over directions, from Σ Δn·Δx = κ Σ Δx². The summit of a curved surface is a
// twelfth of its area times κ above its mean height. Points a spacing apart miss as much again, of which half is
// corrected, because the first points of the two bodies touch first.
void bend(const Domain& domain, double spacing, std::vector<Piece>& own) {
  Eigen::AlignedBox3d mine;
  for (const Piece& piece : own) mine.extend(piece.at());
  const double within = around * spacing;
  const Near<Piece> all(with_periods(own, domain, mine, within), mine, within, domain.communicator);
  for (Piece& piece : own) {
    double turned = 0, squares = 0;
    all.over(piece.at(), around * piece.spacing, piece.body, [&](const Piece& other, const Vector& apart) {
      if (other.id == piece.id || !other.is_smooth() || !(other.out().dot(piece.out()) > alike)) return;
      turned += apart.dot(other.out() - piece.out());
      squares += apart.squaredNorm();
    });
    const double limit = sharpest / piece.spacing;
    if (squares > 0) piece.curvature = std::clamp(turned / squares, -limit, limit);
  }
  for (Piece& piece : own) {
    const double bent = piece.area / 12 + piece.spacing * piece.spacing / 24;
    const double summit = piece.is_smooth() ? bent * piece.curvature : 0;
    for (int c = 0; c < 3; ++c) piece.place[c] += summit * piece.normal[c];
  }
}

// Calls visit(x) for a place before a piece, and for its images.
template <class Visit>
void over_images(const Piece& piece, const Images& images, const Vector& place, const Visit& visit) {
  visit(place);
  for (const int image : images.of_body(static_cast<int>(piece.body))) visit(images[image](place));
}

// Collective. Sets `missing`: ρ before a flat face divided by ρ before each smooth piece.
void compare_with_face(const Domain& domain, const BlockPair& blocks, double reach, std::vector<Piece>& own) {
  const double unit = reach / reach_in_spacings, ahead = before * unit;
  const auto in_front = [ahead](const Piece& piece) { return Vector(piece.at() + ahead * piece.out()); };
  const Images images = images_of(domain, reach);
  Eigen::AlignedBox3d mine, filled;  // positions at which this rank needs ρ; all points
  std::vector<Grain> grains;
  for (int i = 0; i < domain.owned; ++i) {
    if (!is_of(domain, blocks, i)) continue;
    const Vector X = domain.reference(i);
    grains.push_back({{X[0], X[1], X[2]}, domain.volume(i), domain.body_of(i), domain.id(i)});
    filled.extend(X);
  }
  filled = common_box(filled, domain.communicator);
  for (const Piece& piece : own) {
    over_images(piece, images, in_front(piece), [&](const Vector& x) {
      if (filled.exteriorDistance(x) <= reach) mine.extend(x);
    });
  }
  const Near<Grain> material(std::move(grains), mine, reach, domain.communicator);
  const Smoothing smoothing(reach);
  for (Piece& piece : own) {
    if (!piece.is_smooth()) continue;
    double volume_fraction = 0;
    const auto add = [&](const Vector& x) {
      material.over(x, reach, piece.body, [&](const Grain& grain, const Vector& apart) {
        volume_fraction += grain.volume * smoothing.value(apart.squaredNorm());
      });
    };
    over_images(piece, images, in_front(piece), add);
    const double wanted = Face{reach, piece.spacing, true}.volume_fraction(ahead);
    const double missing = wanted / volume_fraction;
    piece.missing = missing < least_missing ? 0 : std::min(missing, most_missing);
  }
}

// Factor on a point's volume: the power mean (−8) of `missing` around it, which favors the least. Before an edge of the
// body ρ is lower, but volumes must not correct that: pieces at an edge count as 1.
double scale(const Near<Piece>& pieces, const Vector& X, int body, double within) {
  constexpr double power = -8;
  double weight = 0, sum = 0;
  pieces.over(X, within, body, [&](const Piece& piece, const Vector& apart) {
    if (!piece.is_smooth() && piece.spread < rim * piece.spacing) return;
    const double part = piece.area * std::pow(1 - apart.squaredNorm() / (within * within), 2);
    weight += part, sum += part * std::pow(piece.missing, power);
  });
  return weight > 0 ? std::pow(sum / weight, 1 / power) : 1;
}

// Depth of a point below the planes of smooth pieces near it, m; infinite without any.
double depth_below(const Near<Piece>& pieces, const Vector& X, int body, double spacing) {
  double depth = std::numeric_limits<double>::infinity();
  pieces.over(X, planes_within * spacing, body, [&](const Piece& piece, const Vector& apart) {
    const double below = piece.out().dot(apart);
    if (piece.is_smooth() && below > 0) depth = std::min(depth, below);
  });
  return depth;
}

// Extent of a point's cell beyond the point toward the surface of its body, m; the mean over all directions if the
// surface has no direction, as in a thin plate. 0 for a node: those at a surface lie on it, whether or not anything
// else in the deck needs their cells.
double reach_to_surface(const Domain& domain, int i) {
  const PointCloud& cloud = domain.cloud;
  if (cloud.at == PointsAt::nodes) return 0;
  if (cloud.shapes.empty()) return reach_of_cell(cloud, domain.volume(i), i, Vector::Zero());
  const Vector& surface = cloud.shapes[i].surface;
  const double area = surface.norm();
  if (!(area > least_area * std::pow(cloud.spacings[i], 2))) return std::sqrt(trace(cloud.shapes[i].moments));
  return reach_of_cell(cloud, domain.volume(i), i, surface / area);
}

// Sets depth, volume and may_touch of this rank's points of both blocks from the pieces around them.
void set_depths(const Domain& domain, const BlockPair& blocks, double reach, const Near<Piece>& pieces,
                OwnSurface& surface) {
  for (std::size_t k = 0; k < blocks.points.size(); ++k) {
    const int i = blocks.points[k], body = domain.body_of(i);
    const Vector X = domain.reference(i);
    const double spacing = domain.cloud.spacings[i];
    surface.volumes[k] *= scale(pieces, X, body, tells / reach_in_spacings * reach);
    const double below = depth_below(pieces, X, body, spacing);
    std::vector<Piece> piece;
    add_piece(domain, i, piece);
    if (piece.empty() && !(below < deepest * spacing)) continue;
    surface.may_touch[k] = true;
    const bool is_known = below < std::numeric_limits<double>::infinity() && (piece.empty() || piece[0].is_smooth());
    surface.depths[k] = is_known ? below : std::min(surface.depths[k], below);
  }
}

}  // namespace

OwnSurface own_surface(const Domain& domain, const BlockPair& blocks, double reach) {
  OwnSurface surface;
  for (const int i : blocks.points) {
    surface.depths.push_back(reach_to_surface(domain, i));
    surface.volumes.push_back(domain.volume(i));
    surface.may_touch.push_back(is_at_surface(domain, i));
  }
  const bool is_known = domain.cloud.at == PointsAt::elements && !domain.cloud.shapes.empty();
  if (!domain.communicator.any(is_known)) return surface;
  Eigen::AlignedBox3d mine;
  std::vector<Piece> own;
  double spacing = 0;
  for (int i = 0; i < domain.owned; ++i) {
    if (!is_of(domain, blocks, i)) continue;
    mine.extend(domain.reference(i));
    spacing = std::max(spacing, domain.cloud.spacings[i]);
    add_piece(domain, i, own);
  }
  spacing = domain.communicator.max(spacing);
  bend(domain, spacing, own);
  compare_with_face(domain, blocks, reach, own);
  const double within = std::max(tells / reach_in_spacings * reach, planes_within * spacing);
  own = with_periods(std::move(own), domain, mine, within);
  set_depths(domain, blocks, reach, Near<Piece>(std::move(own), mine, within, domain.communicator), surface);
  return surface;
}

}  // namespace strut::contact

#include "contact/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "contact/breaks.hpp"
#include "contact/laws/contact_law.hpp"
#include "contact/own_surface.hpp"
#include "contact/search/search.hpp"

namespace strut::contact {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

// Upper bound of the change of ρ, times the smallest reach, per length that all near points move: ∫ |W'| dV is 6.3/R,
// and material may be denser than in the reference state.
constexpr double steepest_fraction = 10;

// `depth`: below the surface of its body, m.
SurfacePoint surface_point(const Domain& domain, int i, double spacing_of_other, double depth, bool may_touch) {
  const PointCloud& cloud = domain.cloud;
  const double spacing = cloud.spacings[i];
  const double reach = reach_in_spacings * std::max(spacing, spacing_of_other);
  const double beyond = std::min(depth, 0.5 * reach);  // farther out ρ has no information
  const bool nodes = cloud.at == PointsAt::nodes;
  const Face other{reach, spacing_of_other, !nodes};
  return {.reach = reach,
          .threshold = other.volume_fraction(beyond),
          .slope = other.slope(beyond),
          .depth = beyond,
          .area = (nodes ? 1 : 0.5) * domain.volume(i) / spacing,
          .spacing = spacing,
          .volume = domain.volume(i),
          .is_at_surface = may_touch};
}

}  // namespace

// ρ at a point and its derivatives by positions.
struct Surfaces::Felt {
  double volume_fraction = 0;
  Vector gradient = Vector::Zero();  // by the point's own position, 1/m
  double of_partners = 0;            // Σ |∂ρ/∂y_j|/√m_j
};

Surfaces::Surfaces(const Domain& domain, const BlockPair& blocks, const SurfaceLaw& law) {
  const double spacing = std::max(domain.blocks[blocks.first].spacing, domain.blocks[blocks.second].spacing);
  OwnSurface own = own_surface(domain, blocks, reach_in_spacings * spacing);
  for (std::size_t k = 0; k < blocks.points.size(); ++k) {
    const int i = blocks.points[k], other = domain.cloud.blocks[i] == blocks.first ? blocks.second : blocks.first;
    points_.push_back(surface_point(domain, i, domain.blocks[other].spacing, own.depths[k], own.may_touch[k]));
  }
  volumes_ = std::move(own.volumes);
  overlaps_.assign(points_.size(), 0);
  slips_.assign(points_.size(), Vector::Zero());
  slips_before_ = slips_;
  if (!blocks.one_body) subtract_start(domain, blocks, law);
}

void Surfaces::subtract_start(const Domain& domain, const BlockPair& blocks, const SurfaceLaw& law) {
  const std::vector<Vector> at_rest(domain.owned, Vector::Zero());
  const std::vector<double> densities(domain.owned, 1);
  SkinDistances none{std::vector<float>(blocks.points.size(), 0), 0};
  Pairs pairs = find_pairs({domain, at_rest, densities}, blocks, law.radius, none);
  take(domain, blocks, {}, {}, pairs);
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    SurfacePoint& point = points_[places_[k]];
    const double felt = std::max(point.threshold, feel(pairs, k).volume_fraction);
    point.at_start = (felt - point.threshold) / point.slope;
    point.threshold = felt;
  }
}

double Surfaces::overlap_at_start() const {
  double largest = 0;
  for (const SurfacePoint& point : points_) {
    if (point.is_at_surface) largest = std::max(largest, point.at_start / point.spacing);
  }
  return largest;
}

void Surfaces::take(const Domain& domain, const BlockPair& blocks, const BrokenCounts& before, const BrokenCounts& now,
                    Pairs& pairs) {
  places_ = places_in(blocks, pairs);
  next_checks_.clear();
  std::vector<Vector> slips(blocks.points.size(), Vector::Zero());
  std::vector<double> overlaps(blocks.points.size(), 0);
  for (const int at : places_) {
    next_checks_.push_back(points_[at].is_at_surface ? 0 : never);
    slips[at] = slips_[at];
    overlaps[at] = overlaps_[at];
  }
  slips_.swap(slips);  // points without partners lose theirs
  overlaps_.swap(overlaps);
  facing_.assign(pairs.sites.size(), {});
  note_touching();
  gradient_.assign(pairs.owned.size(), Vector::Zero());
  seen_.clear();
  set_smallest_reaches(pairs);
  set_volumes(pairs);
  see_through_breaks(domain, blocks, before, now, pairs);
}

// Sets the volumes that ρ sums.
void Surfaces::set_volumes(Pairs& pairs) const {
  std::vector<double> volumes(pairs.sites.size());
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) volumes[k] = volumes_[places_[k]];
  if (pairs.halo) pairs.halo->exchange(volumes);
  for (std::size_t k = 0; k < pairs.sites.size(); ++k) pairs.sites[k].reference[3] = volumes[k];
}

void Surfaces::set_smallest_reaches(const Pairs& pairs) {
  smallest_reach_.clear();
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    const double reach = points_[places_[k]].reach;
    double smallest = reach;
    for (std::size_t p = pairs.start[k]; pairs.one_body && p < pairs.start[k + 1]; ++p) {
      smallest = std::min(smallest, reach_between(reach, pairs.sites[k], pairs.sites[pairs.partners[p]], true));
    }
    smallest_reach_.push_back(smallest);
  }
}

// Points with broken bonds are at a surface from then on.
void Surfaces::expose_broken(const Domain& domain, const Pairs& pairs) {
  for (std::size_t k = 0; k < pairs.owned.size() && !broken_.empty(); ++k) {
    if (next_checks_[k] != never || domain.families.broken[pairs.owned[k]].empty()) continue;
    next_checks_[k] = 0;
    BrokenPoint& point = broken_[places_[k]];
    if (point.is_exposed) continue;
    point.is_exposed = true;
    point.excess = std::max(0.0, feel(pairs, k).volume_fraction - points_[places_[k]].threshold);
  }
}

// Points whose bonds have broken since the last search see each other from now on; `excess` keeps their overlap.
void Surfaces::see_through_breaks(const Domain& domain, const BlockPair& blocks, const BrokenCounts& before,
                                  const BrokenCounts& now, const Pairs& pairs) {
  if (now.empty()) return;
  broken_.resize(points_.size());
  std::vector<char> has_partners(points_.size(), false);
  for (const int at : places_) has_partners[at] = true;
  for (std::size_t at = 0; at < points_.size(); ++at) broken_[at].excess *= has_partners[at];
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    const int at = places_[k];
    const std::vector<std::int64_t> unseen = new_breaks(domain, blocks, at, before, now);
    if (unseen.empty()) continue;
    const double without = feel(pairs, k, unseen).volume_fraction, with = feel(pairs, k).volume_fraction;
    if (!(with > without)) continue;
    BrokenPoint& point = broken_[at];
    const double threshold = points_[at].threshold, overlap = without - threshold - point.excess;
    const bool pressed = (points_[at].is_at_surface || point.is_exposed) && overlap > 0;
    point.excess = std::max(point.excess, with - threshold - (pressed ? overlap : 0));
  }
}

// `unseen`: ids of points that are left out.
Surfaces::Felt Surfaces::feel(const Pairs& pairs, std::size_t k, std::span<const std::int64_t> unseen) const {
  Felt felt;
  over_felt(pairs, k, [&](int partner, const Vector& eta, double distance2, double reach) {
    if (!unseen.empty() && std::find(unseen.begin(), unseen.end(), pairs.ids[partner]) != unseen.end()) return;
    const Smoothing around(reach);
    const double volume = pairs.sites[partner].volume(), slope = volume * around.slope_over_distance(distance2);
    felt.volume_fraction += volume * around.value(distance2);
    felt.gradient -= slope * eta;
    felt.of_partners += std::abs(slope) * std::sqrt(distance2) / std::sqrt(pairs.masses[partner]);
  });
  return felt;
}

// `overlap`: on entry that of the last forces, on return the present one; 0 if the point does not touch.
Surfaces::Facing Surfaces::facing(const SurfaceLaw& law, const SurfacePoint& point, const Felt& felt, double threshold,
                                  double mass, double& overlap) const {
  Facing facing{.reach = point.reach};
  const double before = overlap, now = (felt.volume_fraction - threshold) / point.slope;
  overlap = std::max(0.0, now);
  if (!(now >= 0) || felt.volume_fraction == 0) return facing;
  const double by_fraction = point.area / (point.slope * point.slope);
  facing.push = point.area * law.pressure(now) / point.slope;
  facing.stiffness = by_fraction * law.slope(now);
  facing.to_come = by_fraction * law.slope(now + std::max(0.0, now - before));
  facing.spread = felt.gradient.norm() / std::sqrt(mass) + felt.of_partners;
  return facing;
}

// Raises travel_, a bound of the approach of any two points since the search, by twice the largest displacement in this
// step relative to the mean.
void Surfaces::advance_travel(const Pairs& pairs) {
  if (seen_.size() != pairs.sites.size()) {
    travel_ = 0;
  } else {
    Vector mean = Vector::Zero();
    double largest2 = 0;
    const auto displacement = [&](std::size_t s) {
      return Vector(pairs.sites[s].current.head<3>().matrix() - seen_[s]);
    };
    for (std::size_t s = 0; s < seen_.size(); ++s) mean += displacement(s) / static_cast<double>(seen_.size());
    for (std::size_t s = 0; s < seen_.size(); ++s)
      largest2 = std::max(largest2, (displacement(s) - mean).squaredNorm());
    travel_ += 2 * std::sqrt(largest2);
  }
  seen_.clear();
  for (const Site& site : pairs.sites) seen_.push_back(site.current.head<3>().matrix());
}

void Surfaces::note_touching() {
  touches_.assign(facing_.size(), false);
  any_touches_ = false;
  for (std::size_t s = 0; s < facing_.size(); ++s) {
    if (facing_[s].touches()) touches_[s] = any_touches_ = true;
  }
}

// Evaluates the points: energy and deepest overlap. A point that does not touch is skipped until the motion may have
// closed its gap; one with an excess is evaluated in each step.
ForceResult Surfaces::feel_all(const SurfaceLaw& law, bool is_trial, const Pairs& pairs) {
  advance_travel(pairs);
  ForceResult result;
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    if (travel_ < next_checks_[k]) continue;
    const SurfacePoint& point = points_[places_[k]];
    const Felt felt = feel(pairs, k);
    const bool has_excess = excess_of(k) > 0;
    if (has_excess && !is_trial) {
      double& excess = broken_[places_[k]].excess;
      excess = std::clamp(felt.volume_fraction - point.threshold, 0.0, excess);
    }
    const double threshold = point.threshold + excess_of(k);
    next_checks_[k] =
        has_excess ? 0 : travel_ + (threshold - felt.volume_fraction) * smallest_reach_[k] / steepest_fraction;
    double& overlap = overlaps_[places_[k]];
    gradient_[k] = felt.gradient;
    facing_[k] = facing(law, point, felt, threshold, pairs.masses[k], overlap);
    result.energy += point.area * law.energy(overlap);
    result.deepest.take({overlap / point.spacing, pairs.owned[k], true});
  }
  return result;
}

// The Hessian Σ κ ∇ρ ⊗ ∇ρ of all touching points, with M^(−1/2) on both sides, is bounded by a tensor for each point:
// (Σ_m g_m·x_m)² ≤ S Σ_m (√m_m/|g_m|) (g_m·x_m)² with S = Σ_m |g_m|/√m_m (Cauchy and Schwarz).
ForceResult Surfaces::add_normal_forces(const Kinematics& kinematics, const SurfaceLaw& law, bool is_trial,
                                        Pairs& pairs, std::vector<Vector>& force_density) {
  bring_to_present(kinematics, pairs);
  expose_broken(kinematics.domain, pairs);
  ForceResult result = feel_all(law, is_trial, pairs);
  exchange_records(pairs, facing_);
  note_touching();
  if (!any_touches_) return result;
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    const double root = std::sqrt(pairs.masses[k]), volume = points_[places_[k]].volume;
    Tensor springs = Tensor::Zero();
    Vector force = Vector::Zero();
    over_gradients(pairs, k, [&](const Facing& felt_by, const Vector& gradient) {
      force -= felt_by.push * gradient;
      const double length = gradient.norm();
      if (length > 0) springs += felt_by.to_come * felt_by.spread / (root * length) * gradient * gradient.transpose();
    });
    force_density[pairs.owned[k]] += force / volume;
    result.stiffness = std::max(result.stiffness, largest_eigenvalue(springs, result.stiffness));
  }
  return result;
}

void Surfaces::for_each_normal_force(const Pairs& pairs, const std::function<void(std::size_t, Vector)>& visit) const {
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    Vector force = Vector::Zero();
    over_gradients(pairs, k, [&](const Facing& felt_by, const Vector& gradient) { force -= felt_by.push * gradient; });
    visit(k, force);
  }
}

// Points and those that feel them, each pair once.
Vector Surfaces::normal_force_through_sides(const Pairs& pairs) const {
  Vector sum = Vector::Zero();
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    over_feeling(pairs, k, [&](int partner, const Vector& eta, double distance2, double reach) {
      const double slope = pairs.sites[k].volume() * Smoothing(reach).slope_over_distance(distance2);
      sum += pairs.through_sides(partner, facing_[partner].push * slope * eta);
    });
  }
  return sum;
}

void Surfaces::add_springs(const Pairs& pairs, std::span<Tensor> springs) const {
  for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
    Tensor sum = Tensor::Zero();
    over_gradients(pairs, k, [&](const Facing& felt_by, const Vector& gradient) {
      sum += felt_by.stiffness * gradient * gradient.transpose();
    });
    if (!friction_tangents_.empty() && !friction_tangents_[k].slides) {
      sum += friction_tangents_[k].spring *
             (Tensor::Identity() - friction_tangents_[k].normal * friction_tangents_[k].normal.transpose());
    }
    springs[pairs.owned[k]] += sum;
  }
}

void Surfaces::serialize_start(Archive& archive) {
  archive.field("threshold", 1, [this](std::size_t k, int) -> double& { return points_[k].threshold; });
}

void Surfaces::serialize(Archive& archive, bool may_break) {
  if (friction_before_.empty()) friction_before_.assign(points_.size(), Vector::Zero());
  archive.field("slip", 3, [this](std::size_t k, int c) -> double& { return slips_before_[k][c]; });
  archive.field("friction", 3, [this](std::size_t k, int c) -> double& { return friction_before_[k][c]; });
  if (archive.loading()) slips_ = slips_before_;
  if (!may_break) return;
  broken_.resize(points_.size());
  archive.field("excess", 1, [this](std::size_t k, int) -> double& { return broken_[k].excess; });
  archive.field("is_exposed", 1, [this](std::size_t k, int) -> bool& { return broken_[k].is_exposed; });
}

}  // namespace strut::contact

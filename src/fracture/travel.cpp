#include "fracture/travel.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace strut {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

}  // namespace

Travel::Travel(const Domain& domain) {
  const ClusterLists& lists = domain.families.lists;
  regions_.resize((lists.count() + clusters_a_region - 1) / clusters_a_region);
  std::vector<int> region_of(domain.owned, -1);
  for (int c = 0; c < lists.count(); ++c) {
    for (const int i : lists[c].points) region_of[i] = c / clusters_a_region;
  }
  std::vector<int> seen(regions_.size(), -1);  // the last region that saw each region
  for (int c = 0; c < lists.count(); ++c) {
    const int own = c / clusters_a_region;
    Region& region = regions_[own];
    const auto add = [&](int i) {
      if (i >= domain.owned) {
        region.meets_ghosts = true;
      } else if (seen[region_of[i]] != own) {
        seen[region_of[i]] = own;
        region.near.push_back(region_of[i]);
      }
    };
    add(lists[c].points[0]);
    for (const int j : lists[c].near) add(j);
  }
  for (const ImagePoint& image : domain.halo.images()) farthest_ = farthest_.cwiseMax(image.by.period.cwiseAbs());
}

// The relative displacement that is left before the next check of a region, m.
double Travel::until_check(std::size_t region, std::span<const double> next_checks) const {
  const auto begin = next_checks.begin() + static_cast<std::ptrdiff_t>(region) * clusters_a_region;
  const auto left = std::min<std::ptrdiff_t>(clusters_a_region, next_checks.end() - begin);
  return *std::min_element(begin, begin + left) - regions_[region].travel;
}

void Travel::set_boxes(const ClusterLists& lists, std::span<const Vector> velocities,
                       std::span<const double> next_checks) {
  for (Region& region : regions_) region.box.setEmpty();
  for (int c = 0; c < lists.count(); ++c) {
    if (next_checks[c] == never) continue;
    Eigen::AlignedBox3d& box = regions_[c / clusters_a_region].box;
    for (const int i : lists[c].points) box.extend(velocities[i]);
  }
}

bool Travel::advance(const Body& body, std::span<const Vector> velocities, double dt,
                     std::span<const double> next_checks, const Vector& stretch) {
  constexpr double margin = 1 + 1e-6;  // for the round-off of positions
  set_boxes(body.domain.families.lists, velocities, next_checks);
  Eigen::AlignedBox3d all;
  for (const Region& region : regions_) all.extend(region.box);
  if (!body.domain.mirrors.empty() && !all.isEmpty()) {  // images move in other directions at the same speed
    const double speed = all.min().cwiseAbs().cwiseMax(all.max().cwiseAbs()).norm();
    all.extend(Vector::Constant(speed)), all.extend(Vector::Constant(-speed));
  }
  // Largest excess of the travel over the one at which a check must follow, m: of regions without ghosts; of those with
  // ghosts, before this step is added.
  double passed = -never, at_ghosts = -never;
  for (std::size_t r = 0; r < regions_.size(); ++r) {
    Region& region = regions_[r];
    if (region.box.isEmpty()) continue;
    if (region.meets_ghosts) {
      at_ghosts = std::max(at_ghosts, -until_check(r, next_checks));
      continue;
    }
    Eigen::AlignedBox3d box;
    for (const int near : region.near) box.extend(regions_[near].box);
    region.travel += margin * dt * box.diagonal().norm();
    passed = std::max(passed, -until_check(r, next_checks));
  }
  std::array<double, 9> most{
      passed, at_ghosts, -never, -never, -never, -never, -never, -never, farthest_.cwiseProduct(stretch).norm()};
  for (int axis = 0; axis < 3 && !all.isEmpty(); ++axis) {
    most[2 + 2 * axis] = all.max()[axis], most[3 + 2 * axis] = -all.min()[axis];
  }
  body.domain.communicator.max(most);
  const Vector range(most[2] + most[3], most[4] + most[5], most[6] + most[7]);
  last_ = range.allFinite() ? margin * (dt * range.norm() + most[8]) : 0;
  for (Region& region : regions_) {
    if (region.meets_ghosts) region.travel += last_;
  }
  return most[0] >= 0 || most[1] + last_ >= 0;
}

double Travel::bytes() const {
  double sum = static_cast<double>(regions_.size() * sizeof(Region));
  for (const Region& region : regions_) sum += static_cast<double>(region.near.size() * sizeof(int));
  return sum;
}

}  // namespace strut

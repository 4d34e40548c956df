#include "mechanics/thin_members.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/errors.hpp"
#include "topology/bounding_box.hpp"
#include "topology/nearby_ranks.hpp"
#include "topology/neighbors/cell_grid.hpp"

namespace strut {

namespace {

// W(r) = 45045/(4096 π R³) (1 − r²/R²)⁶ has the integral 1, and its sum over a lattice does not show the lattice; R in
// spacings, and the mean of |x| under W in units of R.
constexpr double reach_in_spacings = 4, mean_distance = 0.196386;
// Corrects for the layers of points: nodes on a face see more missing material than middles of cells behind it. Square
// bars and plates along a lattice see a little more than round rods; the factors are the middle of what was measured
// (tests/verification/mechanics/test_thickness.cpp).
double of_steps(PointsAt at) { return at == PointsAt::nodes ? 1.19 : 0.965; }
double smoothing(double r2, double reach) {
  const double x = 1 - r2 / (reach * reach), cube = x * x * x;
  return 45045 / (4096 * std::numbers::pi * reach * reach * reach) * cube * cube;
}

// The thickness of a block is measured at this many of its points at most.
constexpr std::int64_t most_samples = 50000;

// A point at which the material around it is measured, as it is sent to other ranks.
struct Sample {
  double place[3], spacing, volume, block;
  Vector at() const { return {place[0], place[1], place[2]}; }
};

double reach_of(double spacing) { return reach_in_spacings * spacing; }

std::vector<Sample> own_samples(const Domain& domain) {
  const PointCloud& cloud = domain.cloud;
  std::vector<double> counts(domain.blocks.size(), 0);
  for (int i = 0; i < domain.owned; ++i) ++counts[cloud.blocks[i]];
  domain.communicator.sum(counts);
  std::vector<Sample> samples;
  for (int i = 0; i < domain.owned; ++i) {
    const int block = cloud.blocks[i];
    const std::int64_t each = 1 + static_cast<std::int64_t>(counts[block]) / most_samples;
    if (cloud.ids[i] % each != 0) continue;
    const Vector X = domain.reference(i);
    samples.push_back({{X[0], X[1], X[2]}, cloud.spacings[i], domain.volume(i), static_cast<double>(block)});
  }
  return samples;
}

// The images of bodies within `reach` (m); nothing if there are too many.
std::optional<Images> few_images_of(const Domain& domain, double reach) {
  try {
    return images_of(domain, reach);
  } catch (const Error&) {
    return std::nullopt;
  }
}

// Symmetry planes and periodic sides are no surface. The images of samples see of a body what samples see of its
// images.
void add_images(const Domain& domain, const Images& images, const Eigen::AlignedBox3d& all, double reach,
                std::vector<Sample>& samples) {
  for (std::size_t s = 0, own = samples.size(); s < own; ++s) {
    for (const int image : images.of_body(domain.blocks[static_cast<std::size_t>(samples[s].block)].body)) {
      const Vector place = images[image](samples[s].at());
      if (all.squaredExteriorDistance(place) > reach * reach) continue;
      Sample one = samples[s];
      std::copy_n(place.data(), 3, one.place);
      samples.push_back(one);
    }
  }
}

// Adds for each block the material of its body around the samples that this rank has, times their volume over their
// spacing.
void add_material(const Domain& domain, const std::vector<Sample>& samples, std::span<double> of_blocks) {
  double farthest = 0;
  for (const Sample& one : samples) farthest = std::max(farthest, reach_of(one.spacing));
  if (farthest == 0) return;
  const CellGrid grid(places_of(samples), farthest);
  for (int j = 0; j < domain.owned; ++j) {
    const Vector X = domain.reference(j);
    const int body = domain.body_of(j);
    grid.visit_near(X, [&](int s, const Vector& place) {
      const auto block = static_cast<std::size_t>(samples[s].block);
      const double r2 = (place - X).squaredNorm(), reach = reach_of(samples[s].spacing);
      if (r2 < reach * reach && domain.blocks[block].body == body)
        of_blocks[block] += samples[s].volume / samples[s].spacing * domain.volume(j) * smoothing(r2, reach);
    });
  }
}

struct Entry {
  double thickness, kept;
};

double interpolated(const std::vector<Entry>& table, double thickness) {
  const auto above = std::find_if(table.begin(), table.end(), [&](const Entry& e) { return e.thickness >= thickness; });
  if (above == table.begin()) return table.front().kept;
  if (above == table.end()) return 1 - (1 - table.back().kept) * table.back().thickness / thickness;
  const Entry &b = *above, &a = *(above - 1);
  return a.kept + (b.kept - a.kept) * (thickness - a.thickness) / (b.thickness - a.thickness);
}

}  // namespace

// The material missing around a point, 1 − Σ V W, summed over a body, is its surface times half of the mean |x| under
// W, in any orientation. A square bar of thickness t, averaged over its points, has (1 − mean/t)² of the material,
// which is close to that of plates and round rods.
std::vector<double> thicknesses(const Domain& domain) {
  const std::size_t blocks = domain.blocks.size();
  std::vector<Sample> samples = own_samples(domain);
  enum Sum { of_volume, of_spacing, whole, found, count };  // whole, found: material around, times volume over spacing
  std::vector<double> sums(count * blocks, 0);
  double farthest = 0;
  for (const Sample& one : samples) {
    const auto add = [&](Sum sum, double value) { sums[sum * blocks + static_cast<std::size_t>(one.block)] += value; };
    add(of_volume, one.volume), add(of_spacing, one.volume * one.spacing), add(whole, one.volume / one.spacing);
    farthest = std::max(farthest, reach_of(one.spacing));
  }
  farthest = domain.communicator.max(farthest);
  Eigen::AlignedBox3d mine;
  for (int i = 0; i < domain.owned; ++i) mine.extend(domain.reference(i));
  std::vector<double> thicknesses(blocks, 0);
  const std::optional<Images> images = few_images_of(domain, farthest);
  if (!images) return thicknesses;
  add_images(domain, *images, common_box(mine, domain.communicator), farthest, samples);
  add_nearby(samples, mine, farthest, domain.communicator);
  add_material(domain, samples, std::span(sums).subspan(found * blocks));
  domain.communicator.sum(sums);
  for (std::size_t b = 0; b < blocks; ++b) {
    const auto sum = [&](Sum of) { return sums[of * blocks + b]; };
    const double volume = sum(of_volume), missing = (sum(whole) - sum(found)) * sum(of_spacing) / (volume * volume);
    if (missing > 0.01 && missing < 1)
      thicknesses[b] = of_steps(domain.cloud.at) * mean_distance * reach_in_spacings / (1 - std::sqrt(1 - missing));
  }
  return thicknesses;
}

double bending_stiffness_kept(Influence influence, double horizon, double thickness) {
  if (!(thickness > 0)) return 1;
  // An influence function that decays acts like a short horizon. Measured fractions of the bending stiffness: 0.62 for
  // cubic decay, a horizon of 2.6 spacings and bars 4 spacings thick; 0.68 for linear decay, 3.015 and 6 spacings.
  if (horizon < 2.4 || influence != Influence::one)
    return interpolated({{2, 0.08}, {3, 0.26}, {4, 0.51}, {6, 0.74}}, thickness);
  return interpolated({{2, 0.08}, {3, 0.19}, {4, 0.31}, {6, 0.51}}, thickness);
}

// Measured on square bars along an axis of their lattice, 40 points long, under 0.1 % of tension. Bars thicker than the
// last entry of a table are not thin.
double tension_stiffness_found(Influence influence, double horizon, double thickness) {
  if (!(thickness > 0) || thickness > 12) return 1;
  if (horizon < 1.9)
    return interpolated({{2, 1.02}, {3, 0.86}, {4, 0.78}, {6, 0.72}, {8, 0.68}, {12, 0.65}}, thickness);
  if (horizon < 2.5)
    return interpolated({{2, 2.59}, {3, 1.85}, {4, 1.63}, {6, 1.45}, {8, 1.36}, {12, 1.28}}, thickness);
  if (influence == Influence::one)
    return interpolated({{2, 3.45}, {3, 1.66}, {4, 1.29}, {6, 1.12}, {8, 1.05}, {12, 0.98}}, thickness);
  return interpolated({{2, 2.46}, {3, 1.58}, {4, 1.36}, {6, 1.23}, {8, 1.17}, {12, 1.11}}, thickness);
}

}  // namespace strut

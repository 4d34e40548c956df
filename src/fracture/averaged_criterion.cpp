#include "fracture/averaged_criterion.hpp"

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "fracture/fitted_criterion.hpp"
#include "topology/parallel_for.hpp"

namespace strut {

namespace {

// Indicators are averaged again once one has grown by this much since the last average; a point fails at 1.
constexpr double growth_between_averages = 0.01;

constexpr double most_passes = 1000;  // a ball of some 50 spacings

int number_of_indicator(const MaterialBlock& block) {
  const bool fails = block.material.damage && block.material.damage->ductility;
  return fails ? state_column(block, "Failure_Indicator") : -1;
}

double variance_of_ball(const MaterialBlock& block) {
  const double radius = block.material.damage->ductility->averaging_radius;
  return radius * radius / 5;
}

bool averages(const MaterialBlock& block) { return number_of_indicator(block) >= 0 && variance_of_ball(block) > 0; }

std::string too_wide(const Body& body, std::size_t b) {
  return text_of("Damage Models: the Averaging Radius of block '", body.blocks[b].name, "' is ",
                 body.blocks[b].material.damage->ductility->averaging_radius / body.domain.blocks[b].spacing,
                 " spacings; expected at most some 50. Is it in m?");
}

}  // namespace

AveragedCriterion::AveragedCriterion(Body& body) {
  const Domain& domain = body.domain;
  if (std::ranges::none_of(body.blocks, averages)) return;
  has_indicator_.assign(domain.sites.size(), 0);
  double passes = 1;
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    const MaterialBlock& block = body.blocks[b];
    if (!averages(block)) continue;
    for (const int i : block.points) has_indicator_[i] = 1;
    blocks_.push_back({b, number_of_indicator(block), variance_of_ball(block)});
  }
  domain.halo.exchange(has_indicator_);
  for (OfBlock& one : blocks_) {
    const double of_pass = domain.communicator.max(largest_variance(domain, body.blocks[one.block]));
    one.part = of_pass > 0 ? one.part / of_pass : 0;
    passes = std::max(passes, std::ceil(one.part));
    if (one.part > most_passes) throw Error(too_wide(body, one.block));
  }
  for (OfBlock& one : blocks_) one.part /= passes;
  passes_ = static_cast<int>(passes);
  body.averaged_indicator.use(body.owned());
}

// Visits i and the members of its family whose indicators are averaged.
template <class Visit>
void AveragedCriterion::over_family(const Domain& domain, int i, const Visit& visit) const {
  visit(i);
  domain.families.for_each(i, [&](int j) {
    if (has_indicator_[j] > 0) visit(j);
  });
}

// The variance along one axis, m², of a family inside the block, which is larger than of one at its surface.
double AveragedCriterion::largest_variance(const Domain& domain, const MaterialBlock& block) const {
  double most = 0;
  for (const int i : block.points) {
    double volume = 0, squares = 0;
    over_family(domain, i, [&](int j) {
      volume += domain.volume(j);
      squares += domain.volume(j) * (domain.reference(j) - domain.reference(i)).squaredNorm();
    });
    most = std::max(most, squares / (3 * volume));
  }
  return most;
}

template <class Visit>
void AveragedCriterion::over_points(Body& body, const Visit& visit) const {
  for (const OfBlock& one : blocks_) {
    MaterialBlock& block = body.blocks[one.block];
    for_each_point(0, static_cast<int>(block.points.size()), [&](int k) { visit(one, block, k); });
  }
}

// The growth of the indicator since the last average: of owned points; ghosts have 0 until an exchange.
std::vector<double> AveragedCriterion::growth_of(Body& body) const {
  std::vector<double> growth(body.domain.sites.size(), 0);
  over_points(body, [&](const OfBlock& one, const MaterialBlock& block, int k) {
    double sum = 0;
    for (int q = 0; q < block.points_per_cell(); ++q) sum += block.state->at(block.index(k, q), one.number);
    const int i = block.points[k];
    growth[i] = sum / block.points_per_cell() - body.averaged_indicator[i];
  });
  return growth;
}

void AveragedCriterion::pass(Body& body, std::vector<double>& growth) const {
  const Domain& domain = body.domain;
  domain.halo.exchange(growth);
  const std::vector<double> before = growth;
  over_points(body, [&](const OfBlock& one, const MaterialBlock& block, int k) {
    const int i = block.points[k];
    double volume = 0, sum = 0;
    over_family(domain, i, [&](int j) {
      volume += domain.volume(j);
      sum += domain.volume(j) * before[j];
    });
    growth[i] += one.part * (sum / volume - before[i]);
  });
}

void AveragedCriterion::average(Body& body) {
  if (passes_ == 0) return;
  std::vector<double> growth = growth_of(body);
  const double most = growth.empty() ? 0 : *std::max_element(growth.begin(), growth.end());
  if (body.domain.communicator.max(most) < growth_between_averages) return;
  for (int n = 0; n < passes_; ++n) pass(body, growth);
  over_points(body, [&](const OfBlock& one, MaterialBlock& block, int k) {
    const int i = block.points[k];
    const double averaged = body.averaged_indicator[i] + growth[i];
    double sum = 0;
    for (int q = 0; q < block.points_per_cell(); ++q) {
      double& own = block.state->at(block.index(k, q), one.number);
      if (own < 1) own = averaged;  // a point that softens already keeps its own indicator
      sum += own;
    }
    body.averaged_indicator[i] = sum / block.points_per_cell();  // the next average starts from here
  });
}

}  // namespace strut

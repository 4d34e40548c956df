#include <algorithm>
#include <cmath>
#include <ranges>

#include "mechanics/body.hpp"
#include "mechanics/expansion.hpp"

namespace strut {

void add_heated(Body& body, HeatedPoints heated) {
  if (body.expansion.empty()) body.expansion.use(body.owned());
  body.heated.push_back(std::move(heated));
}

void set_reference_temperatures(Body& body, double t) {
  for (const HeatedPoints& heated : std::views::reverse(body.heated)) {
    for (const int i : heated.points) {
      double& reference = body.expansion[i].reference;
      if (std::isnan(reference)) reference = heated.temperature(body.domain.reference(i), t);
    }
  }
}

void set_expansion(Body& body, double time, double dt, int level) {
  for (std::size_t i = 0; i < body.expansion.size(); ++i) {
    if (body.is_active(static_cast<int>(i), level)) body.expansion[i].before = body.expansion[i].now;
  }
  if (!(dt > 0)) return;
  for (const HeatedPoints& heated : body.heated) {
    for (const int i : heated.points) {
      const double alpha = body.block_of(i).material.thermal_expansion;
      if (alpha == 0 || !body.is_active(i, level)) continue;
      body.expansion[i].now =
          alpha * (heated.temperature(body.domain.reference(i), time) - body.expansion[i].reference);
    }
  }
}

double sudden_expansion(Body& body, double t) {
  if (body.heated.empty()) return 0;
  const std::vector<PointExpansion> kept = *body.expansion;
  set_expansion(body, t, 1);
  double most = 0;
  for (const PointExpansion& point : *body.expansion) most = std::max(most, std::abs(point.now - point.before));
  body.expansion = kept;
  return most;
}

void exchange_expansion(Body& body) {
  body.expansion_of_sites.assign(body.domain.sites.size(), 0);
  for (int i = 0; i < body.owned(); ++i) body.expansion_of_sites[i] = body.expansion[i].now;
  body.domain.halo.exchange(body.expansion_of_sites);
}

bool expands(const Body& body, std::size_t block) {
  if (body.expansion.empty() || body.blocks[block].material.thermal_expansion == 0) return false;
  const auto is_heated = [](const PointExpansion& point) { return !std::isnan(point.reference); };
  return std::ranges::any_of(body.blocks[block].points, [&](int i) { return is_heated(body.expansion[i]); });
}

}  // namespace strut

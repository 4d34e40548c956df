#include "mechanics/expansion.hpp"

#include <algorithm>

#include "mechanics/body.hpp"

namespace strut {

void add_heated(Body& body, HeatedPoints heated) {
  if (body.expansion.empty()) body.expansion.use(body.owned());
  body.heated.push_back(std::move(heated));
}

void set_expansion(Body& body, double time, double dt, int level) {
  for (const HeatedPoints& heated : body.heated) {
    for (const int i : heated.points) {
      const double alpha = body.block_of(i).material.thermal_expansion;
      if (alpha == 0 || !body.is_due(i, level)) continue;
      const Vector X = body.domain.reference(i);
      const auto strain = [&](double t) {
        return alpha *
               (heated.temperature(X[0], X[1], X[2], t) - heated.temperature(X[0], X[1], X[2], heated.reference_time));
      };
      PointExpansion& point = body.expansion[i];
      point.now = strain(time);
      point.before = dt > 0 ? strain(time - dt * body.share(i, level)) : point.now;
    }
  }
}

void exchange_expansion(Body& body) {
  body.expansion_of_sites.assign(body.domain.sites.size(), 0);
  for (int i = 0; i < body.owned(); ++i) body.expansion_of_sites[i] = body.expansion[i].now;
  body.domain.halo.exchange(body.expansion_of_sites);
}

bool expands(const Body& body, std::size_t block) {
  if (body.blocks[block].material.thermal_expansion == 0) return false;
  return std::ranges::any_of(body.heated, [&](const HeatedPoints& heated) {
    return std::ranges::any_of(heated.points,
                               [&](int i) { return static_cast<std::size_t>(body.domain.cloud.blocks[i]) == block; });
  });
}

}  // namespace strut

#include "mechanics/formulation/quadratic_fits.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "mechanics/formulation/cell_fit.hpp"
#include "mechanics/kernels/quadratic_bonds.hpp"
#include "topology/parallel_for.hpp"

namespace strut {

bool spans_cell(const Domain& domain, int i) {
  const double volume = family_volume(domain, i), h = domain.cloud.spacings[i];
  return volume > 0 && least_square(family_spread(domain, i) / (volume * h * h)) >= least_for_stress;
}

namespace {

// The least penalty of a cell whose metal has flowed, in a member so many spacings thick (quadratic.md, flow) by
// thickness_of_family(): 2.0 and 2.8 in round bars of two and three spacings, 2.3 in a square one of two.
double penalty_in_flow(double thickness) { return 0.025 * std::clamp(1 + 2.2 * (2.75 - thickness), 1.0, 2.0); }

void set_sums(const Body& body, int i, const Eigen::Array4d* multipliers, QuadraticFit& fit) {
  bonds::with_influence(body.influence, [&](auto weight) {
    bonds::set_sums(bonds::OfPoint{{i}, body.domain.families}, body.domain.sites.data(), multipliers, weight, fit);
  });
}

double steepness_of(const Body& body, int i, const Eigen::Array4d* multipliers, const QuadraticFit& fit) {
  const double volume = body.domain.volume(i);
  double sum = 0;
  for (int p = 0; p < 4; ++p) {
    Vector own = Vector::Zero();
    over_family(body, i, [&](int j, double w, const Vector& xi) {
      const Vector g = weight_of_bond(fit, volume, w, xi, multipliers[j], place_of(fit, p));
      sum += g.squaredNorm() / body.domain.volume(j);
      own -= g;
    });
    sum += own.squaredNorm() / volume;
  }
  return sum / 4;
}

// Four standard deviations of the family's material in its thinnest direction, in spacings: the diameter of a round
// bar, up to the reach of a family.
double thickness_of_family(const Body& body, int i) {
  const double h = body.domain.cloud.spacings[i];
  double volume = 0;
  Vector first = Vector::Zero();
  Tensor second = Tensor::Zero();
  const auto take = [&](double v, const Vector& xi) {
    volume += v;
    first += v * xi;
    second += v * xi * xi.transpose() + v * to_tensor(cube_of(v).moments);
  };
  take(body.domain.volume(i), Vector::Zero());
  over_family(body, i, [&](int j, double, const Vector& xi) { take(body.domain.volume(j), xi); });
  return 4 * std::sqrt(least_square(second / volume - first * first.transpose() / (volume * volume))) / h;
}

// The largest thickness in the family of each owned point of a body with cells, in spacings: a point at a surface sees
// only two layers even in a thick body.
std::vector<double> thicknesses(const Body& body) {
  std::set<int> with_cells;
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    if (body.blocks[b].is_quadratic()) with_cells.insert(body.domain.blocks[b].body);
  }
  std::vector<double> own(body.domain.sites.size(), 0.0);
  for_each_point(0, body.owned(), [&](int i) {
    if (with_cells.contains(body.domain.body_of(i))) own[i] = thickness_of_family(body, i);
  });
  body.domain.halo.exchange(own);
  std::vector<double> largest(own.begin(), own.begin() + body.owned());
  for_each_point(0, body.owned(), [&](int i) {
    body.domain.families.for_each(i, [&](int j) { largest[i] = std::max(largest[i], own[j]); });
  });
  return largest;
}

}  // namespace

QuadraticFits::QuadraticFits(const Body& body)
    : number_(body.owned(), -1), multipliers_(body.domain.sites.size(), Eigen::Array4d::Zero()) {
  const std::vector<double> thickness = thicknesses(body);
  penalties_in_flow_.assign(body.owned(), least_penalty);
  std::size_t cells = 0;
  for (const MaterialBlock& block : body.blocks) {
    if (!block.is_quadratic()) continue;
    for (std::size_t k = 0; k < block.points.size(); ++k) {
      number_[block.points[k]] = static_cast<int>(cells + block.slot_of_cell(k));
    }
    cells += block.integration_points() / block.points_per_cell();
  }
  fits_.assign(cells, std::array<double, QuadraticFit::size>{});
  for (const MaterialBlock& block : body.blocks) {
    if (!block.is_quadratic()) continue;
    for (const int i : block.points) {
      penalties_in_flow_[i] = penalty_in_flow(thickness[i]);
      QuadraticFit fit;
      set_cell(shape_of(body, i), fit);
      if (fit_motion(body, i, least_penalty, fit)) {
        fit.steepness = 1;
      } else {
        fit = QuadraticFit{};  // carries no stress and moves with the others
      }
      set(i, fit);
    }
  }
  set_sums_of_all(body);
}

template <class Set>
void QuadraticFits::change_all(const Set& set_numbers) {
  for_each_point(0, static_cast<int>(number_.size()), [&](int i) {
    if (number_[i] < 0 || !carries_stress(i)) return;
    QuadraticFit fit = (*this)[i];
    set_numbers(i, fit);
    set(i, fit);
  });
}

void QuadraticFits::set_sums_of_all(const Body& body) {
  change_all([&](int i, QuadraticFit& fit) { set_sums(body, i, multipliers(), fit); });
}

void QuadraticFits::complete(const Body& body) {
  set_sums_of_all(body);
  change_all([&](int i, QuadraticFit& fit) { fit.steepness = steepness_of(body, i, multipliers(), fit); });
}

bool QuadraticFits::refit(const Body& body, int i, bool flows, double most) {
  QuadraticFit fresh;
  set_cell(shape_of(body, i), fresh);
  bool spans = fit_motion(body, i, flows ? penalties_in_flow_[i] : least_penalty, fresh);
  if (spans) {
    add_correction(trend(body, i, multipliers(), inverse_moments(body, i)), body.domain.volume(i), fresh);
    set_sums(body, i, multipliers(), fresh);
    fresh.steepness = steepness_of(body, i, multipliers(), fresh);
    spans = body.domain.volume(i) * fresh.steepness <= most;
  }
  if (spans) set(i, fresh);
  return spans;
}

void QuadraticFits::refit_in_flow(const Body& body, int i) {
  refit(body, i, true, std::numeric_limits<double>::infinity());
}

void QuadraticFits::for_each_weight(const Body& body, int i, int q,
                                    const std::function<void(int j, const Vector& g)>& visit) const {
  const QuadraticFit& fit = (*this)[i];
  const Vector at = place_of(fit, q);
  over_family(body, i, [&](int j, double w, const Vector& xi) {
    visit(j, weight_of_bond(fit, body.domain.volume(i), w, xi, multipliers_[j], at));
  });
}

Tensor QuadraticFits::gradient_at(const Body& body, int i, int q, const std::function<Vector(int j)>& position) const {
  const Vector here = position(i);
  Tensor F = Tensor::Zero();
  for_each_weight(body, i, q, [&](int j, const Vector& g) { F += (position(j) - here) * g.transpose(); });
  return F;
}

double QuadraticFits::bytes() const {
  const std::size_t numbers = penalties_in_flow_.size() * sizeof(double) + number_.size() * sizeof(int);
  return static_cast<double>(numbers + multipliers_.size() * sizeof(Eigen::Array4d)) + fits_.bytes();
}

namespace {

bool has_flowed(const MaterialBlock& block, int k) {
  const auto at_any_place = [&]<class L>(const L& law) {
    bool any = false;
    if constexpr (materials::tells_flow<L>) {
      for (int q = 0; q < 4 && !any; ++q) any = law.has_flowed(block.state_of<L>(block.index(k, q)));
    }
    return any;
  };
  return std::visit(at_any_place, block.material.law);
}

// True if the pressure of a metal's cell is so large beside its flow stress that it is confined: in bending it is 0.33
// of it, in plane strain 0.58; in uniaxial strain 1.08 at a Poisson's ratio of 0.3, and grows without limit.
bool is_confined(const MaterialBlock& block, int k) {
  if (std::visit([]<class L>(const L&) { return materials::opens_cracks<L>; }, block.material.law)) return false;
  constexpr double most = 0.8;
  Symmetric mean = Symmetric::Zero();
  double flow_stress = 0;
  for (int q = 0; q < 4; ++q) {
    const Symmetric stress = block.cells[block.index(k, q)].stress;
    mean += 0.25 * stress, flow_stress = std::max(flow_stress, von_mises(stress));
  }
  return std::abs(trace(mean)) / 3 > most * flow_stress;
}

}  // namespace

bool begin_flow(Body& body, MaterialBlock& block, int k) {
  const int i = block.points[k];
  if (block.flowed[k] || !body.fits->carries_stress(i) || !has_flowed(block, k)) return false;
  const bool is_corrected = !body.domain.cloud.shapes.empty();  // by μ, which takes known surfaces
  block.flowed[k] = is_corrected && is_confined(block, k) ? 2 : 1;
  if (block.flowed[k] == 2) return true;
  body.fits->refit_in_flow(body, i);
  for (int q = 0; q < 4; ++q) {
    const std::size_t index = block.index(k, q);
    MaterialPoint point = block.cells[index];
    point.deformation_gradient = body.fits->gradient_at(body, i, q, [&](int j) { return body.domain.current(j); });
    point.rotation = Rotation(polar_rotation(point.deformation_gradient));
    block.cells->set(index, point);
  }
  return true;
}

bool begin_flow(Body& body) {
  bool any = false;
  for (MaterialBlock& block : body.blocks) {
    for (int k = 0; k < std::ssize(block.flowed); ++k) any = begin_flow(body, block, k) || any;
  }
  return any;
}

void refit_flowed(Body& body) {
  for (const MaterialBlock& block : body.blocks) {
    for_each_point(0, static_cast<int>(block.flowed.size()), [&](int k) {
      const int i = block.points[k];
      if (block.flowed[k] == 1 && body.fits->carries_stress(i)) body.fits->refit_in_flow(body, i);
    });
  }
}

}  // namespace strut

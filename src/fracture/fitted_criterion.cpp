#include "fracture/fitted_criterion.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <variant>

#include "topology/parallel_for.hpp"

namespace strut {

namespace {

// Added to the moments of a family about its center, in spacings squared: a family in a plane has no slope across it.
constexpr double least_moment = 0.05;

bool is_read(const MaterialBlock& block) {
  const auto& damage = block.material.damage;
  return block.is_quadratic() && damage && damage->ductility &&
         !std::holds_alternative<materials::FailureStrain>(damage->ductility->criterion);
}

Symmetric stress_at(const MaterialBlock& block, std::size_t index) {
  Symmetric stress;
  for (int c = 0; c < 6; ++c) stress[c] = block.cells->at(index, CellPoints::stress + c);
  return stress;
}

double growth(const MaterialBlock& block, const Symmetric& stress, double rate, double temperature) {
  return std::visit([&](const auto& criterion) { return criterion.growth(stress, rate, temperature); },
                    block.material.damage->ductility->criterion);
}

}  // namespace

int state_column(const MaterialBlock& block, std::string_view name) {
  const auto column = [&]<class L>(const L&) {
    const auto& names = L::state_names;
    const auto at = std::find(names.begin(), names.end(), name);
    return at == names.end() ? -1 : static_cast<int>(at - names.begin());
  };
  return std::visit(column, block.material.law);
}

FittedCriterion::FittedCriterion(Body& body) {
  for (std::size_t b = 0; b < body.blocks.size(); ++b) {
    const MaterialBlock& block = body.blocks[b];
    if (!is_read(block)) continue;
    blocks_.push_back({b, state_column(block, "Failure_Indicator"), state_column(block, "Equivalent_Plastic_Strain"),
                       state_column(block, "Equivalent_Plastic_Strain_Rate"), state_column(block, "Temperature")});
  }
  if (blocks_.empty()) return;
  takes_part_.assign(body.domain.sites.size(), 0);
  for (const OfBlock& one : blocks_) {
    for (const int i : body.blocks[one.block].points) takes_part_[i] = 1;
  }
  body.domain.halo.exchange(takes_part_);
}

void FittedCriterion::start(const Body& body) {
  for (OfBlock& one : blocks_) {
    const MaterialBlock& block = body.blocks[one.block];
    one.indicators.resize(block.integration_points());
    one.strains.resize(block.integration_points());
    for_each_point(0, static_cast<int>(one.strains.size()), [&](int index) {
      one.indicators[index] = block.state->at(index, one.indicator);
      one.strains[index] = block.state->at(index, one.strain);
    });
  }
}

std::vector<double> FittedCriterion::mean_stresses(const Body& body) const {
  std::vector<double> means(body.domain.sites.size(), 0);
  for (const OfBlock& one : blocks_) {
    const MaterialBlock& block = body.blocks[one.block];
    for_each_point(0, static_cast<int>(block.points.size()), [&](int k) {
      for (int q = 0; q < 4; ++q) means[block.points[k]] += trace(stress_at(block, block.index(k, q))) / 12;
    });
  }
  body.domain.halo.exchange(means);
  return means;
}

// The value at point i of the plane through the means of its family.
double FittedCriterion::fitted(const Body& body, const std::vector<double>& means, int i) const {
  const Domain& domain = body.domain;
  double volume = 0, sum = 0;
  Vector first = Vector::Zero(), slope = Vector::Zero();
  Tensor moments = Tensor::Zero();
  const auto add = [&](int j) {
    if (takes_part_[j] == 0) return;
    const double V = domain.volume(j);
    const Vector xi = domain.reference(j) - domain.reference(i);
    volume += V, sum += V * means[j];
    first += V * xi, slope += V * means[j] * xi, moments += V * xi * xi.transpose();
  };
  add(i);
  domain.families.for_each(i, add);
  const Vector center = first / volume;
  const double spacing = domain.blocks[domain.cloud.blocks[i]].spacing;
  moments = moments / volume - center * center.transpose() + least_moment * spacing * spacing * Tensor::Identity();
  slope = slope / volume - center * (sum / volume);
  return sum / volume - center.dot(moments.inverse() * slope);
}

void FittedCriterion::finish(Body& body) const {
  if (blocks_.empty()) return;
  const std::vector<double> means = mean_stresses(body);
  for (const OfBlock& one : blocks_) {
    MaterialBlock& block = body.blocks[one.block];
    for_each_point(0, static_cast<int>(block.points.size()), [&](int k) {
      const auto grows = [&](int q) {
        const std::size_t index = block.index(k, q);
        return one.indicators[index] < 1 && block.state->at(index, one.strain) > one.strains[index];
      };
      if (!grows(0) && !grows(1) && !grows(2) && !grows(3)) return;
      const double change = fitted(body, means, block.points[k]) - means[block.points[k]];
      for (int q = 0; q < 4; ++q) {
        if (!grows(q)) continue;
        const std::size_t index = block.index(k, q);
        Symmetric stress = stress_at(block, index);
        for (int c = 0; c < 3; ++c) stress[c] += change;
        const double temperature = one.temperature < 0 ? 0 : block.state->at(index, one.temperature);
        block.state->at(index, one.indicator) =
            one.indicators[index] + (block.state->at(index, one.strain) - one.strains[index]) *
                                        growth(block, stress, block.state->at(index, one.rate), temperature);
      }
    });
  }
}

double FittedCriterion::bytes() const {
  double numbers = 0;
  for (const OfBlock& one : blocks_) numbers += static_cast<double>(one.indicators.size() + one.strains.size());
  return 8 * numbers + static_cast<double>(takes_part_.size());
}

}  // namespace strut

#include "fracture/bond_release.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/kernels/over_family.hpp"
#include "topology/parallel_for.hpp"

namespace strut {

namespace {

// Calls visit(ω V_j, ξ) for the bonds that point i had at the start.
template <class Visit>
void over_first_family(const Body& body, int i, const Visit& visit) {
  const Domain& domain = body.domain;
  over_family(body, i, [&](int, double w, const Vector& xi) { visit(w, xi); });
  bonds::with_influence(body.influence, [&]<class Weight>(Weight) {
    for (const int j : domain.families.broken[i]) {
      const Vector xi = domain.reference(j) - domain.reference(i);
      const double mean = 0.5 * (domain.horizon(i) + domain.horizon(j));
      visit(Weight::of(xi.norm() / mean) * domain.volume(j), xi);
    }
  });
}

Tensor piola_kirchhoff_stress(const MaterialPoint& point) {
  const Tensor &F = point.deformation_gradient, R = point.rotation.tensor();
  return F.determinant() * R * to_tensor(point.stress) * R.transpose() * F.inverse().transpose();
}

// A bond at its end i.
struct End {
  const Body& body;
  const MaterialBlock& block;
  int i, j;
  double w;        // ω V_j
  Vector xi, eta;  // ξ, η
};

// Energy of the springs that the bond has with its end, J: half of one on both ends' gradients.
double energy_of_springs(const End& end, const Vector& residual, double leverage) {
  const double volume = end.body.domain.volume(end.i);
  const double own = end.block.own_springs_of(end.body.points[end.i]);
  if (own > 0) return 0.5 * volume * end.w * own * residual.squaredNorm() / (1 - leverage);
  if (!end.block.has_springs(ResidualKind::both_gradients)) return 0;
  const GradientState &here = end.body.force_states.gradients[end.i], &there = end.body.force_states.gradients[end.j];
  Vector z = end.eta;
  for (int c = 0; c < 3; ++c) {
    z -= 0.5 * end.xi[c] * (here.column[c] + there.column[c]).head<3>().matrix();
  }
  return 0.5 * volume * end.w * std::min(here.stiffness(), there.stiffness()) * z.squaredNorm();
}

}  // namespace

bool BondReleases::decide(const MaterialBlock& block) {
  const auto& damage = block.material.damage;
  return damage && damage->fracture_energy > 0 && damage->critical_stretch &&
         block.material.formulation == Formulation::correspondence;
}

BondReleases::BondReleases(const Body& body) {
  if (std::any_of(body.blocks.begin(), body.blocks.end(), decide)) records_.resize(body.domain.sites.size());
}

// Keeps the bonds with the largest excess.
void BondReleases::add(Record& record, const Bond& bond) {
  const auto less = [](const Bond& a, const Bond& b) { return a.excess < b.excess; };
  if (record.count < Record::most) {
    record.bonds[record.count++] = bond;
    return;
  }
  Bond* least = std::min_element(record.bonds, record.bonds + record.count, less);
  if (less(*least, bond)) *least = bond;
}

void BondReleases::examine(const Body& body, int i) {
  constexpr double least_part = 0.25;  // an end that releases less of its part does not let the bond break
  const MaterialBlock& block = body.block_of(i);
  Record& record = records_[i];
  record.count = 0;
  record.carries_stress = body.released[i] == 0;
  if (!record.carries_stress) return;
  const double critical = (*block.material.damage->critical_stretch)(0, 0, 0, 0);
  std::vector<End> stretched;
  over_family(body, i, [&](int j, double w, const Vector& xi) {
    const Vector eta = body.current(j) - body.current(i);
    const double limit = 1 + least_stretch * critical;
    if (eta.squaredNorm() > limit * limit * xi.squaredNorm()) stretched.push_back({body, block, i, j, w, xi, eta});
  });
  if (stretched.empty()) return;
  const auto at = std::lower_bound(block.points.begin(), block.points.end(), i);
  const int k = static_cast<int>(at - block.points.begin());
  const MaterialPoint& point = body.points[i];
  const Tensor P = piola_kirchhoff_stress(point), K_inverse = to_tensor(body.shape_inverse[i]),
               back = point.rotation.tensor().transpose();
  const auto [bulk, shear] = block.moduli(block.place(k, 0));
  const double volume = body.domain.volume(i), toughness = block.material.damage->fracture_energy;
  double weight = 0;
  over_first_family(body, i, [&weight](double w, const Vector&) { weight += w; });
  for (const End& end : stretched) {
    const double length = end.xi.norm();
    const Vector k_xi = K_inverse * end.xi, residual = end.eta - point.deformation_gradient * end.xi;
    const double leverage = end.w * end.xi.dot(k_xi);
    const Vector z = residual / (1 - leverage);
    const double springs = energy_of_springs(end, residual, leverage);
    const double stiff =
        (bulk + shear / 3) * std::pow(k_xi.dot(back * z), 2) + shear * k_xi.squaredNorm() * z.squaredNorm();
    const double released = springs + volume * end.w * ((P * k_xi).dot(z) - 0.5 * end.w * stiff);
    const double strain = ((point.deformation_gradient * end.xi).norm() / length - 1) / critical;
    const double of_strain = strain > 0 ? strain * strain : 0;
    const double part = 0.5 * toughness * volume * end.w / length;  // S f
    if (std::max(released, of_strain * 4 * part / weight) < least_part * 4 * part / weight) continue;
    const Vector opening = (back * end.eta - end.xi).normalized();
    double crossing = 0;  // f
    over_first_family(body, i,
                      [&](double w, const Vector& x) { crossing += 0.5 * w * std::abs(x.dot(opening)) / x.norm(); });
    const double share = part / crossing;
    add(record, {Images::original(body.domain.id(end.j)), length * length,
                 std::max(released, of_strain * share) - share, std::max(0.0, share - springs)});
  }
}

void BondReleases::take(const Body& body, const std::vector<char>& due) {
  for (const int i : filled_) records_[i].count = 0;
  filled_.clear();
  const ClusterLists& lists = body.domain.families.lists;
  for_each_point(0, static_cast<int>(due.size()), [&](int c) {
    if (!due[c]) return;
    for (const int i : lists[c].points) examine(body, i);
  });
  for (std::size_t c = 0; c < due.size(); ++c) {
    if (!due[c]) continue;
    for (const int i : lists[static_cast<int>(c)].points) {
      if (records_[i].count > 0) filled_.push_back(i);
    }
  }
  const bool were = any_filled_;
  any_filled_ = body.domain.communicator.max(filled_.empty() ? 0.0 : 1.0) > 0;
  if (were || any_filled_) body.domain.halo.exchange<unchanged>(records_);
}

const BondReleases::Bond* BondReleases::find(const Body& body, int i, int j) const {
  const Record& record = records_[i];
  const std::int64_t far = Images::original(body.domain.id(j));
  const double square = (body.domain.reference(j) - body.domain.reference(i)).squaredNorm();
  for (int n = 0; n < record.count; ++n) {
    const Bond& bond = record.bonds[n];
    if (bond.far == far && std::abs(bond.square - square) < 1e-6 * square) return &bond;
  }
  return nullptr;
}

bool BondReleases::breaks(const Body& body, int i, int j, bool own_counts, bool far_counts) const {
  double excess = 0;
  bool any = false;
  const auto take_end = [&](int here, int there) {
    if (!records_[here].carries_stress) return true;  // the other end decides
    const Bond* bond = find(body, here, there);
    if (bond != nullptr) excess += bond->excess, any = true;
    return bond != nullptr;
  };
  // The order of the terms must not depend on the rank.
  const bool first = body.domain.id(i) < body.domain.id(j);
  const bool both = first ? (!own_counts || take_end(i, j)) && (!far_counts || take_end(j, i))
                          : (!far_counts || take_end(j, i)) && (!own_counts || take_end(i, j));
  return both && any && excess >= 0;
}

double BondReleases::given_up(const Body& body, int i, int j) const {
  const Bond* bond = find(body, i, j);
  return bond == nullptr ? 0 : bond->gives;
}

}  // namespace strut

// Queries of the contact state between steps.
#include <algorithm>

#include "contact/contact.hpp"

namespace strut::contact {

double Contact::energy() const {
  double sum = 0;
  for (const ContactPair& contact_pair : contact_pairs_) sum += contact_pair.result.energy;
  return sum;
}

double Contact::energy_of_surfaces() const {
  double sum = 0;
  for (const ContactPair& pair : contact_pairs_) sum += pair.surfaces ? pair.result.energy : 0;
  return sum;
}

DeepestPenetration Contact::deepest() const {
  DeepestPenetration deepest;
  for (const ContactPair& contact_pair : contact_pairs_) deepest.take(contact_pair.result.deepest);
  return deepest;
}

namespace {

bool is_of(const BlockPair& blocks, int first, int second) {
  return (blocks.first == first && blocks.second == second) || (blocks.first == second && blocks.second == first);
}

}  // namespace

bool Contact::between(int first, int second) const {
  return std::any_of(contact_pairs_.begin(), contact_pairs_.end(),
                     [&](const ContactPair& c) { return is_of(c.blocks, first, second); });
}

bool Contact::by_surfaces(int first, int second) const {
  return std::any_of(contact_pairs_.begin(), contact_pairs_.end(),
                     [&](const ContactPair& c) { return c.surfaces && is_of(c.blocks, first, second); });
}

double Contact::overlap_at_start(int first, int second) const {
  double largest = 0;
  for (const ContactPair& c : contact_pairs_) {
    if (c.surfaces && is_of(c.blocks, first, second)) largest = std::max(largest, c.surfaces->overlap_at_start());
  }
  return largest;
}

void Contact::visit_normal_forces(const ContactPair& contact_pair,
                                  const std::function<void(std::size_t, Vector)>& visit) {
  if (contact_pair.surfaces) {
    contact_pair.surfaces->for_each_normal_force(contact_pair.pairs, visit);
  } else {
    for_each_normal_force(std::get<PairLaw>(contact_pair.model.law), contact_pair.pairs, visit);
  }
}

void Contact::add_where_touched(double amount, std::span<double> of_points) const {
  for (const ContactPair& contact_pair : contact_pairs_) {
    visit_normal_forces(contact_pair, [&](std::size_t k, const Vector& force) {
      if (!force.isZero(0)) of_points[contact_pair.pairs.owned[k]] += amount;
    });
  }
}

void Contact::mark_touching(std::span<std::uint8_t> marks) const {
  for (const ContactPair& pair : contact_pairs_) {
    if (pair.surfaces) {
      visit_normal_forces(pair, [&](std::size_t k, const Vector& force) {
        if (!force.isZero(0)) marks[pair.pairs.owned[k]] = 1;
      });
    } else {
      for (std::size_t k = 0; k < pair.loads.size(); ++k) {
        if (pair.loads[k].springs.trace() > 0 || pair.loads[k].contacts > 0) marks[pair.pairs.owned[k]] = 1;
      }
    }
  }
}

void Contact::mark_near(std::span<std::uint8_t> marks) const {
  for (const ContactPair& pair : contact_pairs_) {
    for (const int i : pair.pairs.owned) marks[i] = 1;
  }
}

void Contact::for_each_near(std::span<const int> numbers, const std::function<void(int, int, bool)>& visit) const {
  for (const ContactPair& contact_pair : contact_pairs_) {
    const Pairs& pairs = contact_pair.pairs;
    const double radius = radius_of(contact_pair.model.law);
    std::vector<int> of_sites(pairs.sites.size());
    for (std::size_t k = 0; k < pairs.owned.size(); ++k) of_sites[k] = numbers[pairs.owned[k]];
    if (pairs.halo) pairs.halo->exchange(of_sites);
    for (std::size_t k = 0; k < pairs.owned.size(); ++k) {
      const Site& here = pairs.sites[k];
      for (std::size_t p = pairs.start[k]; p < pairs.start[k + 1]; ++p) {
        const int partner = pairs.partners[p];
        const Site& there = pairs.sites[partner];
        const double apart = (there.reference - here.reference).head<3>().matrix().norm();
        const double now_apart = (there.current - here.current).head<3>().matrix().norm();
        if (now_apart > contact_pair.blocks.touching(radius, apart)) continue;
        visit(of_sites[k], of_sites[partner], !pairs.above.empty() && !pairs.above[partner].isZero(0));
      }
    }
  }
}

Vector Contact::force(const Domain& domain, int first, int second) const {
  Vector sum = Vector::Zero();
  for (const ContactPair& contact_pair : contact_pairs_) {
    if (!is_of(contact_pair.blocks, first, second)) continue;
    const Pairs& pairs = contact_pair.pairs;
    const auto counts = [&](std::size_t k) { return domain.cloud.blocks[pairs.owned[k]] == first; };
    visit_normal_forces(contact_pair, [&](std::size_t k, const Vector& force) {
      if (counts(k)) sum += force;
    });
    for (std::size_t k = 0; k < contact_pair.friction.size(); ++k) {
      if (counts(k)) sum += contact_pair.friction[k];
    }
  }
  return sum;
}

void Contact::add_mirror_reactions(const Domain& domain, std::vector<Vector>& of_mirrors) const {
  for (const ContactPair& pair : contact_pairs_) {
    pair.couples.add_mirror_reactions(domain, of_mirrors);
    if (domain.periods.empty()) continue;
    const Vector normal = pair.surfaces ? pair.surfaces->normal_force_through_sides(pair.pairs)
                                        : normal_force_through_sides(std::get<PairLaw>(pair.model.law), pair.pairs);
    const Vector sum = normal + pair.pairs.friction_through + pair.couples.through_sides(domain);
    for (std::size_t m = 0; m < domain.periods.size(); ++m) {
      const int axis = domain.periods[m].axis;
      of_mirrors[m][axis] += sum[axis];
    }
  }
}

FrictionWork Contact::friction_work(double impulse_time, std::span<const Vector> before,
                                    std::span<const Vector> after) const {
  FrictionWork work;
  const auto add = [&](int i, const Vector& force) {
    work.before += 0.5 * impulse_time * force.dot(before[i]);
    work.after += 0.5 * impulse_time * force.dot(after[i]);
  };
  for (const ContactPair& contact_pair : contact_pairs_) {
    for (std::size_t k = 0; k < contact_pair.friction.size(); ++k)
      add(contact_pair.pairs.owned[k], contact_pair.friction[k]);
    contact_pair.couples.for_each_force(add);
  }
  return work;
}

}  // namespace strut::contact

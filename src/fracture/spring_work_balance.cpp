#include "fracture/spring_work_balance.hpp"

#include "mechanics/kernels/bonds.hpp"

namespace strut {

namespace {

using Numbers = bonds::Vector3<double>;

// The far ends of one point, as a family for the sums over bonds.
struct OfFarEnds : bonds::NearPoint {
  std::span<const int> far;

  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const int j : far) visit(j, 1.0);
  }
};

Numbers numbers_of(const Vector& v) { return {{v[0], v[1], v[2]}}; }

}  // namespace

BondWorkBalance SpringWorkBalance::of(int i, std::span<const int> family) const {
  const Body& body = end.body;
  BondWorkBalance sums;
  const auto add = [&]<class S>(std::size_t kind, int j, double weight, const Vector& xi) {
    const double C = 2 * std::min(bonds::stiffness_of(kind, now[i].stiffness(), now[i].kind()),
                                  bonds::stiffness_of(kind, now[j].stiffness(), now[j].kind()));
    const Tensor F = 0.5 * (bonds::tensor_of(now[i]) + bonds::tensor_of(now[j]));
    const Vector z = end.place(j) - end.place(i) - F * xi;
    const Numbers force = S::bond_force(weight * C, numbers_of(z), numbers_of(xi));
    const Vector t(force.c[0], force.c[1], force.c[2]);
    const Vector moved = body.domain.current(j) - body.domain.current(i) - end.start[j] + end.start[i];
    const bool far_lost = body.force_states.tensors[j].lost_bonds() > 0;
    sums.energy += (far_lost ? 0.25 : 0.5) * z.dot(t);
    sums.work += 0.5 * t.dot(moved);
    if (!far_lost) sums.work += 0.5 * t.dot(moved - (bonds::tensor_of(finish[j]) - bonds::tensor_of(start[j])) * xi);
  };
  bonds::with_influence(body.influence, [&](auto omega) {
    bonds::over(OfFarEnds{{i}, family}, body.domain.sites.data(), omega,
                [&](int j, double weight, const Numbers& xi, double) {
                  for_each_bond_stabilization([&]<class S>(const S&, std::size_t kind) {
                    add.template operator()<S>(kind, j, weight, Vector(xi.c[0], xi.c[1], xi.c[2]));
                  });
                });
  });
  const double volume = body.domain.volume(i);
  return {volume * sums.energy, volume * sums.work};
}

}  // namespace strut

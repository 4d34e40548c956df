#include "fracture/fading_springs.hpp"

#include <algorithm>

#include "mechanics/kernels/bonds.hpp"
#include "topology/parallel_for.hpp"

namespace strut {

namespace {

// Energy that the springs of owned point i lose, J; half of that of a bond whose far end loses, too.
double lost(const StepEnd& end, const std::vector<GradientState>& start, int i) {
  const Body& body = end.body;
  const std::vector<GradientState>& finish = body.force_states.gradients;
  double sum = 0;
  const auto add = [&]<class S>(std::size_t kind, int j, double weight, const Vector& xi) {
    const auto stiffness = [&](const std::vector<GradientState>& at) {
      return 2 * std::min(bonds::stiffness_of(kind, at[i].stiffness(), at[i].kind()),
                          bonds::stiffness_of(kind, at[j].stiffness(), at[j].kind()));
    };
    const auto residual = [&](const std::vector<GradientState>& at, const Vector& eta) -> Vector {
      return eta - 0.5 * (bonds::tensor_of(at[i]) + bonds::tensor_of(at[j])) * xi;
    };
    const Vector z = residual(start, end.start[j] - end.start[i]),
                 after = residual(finish, body.domain.current(j) - body.domain.current(i));
    const bonds::Vector3<double> place{{z[0], z[1], z[2]}}, along{{xi[0], xi[1], xi[2]}};
    const auto force = S::bond_force(weight * (stiffness(start) - stiffness(finish)), place, along);
    const double part = finish[j].stiffness() < start[j].stiffness() ? 0.5 : 1;
    sum += part * 0.5 * Vector(force.c[0], force.c[1], force.c[2]).dot(after);
  };
  bonds::with_influence(body.influence, [&](auto omega) {
    bonds::over(bonds::OfPoint{{i}, body.domain.families}, body.domain.sites.data(), omega,
                [&](int j, double weight, const auto& xi, double) {
                  if (body.force_states.tensors[j].lost_bonds() > 0) return;
                  for_each_bond_stabilization([&]<class S>(const S&, std::size_t kind) {
                    add.template operator()<S>(kind, j, weight, Vector(xi.c[0], xi.c[1], xi.c[2]));
                  });
                });
  });
  return body.domain.volume(i) * sum;
}

}  // namespace

void count_fading(Body& body, const StepEnd& end, const std::vector<GradientState>& start) {
  if (start.size() != body.force_states.gradients.size()) return;  // no step has begun
  for (const MaterialBlock& block : body.blocks) {
    if (!springs_fade(block) || block.in_rigid_motion) continue;
    for_each_point(0, static_cast<int>(block.points.size()), [&](int k) {
      const int i = block.points[k];
      const bool fades = body.points[i].stabilization < start[i].stiffness();  // not for a step, as of a crushed point
      if (fades && !(body.force_states.tensors[i].lost_bonds() > 0)) body.fracture_energy[i] += lost(end, start, i);
    });
  }
}

}  // namespace strut

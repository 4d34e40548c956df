#include "integrators/ledger.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/body.hpp"

namespace strut {

void Ledger::balance(double held, double put_in, double& largest_so_far) {
  largest_so_far = std::max({largest_so_far, held, std::abs(put_in)});
  gained = held - put_in, largest = largest_so_far;
  balance_error = largest > 0 ? std::abs(gained) / largest : 0;
}

double energy_of_round_off(const Body& body) {
  constexpr double strain = 1e-12, of_quadratic = 1e-11;  // its canceling terms are larger
  double sum = 0;
  for (const MaterialBlock& block : body.blocks) {
    const double modulus = materials::moduli_of(block.material.law).longitudinal();
    const double squared = std::pow(block.is_quadratic() ? of_quadratic : strain, 2);
    for (const int i : block.points) sum += squared * modulus * body.domain.volume(i);
  }
  return 0.5 * body.domain.communicator.sum(sum);
}

}  // namespace strut

#include "setup/finite_value.hpp"

#include <cmath>

#include "base/errors.hpp"

namespace strut {

double finite_value(const Function& function, const Vector& X, double t) {
  const double value = function.evaluate(X[0], X[1], X[2], t);
  if (!std::isfinite(value)) throw Error(function.describe(X[0], X[1], X[2], t, value));
  return value;
}

}  // namespace strut

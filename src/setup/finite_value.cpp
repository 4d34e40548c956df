#include "setup/finite_value.hpp"

#include <cmath>
#include <sstream>

#include "base/errors.hpp"

namespace strut {

double finite_value(const Function& function, const Vector& X, double t) {
  const double value = function(X[0], X[1], X[2], t);
  if (std::isfinite(value)) return value;
  std::ostringstream text;
  text << "'" << function.text() << "' is " << value << " at (" << X[0] << ", " << X[1] << ", " << X[2]
       << ") m, t = " << t << " s; expected a number everywhere";
  throw Error(text.str());
}

}  // namespace strut

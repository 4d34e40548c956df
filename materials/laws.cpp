// Every law of the variant keeps the contract; a law that does not stops the build here.
#include "materials/laws.hpp"

namespace strut::materials {

template <class... Laws>
constexpr bool all_keep_the_contract(const std::variant<Laws...>*) {
  return (Law<Laws> && ...);
}
static_assert(all_keep_the_contract(static_cast<const AnyLaw*>(nullptr)));

}  // namespace strut::materials

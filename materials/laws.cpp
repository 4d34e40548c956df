// Checks at compile time that every law of the variant satisfies the interface; and selects the law of a metal that may
// fail.
#include "materials/laws.hpp"

namespace strut::materials {

template <class... Laws>
constexpr bool all_keep_the_contract(const std::variant<Laws...>*) {
  return (Law<Laws> && ...);
}
static_assert(all_keep_the_contract(static_cast<const AnyLaw*>(nullptr)));

Moduli moduli_of(const AnyLaw& law) {
  return std::visit([](const auto& one) -> Moduli { return one.moduli(); }, law);
}

std::optional<AnyLaw> failing(const AnyLaw& metal, const Ductility& ductility) {
  if (const auto* cold = std::get_if<J2>(&metal)) return Ductile{*cold, ductility};
  if (const auto* hot = std::get_if<ThermalJ2>(&metal)) return ThermalDuctile{*hot, ductility};
  return std::nullopt;
}

std::optional<AnyLaw> cracking(const AnyLaw& solid, double fracture_energy) {
  const auto* elastic = std::get_if<Elastic>(&solid);
  if (!elastic) return std::nullopt;
  return Brittle{.solid = *elastic, .fracture_energy = fracture_energy};
}

}  // namespace strut::materials

#include "deck/laws/constants.hpp"

#include "base/errors.hpp"

namespace strut::deck {

namespace {

const RealKey density({.name = "Density", .unit = "kg/m³", .range = positive, .meaning = "Reference density."});

using ElasticKey = OptionalKey<double>;
const char* const two = " Exactly two of the four are given.";
const ElasticKey bulk({.name = "Bulk Modulus", .unit = "Pa", .range = positive, .meaning = std::string("K.") + two});
const ElasticKey shear({.name = "Shear Modulus", .unit = "Pa", .range = positive, .meaning = std::string("G.") + two});
const ElasticKey young(
    {.name = "Young's Modulus", .unit = "Pa", .range = positive, .meaning = std::string("E.") + two});
const ElasticKey poisson({.name = "Poisson's Ratio",
                          .range = {-1, 0.5, false, false},
                          .meaning = std::string("ν.") + two});

// The names of the elastic keys for which `wanted` holds.
template <class Wanted>
std::vector<std::string> names_where(Wanted wanted) {
  std::vector<std::string> names;
  for (const ElasticKey* key : {&bulk, &shear, &young, &poisson}) {
    if (wanted(*key)) names.push_back(key->name);
  }
  return names;
}

// The moduli from two valid constants.
materials::Moduli moduli(const Values& material) {
  const bool has_bulk = material.has(bulk), has_shear = material.has(shear);
  const bool has_young = material.has(young), has_poisson = material.has(poisson);
  const double K = material[bulk].value_or(0), G = material[shear].value_or(0);
  const double E = material[young].value_or(0), nu = material[poisson].value_or(0);
  if (!has_young && !has_poisson) return {K, G};
  if (!has_bulk && !has_shear) return moduli_from(E, nu);
  if (!has_shear && !has_poisson) return {K, 3 * K * E / (9 * K - E)};
  if (!has_shear) return {K, 3 * K * (1 - 2 * nu) / (2 * (1 + nu))};
  if (!has_poisson) return {G * E / (3 * (3 * G - E)), G};
  return {2 * G * (1 + nu) / (3 * (1 - 2 * nu)), G};
}

}  // namespace

std::vector<Key> constants_keys() { return {density, bulk, shear, young, poisson}; }

double read_density(const Values& material) { return material[density]; }

materials::Moduli checked_moduli(const Values& material, Problems& problems) {
  const auto given = names_where([&](const Key& key) { return material.given(key); });
  if (given.size() != 2) {
    problems.add(material.path(), "elastic constants given: " + (given.empty() ? "none" : joined(given)) +
                                      "; expected exactly two of " +
                                      joined(names_where([](const Key&) { return true; })));
    return {};
  }
  if (names_where([&](const Key& key) { return material.has(key); }) != given) return {};  // already reported
  const materials::Moduli result = moduli(material);
  if (!(result.bulk > 0 && result.shear > 0)) {
    problems.add(material.path(), joined(given, " and ") +
                                      " contradict each other; expected such that bulk and shear "
                                      "modulus are > 0 (0 < E < 3 G, 0 < E < 9 K)");
  }
  return result;
}

materials::Moduli moduli_from(double E, double nu) { return {E / (3 * (1 - 2 * nu)), E / (2 * (1 + nu))}; }

}  // namespace strut::deck

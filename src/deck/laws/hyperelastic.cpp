#include <cmath>

#include "base/numbers.hpp"
#include "deck/laws/constants.hpp"
#include "deck/laws/laws.hpp"

namespace strut::deck {

namespace {

using materials::Hyperelastic;

const OptionalKey<double> c10({.name = "C10", .unit = "Pa", .meaning = "C₁₀ (Ī₁ − 3) of Mooney & Rivlin, with C01."});
const OptionalKey<double> c01({.name = "C01", .unit = "Pa", .meaning = "C₀₁ (Ī₂ − 3)."});
const OptionalKey<std::vector<double>> moduli(
    {.name = "Ogden Moduli", .unit = "Pa", .meaning = "μ_p, up to three: Σ μ_p/α_p (λ̄₁^α_p + λ̄₂^α_p + λ̄₃^α_p − 3)."});
const OptionalKey<std::vector<double>> exponents({.name = "Ogden Exponents", .meaning = "α_p, as many."});

const char* const relaxation_name = "Relaxation";
const RealsKey fractions({.name = "Fractions",
                          .range = positive,
                          .meaning = "γ_k of the shear modulus, up to four, that relax; less than 1 in all."});
const RealsKey times({.name = "Times", .unit = "s", .range = positive, .meaning = "t_k, as many."});

// Two lists of one length between 1 and `most`; else reports it.
bool are_as_many(const std::vector<double>& one, const std::vector<double>& other, std::size_t most,
                 const std::string& path, Problems& problems) {
  if (one.size() == other.size() && !one.empty() && one.size() <= most) return true;
  problems.add(path, std::to_string(one.size()) + " and " + std::to_string(other.size()) +
                         " numbers; expected as many in both lists, 1 to " + std::to_string(most));
  return false;
}

void set_terms(const Values& material, double shear, Hyperelastic& law, Problems& problems) {
  const bool rivlin = material.given(c10) || material.given(c01);
  const bool ogden = material.given(moduli) || material.given(exponents);
  if (rivlin && ogden) {
    problems.add(material.path(),
                 "'C10' or 'C01' and 'Ogden Moduli' or 'Ogden Exponents' are given; expected one form");
  } else if (rivlin) {
    law.terms = {{{2 * material[c10].value_or(0), 2}, {-2 * material[c01].value_or(0), -2}}};
  } else if (ogden) {
    const std::vector<double> of_terms = material[moduli].value_or(std::vector<double>());
    const std::vector<double> powers = material[exponents].value_or(std::vector<double>());
    if (!are_as_many(of_terms, powers, Hyperelastic::most_terms, material.path() + " > Ogden Moduli, Ogden Exponents",
                     problems))
      return;
    for (std::size_t p = 0; p < powers.size(); ++p) {
      law.terms[p] = {of_terms[p], powers[p]};
      if (powers[p] == 0) problems.add(material.path_to(exponents), "0; expected another exponent");
    }
  } else {
    law.terms = {{{shear, 2}}};
  }
  constexpr double as_given = 0.01;  // constants are printed with two or three digits
  if (std::abs(law.shear() - shear) <= as_given * shear) return;
  problems.add(material.path(), "the shear modulus of its elastic constants is " + to_text(shear) +
                                    " Pa, that of its strain energy " + to_text(law.shear()) +
                                    " Pa (2 (C10 + C01), or half of the sum of μ_p α_p); expected the same");
}

void set_times(const Values& section, Hyperelastic& law, Problems& problems) {
  if (!section.has(fractions) || !section.has(times)) return;
  const std::vector<double>&of_times = section[fractions], &all = section[times];
  if (!are_as_many(of_times, all, Hyperelastic::most_times, section.path(), problems)) return;
  for (std::size_t k = 0; k < all.size(); ++k) law.times[k] = {of_times[k], all[k]};
  if (!(law.kept() > 0)) {
    problems.add(section.path_to(fractions), "1 or more in all; expected less: the rest is what a held stress becomes");
  }
}

}  // namespace

Section hyperelastic_section() {
  return {.name = "Hyperelastic",
          .meaning =
              "Rubber and other elastomers: Ogden's strain energy, that of Mooney & Rivlin, or without their keys "
              "neo-Hooke's, and ½ K (J − 1)². The elastic constants are those of fast loading.",
          .keys = {c10, c01, moduli, exponents},
          .sections = {{.name = relaxation_name,
                        .meaning = "The change of shape relaxes by a Prony series.",
                        .keys = {fractions, times}}}};
}

materials::AnyLaw make_hyperelastic(const Values& material, Problems& problems) {
  const materials::Moduli elastic = checked_moduli(material, problems);
  Hyperelastic law{.bulk = elastic.bulk};
  set_terms(material, elastic.shear, law, problems);
  if (const Values* section = material.find_section(relaxation_name)) set_times(*section, law, problems);
  return law;
}

}  // namespace strut::deck

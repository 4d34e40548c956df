#include "deck/laws/constants.hpp"
#include "deck/laws/laws.hpp"

namespace strut::deck {

namespace {

using materials::LibraryInterface;
using materials::UserLaw;

const TextKey library({.name = "Library", .meaning = "The shared object, by its path from the deck's folder."});
const ChoiceKey<LibraryInterface> interface(
    {.name = "Interface",
     .fallback = "strut",
     .meaning = "Interface of the function: materials/strut_law.h, or a user subroutine of Abaqus. It is "
                "called in the unrotated frame: DROT is 1, DFGRD0 and DFGRD1 are stretches."},
    {{"strut", LibraryInterface::strut}, {"UMAT", LibraryInterface::umat}, {"VUMAT", LibraryInterface::vumat}});
const OptionalKey<std::string> function_name(
    {.name = "Function", .meaning = "Its name in the library; without it strut_law, umat_ or vumat_."});
const OptionalKey<std::vector<double>> constants({.name = "Constants", .meaning = "PROPS, in the law's own order."});
const IntegerKey states({.name = "State Variables",
                         .range = {.low = 0, .high = UserLaw::most_states},
                         .fallback = "0",
                         .meaning = "Their number, STATEV; all are 0 at the start. Output: User_State_1 and so on."});

const char* usual_name(LibraryInterface interface) {
  if (interface == LibraryInterface::umat) return "umat_";
  return interface == LibraryInterface::vumat ? "vumat_" : "strut_law";
}

}  // namespace

Section user_library_section() {
  return {.name = "User Library",
          .meaning =
              "A law from a shared object. The elastic constants are those of its undeformed state: they bound "
              "the time step.",
          .keys = {library, interface, function_name, constants, states}};
}

materials::AnyLaw make_user_library(const Values& material, Problems& problems) {
  const materials::Moduli moduli = checked_moduli(material, problems);
  UserLaw law{.bulk = moduli.bulk, .shear = moduli.shear, .density = read_density(material), .name = material.name()};
  law.constants = UserLaw::with_none_behind(material[constants].value_or(std::vector<double>()));
  law.states = material[states];
  law.function.interface = material[interface];
  law.function.file = material[library];
  law.function.name = material[function_name].value_or(usual_name(law.function.interface));
  return law;
}

}  // namespace strut::deck

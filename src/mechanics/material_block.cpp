#include "mechanics/material_block.hpp"

namespace strut {

materials::Moduli MaterialBlock::moduli(std::size_t place) const {
  return std::visit([&]<class L>(const L& law) { return materials::moduli_of(law, state_of<L>(place)); }, material.law);
}

template class FieldOf<small::Tiles>;
template class FieldOf<CellPoints>;
template class FieldOf<std::vector<OrdinaryPoint>>;
template class FieldOf<std::vector<ViscousPoint>>;

}  // namespace strut

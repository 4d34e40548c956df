#include "contact/search/pairs.hpp"

namespace strut::contact {

void bring_to_present(const Kinematics& kinematics, Pairs& pairs) {
  for (std::size_t k = 0; k < pairs.owned.size(); ++k)
    pairs.sites[k].current = kinematics.domain.sites[pairs.owned[k]].current;
  if (!pairs.halo) return;
  pairs.halo->set_stretch(kinematics.domain.halo.stretch());
  pairs.halo->exchange_places(pairs.sites);
}

}  // namespace strut::contact

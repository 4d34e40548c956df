#include "contact/search/pairs.hpp"

namespace strut::contact {

void bring_to_present(const Kinematics& kinematics, Pairs& pairs) {
  constexpr int site_stride = sizeof(Site) / sizeof(double);
  for (std::size_t k = 0; k < pairs.owned.size(); ++k)
    pairs.sites[k].current = kinematics.domain.sites[pairs.owned[k]].current;
  if (!pairs.halo) return;
  double* places = pairs.sites.empty() ? nullptr : pairs.sites.data()->current.data();
  pairs.halo->exchange(places, site_stride, 3);
}

}  // namespace strut::contact

#include "setup/undeclared_contact.hpp"

#include <algorithm>
#include <sstream>

namespace strut {

namespace {

bool may_be_bonded(const BlockHorizons& one, const BlockHorizons& other, double gap) {
  return one.body == other.body && gap <= 0.5 * (one.largest + other.largest);
}

bool declared(const std::vector<contact::Interaction>& interactions, int a, int b) {
  return std::any_of(interactions.begin(), interactions.end(), [&](const contact::Interaction& one) {
    return std::minmax(one.first, one.second) == std::minmax(a, b);
  });
}

}  // namespace

std::string undeclared_contacts(const Scene& scene, const std::vector<contact::Interaction>& interactions,
                                const std::vector<Trajectory>& all, double start, double duration) {
  const Domain& domain = scene.body.domain;
  std::ostringstream text;
  for (int a = 0; a < static_cast<int>(all.size()); ++a) {
    for (int b = a + 1; b < static_cast<int>(all.size()); ++b) {
      const double gap = all[a].places.exteriorDistance(all[b].places);
      if (declared(interactions, a, b) || may_be_bonded(domain.blocks[a], domain.blocks[b], gap)) continue;
      const auto time = meeting_time(all[a], all[b], duration);
      if (!time) continue;
      text << "WARNING: blocks " << domain.cloud.block_names[a] << " and " << domain.cloud.block_names[b]
           << " meet at about t = " << start + *time
           << " s and will pass through each other: no contact between them is "
           << "declared (Contact > Interactions)\n";
    }
  }
  return text.str();
}

}  // namespace strut

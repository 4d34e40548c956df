#include "conditions/velocity_update.hpp"

namespace strut {

void add_work(const VelocityUpdate& update, ImpulseWork& work) {
  for (const auto& [i, half_impulse, entry] : update.recorded) {
    work.before.*entry += half_impulse.dot(update.body.previous_velocity[i]);
    work.after.*entry += half_impulse.dot(update.body.velocity[i]);
  }
  work.before = work.before + update.of_tools.before;
  work.after = work.after + update.of_tools.after;
}

}  // namespace strut

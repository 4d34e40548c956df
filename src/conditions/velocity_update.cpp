#include "conditions/velocity_update.hpp"

namespace strut {

void add_work(const VelocityUpdate& update, ImpulseWork& work) {
  for (const auto& [i, half_impulse, entry] : update.recorded) {
    work.before.*entry += half_impulse.dot(update.body.previous_velocity[i]);
    work.after.*entry += half_impulse.dot(update.body.velocity[i]);
  }
}

}  // namespace strut

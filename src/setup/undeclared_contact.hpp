// Bodies that will run into each other though the deck declares no contact between them.
#pragma once

#include <string>
#include <vector>

#include "contact/contact.hpp"
#include "setup/scene.hpp"
#include "setup/trajectories.hpp"

namespace strut {

// A warning, a line each, for every two blocks without an interaction whose bounding boxes, moved on with
// the velocities of the start (initial and prescribed), overlap before `duration` (s) is over. Blocks that are bonded
// to each other are no such pair. A forecast: who is thrown at somebody later is not seen.
std::string undeclared_contacts(const Scene& scene, const std::vector<contact::Interaction>& interactions,
                                const std::vector<Trajectory>& trajectories, double start, double duration);

}  // namespace strut

// What a slip of units changes: how large and heavy the bodies are, how fast waves and the bodies themselves run.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// Collective. Lines for the start of a run: box and mass of the reference state; wave speed √((K + 4μ/3)/ρ), with the
// largest difference of speeds that the conditions give in the first moment as a part of it.
std::string outline(const Situation& situation);

// A warning for each block whose density, wave speed, or yield stress over Young's modulus no solid has; it names the
// units.
std::string improbable_materials(const Situation& situation);

// A warning for each block of a metal that begins molten, or so cold that its temperature may be in °C.
std::string improbable_temperatures(const Situation& situation);

// Collective. Warnings of a body that is improbably large or small, by itself or for the duration of the run, and
// of bodies that meet faster than waves run.
std::string improbable_scales(const Situation& situation);

// Collective. A line for each elastic block by correspondence of an explicit run in which speeds at the start are so
// far apart that its energy is not kept: by strains of some percent its rate form is off, and steps fall while it
// rings.
std::string large_elastic_strains(const Situation& situation);

}  // namespace strut

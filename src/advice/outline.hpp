// Numbers that show errors of units: size and mass of the bodies, speeds of waves and bodies.
#pragma once

#include <string>

#include "advice/situation.hpp"

namespace strut {

// Collective. Lines for the start of a run: box and mass of the reference state; wave speed √((K + 4μ/3)/ρ), and the
// largest difference of the speeds that conditions impose at the start, relative to it.
std::string outline(const Situation& situation);

// A warning for each block with a density, a wave speed, or a ratio of yield stress to Young's modulus that no solid
// has; it names the units.
std::string improbable_materials(const Situation& situation);

// A warning for each block of a metal that is initially molten, or so cold that its temperature may be in °C.
std::string improbable_temperatures(const Situation& situation);

// Collective. Warnings for a body that is improbably large or small, by itself or for the duration of the run, and for
// bodies that meet faster than waves travel.
std::string improbable_scales(const Situation& situation);

// Collective. A line for each elastic block by correspondence in an explicit run whose initial speeds differ so much
// that its energy will not be conserved: at strains of some percent its rate form is inaccurate, and the time step
// decreases while it vibrates.
std::string large_elastic_strains(const Situation& situation);

}  // namespace strut

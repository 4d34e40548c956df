// Public header of mechanics: forces, their linearization, frequency bounds and energies of a body.
#pragma once

#include "mechanics/energies.hpp"
#include "mechanics/frequency_bound.hpp"
#include "mechanics/internal_force.hpp"
#include "mechanics/tangent_operator.hpp"

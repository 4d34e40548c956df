// tests/reference/ritz --table > tests/reference/frequencies.hpp
// Exact frequencies of free vibration of bodies 4 times as long as thick, Poisson's ratio 0.3: README.md.
#pragma once

#include <array>

namespace strut::reference {

constexpr double frequencies_length = 4;  // thicknesses
constexpr double frequencies_poisson = 0.3;

// ω thickness/√(E/ρ): bending, bending, torsion, bending, bending, extension.
constexpr std::array<double, 6> square_frequencies = {0.339312, 0.339312, 0.447248, 0.755818, 0.755818, 0.781633};
constexpr std::array<double, 6> round_frequencies = {0.305563, 0.305563, 0.487083, 0.707865, 0.707865, 0.782605};

}  // namespace strut::reference

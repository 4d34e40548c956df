// What a slip of units changes: how large and heavy the bodies are, how fast waves and the bodies themselves run.
#pragma once

#include <string>
#include <vector>

#include "setup/scene.hpp"
#include "setup/trajectories.hpp"

namespace strut {

// Collective. Lines for the start of a run: box and mass of the reference state; wave speed √((K + 4μ/3)/ρ), with the
// largest difference of speeds that the conditions give in the first moment as a part of it. `duration`: of the run, s.
std::string outline(const Scene& scene, const std::vector<Trajectory>& trajectories, double start, double duration);

// A warning for each block whose density, wave speed, or yield stress over Young's modulus no solid has; it names the
// units.
std::string improbable_materials(const Body& body);

// Collective. A warning where the mass of points at nodes is not that of the mesh: a node that blocks of two densities
// share has the density of the first of them. `taken`: PointCloud::taken_volumes.
std::string mass_of_shared_nodes(const Body& body, const std::vector<double>& taken);

// A warning for each block of a metal that begins molten, or so cold that its temperature may be in °C.
std::string improbable_temperatures(const Body& body);

// Collective. Warnings of a body that is improbably large or small, by itself or for the duration of the run (s), and
// of bodies that meet faster than waves run.
std::string improbable_scales(const Scene& scene, const std::vector<Trajectory>& trajectories, double start,
                              double duration);

// Collective. A line for each elastic block by correspondence of an explicit run in which speeds at the start are so
// far apart that its energy is not kept: by strains of some percent its rate form is off, and steps fall while it
// rings.
std::string large_elastic_strains(const Scene& scene, const std::vector<Trajectory>& trajectories, double start,
                                  double duration);

}  // namespace strut

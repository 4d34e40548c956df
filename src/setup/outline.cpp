#include "setup/outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "points/bounding_box.hpp"

namespace strut {

namespace {

// From foams of a few kg/m³ to osmium; from soft foams to diamond, 18 km/s.
constexpr double least_density = 10, most_density = 30e3;         // kg/m³
constexpr double least_wave_speed = 100, most_wave_speed = 20e3;  // m/s

// Of longitudinal waves in the undeformed material, m/s.
double wave_speed(const BlockMaterial& material) {
  const double modulus = std::visit([](const auto& law) { return law.moduli().longitudinal(); }, material.law);
  return std::sqrt(modulus / material.density);
}

Eigen::AlignedBox3d box_of(const Body& body) {
  Eigen::AlignedBox3d box;
  for (int i = 0; i < body.owned(); ++i) box.extend(body.domain.reference(i));
  return common_box(box, body.domain.communicator);
}

double mass_of(const Body& body) {
  double mass = 0;
  for (int i = 0; i < body.owned(); ++i) mass += body.mass(i);
  return body.domain.communicator.sum(mass);
}

// How far apart the velocities of points and tools are, m/s.
double largest_difference(const Scene& scene, const std::vector<Trajectory>& trajectories, double start,
                          double duration) {
  const double moment = first_moment * duration;
  Eigen::AlignedBox3d velocities;
  for (const Trajectory& one : trajectories) velocities.extend(one.velocities);
  for (const RigidTool& tool : tools_of(scene.conditions))
    velocities.extend(Vector((tool.offset(start + moment) - tool.offset(start)) / moment));
  return velocities.isEmpty() ? 0 : velocities.diagonal().norm();
}

}  // namespace

std::string outline(const Scene& scene, const std::vector<Trajectory>& trajectories, double start, double duration) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const MaterialBlock& block : scene.body.blocks) {
    least = std::min(least, wave_speed(block.material));
    most = std::max(most, wave_speed(block.material));
  }
  const Vector size = box_of(scene.body).sizes();
  std::ostringstream text;
  text.precision(4);
  text << "between the outermost points " << size[0] << " x " << size[1] << " x " << size[2] << " m, mass "
       << mass_of(scene.body) << " kg; wave speed " << least;
  if (most > least) text << " to " << most;
  text << " m/s";
  const double difference = largest_difference(scene, trajectories, start, duration);
  if (difference > 0 && !scene.quasi_static)
    text << ", speeds up to " << difference << " m/s apart, " << difference / least << " of it";
  return text.str() + "\n";
}

std::string improbable_materials(const Body& body) {
  std::ostringstream text;
  text.precision(4);
  for (const MaterialBlock& block : body.blocks) {
    const double density = block.material.density, speed = wave_speed(block.material);
    if (!(density >= least_density && density <= most_density)) {
      text << "WARNING: block '" << block.name << "' has a density of " << density
           << " kg/m³; solids have 10 to 30,000: is Density in kg/m³ (2.7 g/cm³ are 2700)?\n";
    }
    if (!(speed >= least_wave_speed && speed <= most_wave_speed)) {
      text << "WARNING: block '" << block.name << "' has a wave speed of " << speed
           << " m/s; solids have 100 to 20,000: are moduli in Pa (70 GPa are 70e9) and the density in kg/m³?\n";
    }
  }
  return text.str();
}

}  // namespace strut

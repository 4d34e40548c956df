// What acts on points from outside: loads, prescribed motion, planes, tools, open ends; and the work that each does.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/math/function.hpp"
#include "conditions/reactions.hpp"
#include "conditions/tool.hpp"
#include "mechanics/body.hpp"

namespace strut {

// One component of the motion of some points.
struct PrescribedMotion {
  std::vector<int> points;
  int component;
  Function value;  // of the reference position and time: m, or m/s
  bool is_velocity;
  int condition = -1;  // its place in the deck
};

struct BodyForce {
  std::vector<int> points;
  int component;
  Function value;  // N/m³ of reference volume
};

// Points keep their distance to a plane.
struct SymmetryPlane {
  std::vector<int> points;
  Vector normal;       // of unit length
  int condition = -1;  // its place in the deck
};

// An end that waves leave as if the body went on behind it: the viscous traction −ρ c_p v_n − ρ c_s v_t (Lysmer &
// Kuhlemeyer 1969) on the layer of points that has the end's surface. The traction acts in the middle of the layer:
// what is beyond it, half of a layer of whole cells, is taken to belong to the other side, and its inertia is the other
// side's (README).
struct OpenEnd {
  struct Drag {
    int point;
    double along, across;  // traction over speed and mass of half a layer: 2 c_p/s and 2 c_s/s, s the spacing; 1/s
    double gain;           // mass of the point over that of half a layer
  };
  Vector normal;  // of unit length
  std::vector<Drag> drags;
};

struct Conditions {
  std::vector<BodyForce> body_forces;
  std::vector<OpenEnd> open_ends;
  std::vector<PrescribedMotion> motions;
  std::vector<SymmetryPlane> symmetry_planes;
  std::vector<Tool> tools;  // applied last: nothing enters a tool
};

// J done on this rank's points.
struct Work {
  double external = 0;  // by loads and prescribed motion
  double contact = 0;   // by tools and friction (negative: what a plastic impact takes)

  Work operator+(const Work& other) const { return {external + other.external, contact + other.contact}; }
};

// The work of an impulse p at a step is p · ½(v⁻ + v⁺), exactly what the kinetic energy of central differences gains.
// One half, ½ p · v⁻, belongs to the interval before the step, the other to the one after.
struct ImpulseWork {
  Work before, after;
};

// How long a point moves on before it is kicked again: the whole step, or a part of it where it is halved.
struct PointSteps {
  double whole;                                       // s
  const std::vector<std::uint8_t>* levels = nullptr;  // of owned points; none if null or empty

  int level(int i) const { return !levels || levels->empty() ? 0 : (*levels)[i]; }
  double of(int i) const { return level(i) == 0 ? whole : std::ldexp(whole, -level(i)); }
};

// Adds the body forces at time t (s) to the force density.
void add_body_forces(const Conditions& conditions, double t, Body& body);

// Puts the prescribed velocities at time t into the initial velocities, so that the first step needs no impulse.
void start_motions(const Conditions& conditions, double t, double dt, Body& body);

// Changes the velocities after the kick at time t, which carry each point on for its step, to what the conditions
// allow. Adds the impulses of motions, symmetry planes and tools to `impulses`.
void constrain(const Conditions& conditions, double t, const PointSteps& steps, Body& body, ImpulseWork& work,
               Impulses& impulses);

// The open end that these points are, by the moduli of their undeformed blocks.
OpenEnd open_end(const std::vector<int>& points, const Vector& normal, const Body& body);

// Of the points that are stepped alone, and halve their step `order` times or more. Without body forces: they act once
// a whole step.
Conditions restricted_to(const Conditions& conditions, const std::vector<std::uint8_t>& levels, int level);

// Adds the work of the body forces over a kick of length `kick`, once velocities are final.
void add_work_of_body_forces(const Conditions& conditions, double t, double update, const Body& body,
                             ImpulseWork& work);

}  // namespace strut

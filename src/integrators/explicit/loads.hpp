// The loads of explicit steps, with the times and the parts of impulses for which they act on points with substeps.
//
// A load acts in its points' own steps. If it acted once a whole step, the stress of stiff points would be too large by
// as many times as they have substeps. A load on whole bodies that move rigidly, such as the weight of one that falls,
// acts once a whole step, so that they stay undeformed to the last bit.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "base/archive.hpp"
#include "conditions/conditions.hpp"

namespace strut {

class Loads {
 public:
  explicit Loads(const Conditions& conditions);

  using Levels = std::vector<std::uint8_t>;  // time-step levels of the motion of the owned points; empty: all 0

  // Collective. The levels in the next whole step, and in the last one if they were others. `highest`: of all points.
  void take_levels(const Body& body, const std::optional<Levels>& before, const Levels& after, int highest);

  // The time of an impulse and the whole steps before and after it, s. At a time between whole steps both are the
  // present step.
  struct Moment {
    double time, before, after;
    double end = std::numeric_limits<double>::infinity();  // no load acts later
    int level = 0;
  };
  // Adds the force densities for the impulses of points that move at this moment. With substeps, loads that change with
  // time act with their mean over the points' own steps, from one sample a substep.
  void add(const Moment& moment, Body& body);
  // Adds the work of the loads last added, once velocities are final; `impulse_time`: that of force densities, s.
  void add_work(double impulse_time, const Body& body, ImpulseWork& work) const;
  // The impulse at a whole step is over: the next one has the same steps on both sides.
  void end_whole_step();

  // Collective. Saves or restores the steps before, where they were others.
  void serialize(Archive& archive, const Body& body);
  const std::optional<Levels>& levels_before() const { return before_; }

 private:
  struct Load {
    Conditions condition;
    bool is_on_wholes = false;                 // on all points of each body that it acts on
    std::vector<std::size_t> blocks = {};      // that it acts on, on any rank
    bool was_whole = false, is_whole = false;  // acts once a whole step, before and after the next impulse
  };
  struct Group {
    int before, after;  // levels of its points
    Conditions loads;
  };
  struct Impulse {
    const Conditions* loads;
    std::vector<double> times;  // s
    double part;                // of the impulse of force densities, at each of the times
  };
  Impulse impulse(const Group& group, const Moment& moment) const;

  void regroup();

  std::vector<Load> loads_;
  std::vector<Group> groups_;
  std::vector<Impulse> now_;
  std::optional<Levels> before_;
  Levels after_;
  int highest_ = 0;
  bool change_;
};

}  // namespace strut

// The forces of one load step that must vanish, as a function of the positions of the points, and their derivative. The
// result of a step is stored in a committed state; trials start from there and leave nothing behind.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>

#include "conditions/conditions.hpp"
#include "contact/contact.hpp"
#include "fracture/fracture.hpp"
#include "integrators/quasi_static/constraints.hpp"
#include "integrators/quasi_static/separate_parts.hpp"
#include "integrators/quasi_static/tool_contact.hpp"
#include "mechanics/formulation/tangent.hpp"
#include "mechanics/mechanics.hpp"

namespace strut {

// The imbalance of the forces of a trial, the same on all ranks: of all separate parts that are not balanced, or else
// of the one that is balanced worst.
struct Imbalance {
  double norm = 0;       // N, root of the sum of squares of the forces in free directions
  double scale = 0;      // N, the same for reactions, loads, expansion and contact: `norm` is compared with it
  double round_off = 0;  // N: `norm` of a balanced body without loads
  bool failed = false;   // a point inverted or its law found no stress; the numbers are then meaningless
};

// The bonds and cells that have given way between two equilibria, on all ranks.
struct GaveWay {
  std::int64_t bonds = 0;
  bool cells = false;  // softened

  bool any() const { return bonds > 0 || cells; }
};

struct Tolerance {
  double relative = 1e-6;    // residual forces over reactions, loads and contact
  int most_iterations = 20;  // of Newton
};

inline bool is_balanced(const Imbalance& now, const Tolerance& tolerance) {
  return !now.failed && now.norm <= std::max(tolerance.relative * now.scale, now.round_off);
}

// In place: arrays of Python are views of the values.
inline void put_back(const Field& force_density, Body& body) {
  std::ranges::copy(force_density, body.force_density.begin());
}

inline void move_by(Body& body, double factor, const Field& step) {
  for (int i = 0; i < body.owned(); ++i) body.domain.sites[i].current.head<3>() += factor * step[i].array();
}

class Equilibrium {
 public:
  // Collective. Computes the forces of the undeformed state. Throws Error if a condition needs inertia.
  Equilibrium(Body& body, Conditions conditions, contact::Contact contact, std::optional<Fracture> fracture = {},
              const Tolerance& tolerance = {});

  // Collective. For a body that begins strained, at the time t (s): the forces that would hold it in this state fade
  // over the first load step, and their work counts as that of loads.
  void begin_strained(double t);

  // Collective. Begins a load step from t over dt (s), at the committed positions. Throws Error if a value of a
  // condition is not finite.
  void begin(double t, double dt);

  // Collective; after commit(). Breaks the bonds that are beyond their limit and lets the stress of gradual cracks
  // fall, both at the same positions; trials do neither. If there are any, this begins a load step at constant
  // conditions, in which the lost forces fade from their full value to zero.
  GaveWay give_way();
  // Collective. The largest stretch of a bond over the one at which it breaks, in the last trial; 0 if none breaks.
  double largest_stretch() const { return breaks_ ? fracture_->largest_stretch(body_) : 0; }
  // Collective. The largest stress of a cell that softens over the strength that it has left, in the last trial.
  double largest_load() const;
  // J, of the last trial on this rank: work of the fading forces of broken bonds and softened cells; ≥ 0 if stable.
  double work_of_jump() const;

  // Moves all points from the committed positions, as the periodic sides move.
  void follow_sides();

  // Collective. Evaluates the forces at the present positions of body().domain.sites.
  Imbalance evaluate(bool with_diagnostics = false);
  // N, forces of the last trial in free directions; none in parts that are balanced and wait for others.
  const Field& residual() const { return residual_; }
  // Collective. A sentence with point, block and position where the last trial failed, or has the largest residual.
  // `last`: of that trial; if it is balanced, the point that a tool overlaps most is what hinders.
  std::string weakest_point(const Imbalance& last) const;

  // Collective. Sets the tangent at the last trial, for apply(): result = K field, N; held components included.
  void linearize();
  void apply(const Field& field, Field& result);
  const std::vector<PointTangent>& tangents() const { return tangents_; }

  // Collective. True if contact with tools needs another round of its multipliers; augment() makes the round.
  bool needs_round() const;
  void augment() { tools_.augment(); }

  // Collective. True if other points touch tools than at the last call.
  bool contact_has_changed();
  // The stiffness of contact for each point alone, N/m.
  std::vector<Tensor> contact_springs();

  // Collective; after commit(). Saves or restores the body and all else that the next step depends on.
  void serialize(Archive& archive);
  // Collective. The same without the body and its broken bonds; restores to where the body is.
  void serialize_search(Archive& archive);

  void commit();   // collective; the next step begins at the last trial
  void go_back();  // collective; to the committed state

  Body& body() { return body_; }
  const SeparateParts& parts() const { return parts_; }
  const Constraints& constraints() const { return *constraints_; }
  Vector start(int i) const { return committed_.position(i); }
  const contact::Contact& contact() const { return contact_; }
  contact::Contact take_contact() { return std::move(contact_); }
  std::optional<Fracture> take_fracture();
  const Conditions& conditions() const { return conditions_; }
  // Collective. For the last trial: work of loads and of holding conditions over the step, by the mean of the forces at
  // its ends, along arcs where held points turn, J on this rank.
  double external_work() const;
  double tool_work() const { return tools_.work(body_); }
  double friction_work() const;  // between bodies
  double missed_plastic_work() const { return strut::missed_plastic_work(body_, committed_); }
  // Collective. Upper bound of the work of errors in this load step, J: of forces by round-off, and of the residual
  // forces that a search leaves in a body that expands.
  double work_of_errors() const;
  // Collective. Reactions of the last trial for this number of conditions of the deck, N.
  Reactions reactions(int conditions) const;

 private:
  std::vector<Vector> step_displacement() const;  // displacement increment of the owned points in this load step, m
  // `time`: at the end of the step.
  StepReport advance(double dt, double time, bool with_diagnostics) {
    return advance_by_any_step(body_, dt, time, with_diagnostics, fracture_ ? &*fracture_ : nullptr);
  }
  bool may_break() const;
  void set_strengths(double factor);
  void check_values();
  std::vector<double> forces_of_expansion();
  void add_contact();
  void take_side_forces();
  void add_contact_through_sides();
  Imbalance measure(bool failed);
  std::vector<Imbalance> imbalances(const std::vector<double>& sums, bool failed);
  Imbalance worst_of(const std::vector<Imbalance>& of_parts);
  void begin_flow_of_cells();
  void serialize_of_pieces(Archive& archive, const std::string& name, std::vector<double>& of_pieces);
  void hold_at(double t);

  Body& body_;
  Conditions conditions_;
  contact::Contact contact_;
  std::optional<Fracture> fracture_;  // in trials no bond breaks, but springs lose stiffness with points that fail
  Tolerance tolerance_;
  SeparateParts parts_;
  ToolContact tools_;
  bool breaks_ = false;            // bonds break, and cells soften, between trials
  std::vector<double> strengths_;  // of gradual cracks by blocks, Pa; laws get none in trials, so damage does not grow
  Committed committed_;
  std::optional<Constraints> constraints_;
  double t_ = 0, dt_ = 0;
  // A force for each piece, N. The residual at the first trial of a step is the scale of a part that carries no load.
  std::vector<double> round_off_, last_scale_, largest_scale_, expansion_scale_, first_residual_;
  bool begins_ = false;  // no trial has been made since begin()
  std::optional<Failure> failure_;
  Field forces_, residual_;                     // N: all; those in free directions
  Field inner_;                                 // N, of the body alone
  Field forces_before_;                         // N, of the committed state
  Field outer_, outer_before_;                  // loads and reactions, N; at the start of the step
  Field left_;                                  // N: lost by bonds or cells at the start of the step; empty if none
  Field mirror_forces_, mirror_forces_before_;  // N, of domain.mirrors or periods on this rank's points
  std::vector<double> side_forces_;             // N, of pieces through each of domain.periods, on this rank's points
  std::vector<Vector> positions_of_contact_;    // positions at the last evaluation of contact, m
  std::vector<PointTangent> tangents_;
  std::vector<Site> directions_;
};

// Callbacks of an equilibrium search.
struct Observer {
  std::function<void(const std::string&)> load_steps;  // called with a line for each load step, on rank 0
  std::function<void(const std::string&)> iterations;  // called with a line for each iteration; may be empty
  std::function<bool()> stop_requested;                // true if the run must end: on any rank, at any time
};

struct EquilibriumSearch {
  bool converged = false;
  int iterations = 0;
  int evaluations = 0;  // of the forces, or of the tangent times a field
  Imbalance left;
  bool interrupted = false;
  int rounds = 1;  // of the multipliers of tools
};

}  // namespace strut

// The forces of one load step that must vanish, at any places of the points, and how they change with these. What a
// step has come to is kept in a committed state; trials start from there, so a trial leaves nothing behind.
#pragma once

#include <optional>
#include <string>

#include "conditions/conditions.hpp"
#include "contact/contact.hpp"
#include "fracture/fracture.hpp"
#include "integrators/quasi_static/constraints.hpp"
#include "integrators/quasi_static/tool_contact.hpp"
#include "mechanics/formulation/tangent.hpp"
#include "mechanics/mechanics.hpp"

namespace strut {

// How far the forces of a trial are from balance, the same on all ranks.
struct Imbalance {
  double norm = 0;       // N, root of the sum of squares of what is not held
  double scale = 0;      // N, the same of reactions, loads and contact: what `norm` is small against
  double round_off = 0;  // N: `norm` of a body in balance, where nothing acts
  bool failed = false;   // a point was turned inside out or found no stress; the numbers mean nothing then
};

class Equilibrium {
 public:
  // Collective. Computes the forces of the undeformed state. Throws Error for conditions that need inertia.
  Equilibrium(Body& body, Conditions conditions, contact::Contact contact, std::optional<Fracture> fracture = {});

  // Collective. A load step from t over dt (s) begins, at the committed places. Throws Error where a condition has no
  // number for it.
  void begin(double t, double dt);

  // Collective. Forces at the present places of body().domain.sites.
  Imbalance evaluate(bool with_diagnostics = false);
  const Field& residual() const { return residual_; }  // N, what is not held of the forces of the last trial
  // Where the last trial failed, or where its residual is largest: a sentence with point, block and place. Collective.
  std::string weakest_point() const;

  // Collective. The tangent at the last trial, for apply(): result = K field, N; held parts included.
  void linearize();
  void apply(const Field& field, Field& result);
  const std::vector<PointTangent>& tangents() const { return tangents_; }

  // Collective. Whether contact with tools needs another round of its multipliers; and the round.
  bool needs_round() const;
  void augment() { tools_.augment(); }

  // Collective. Whether other points touch tools than when this was asked last.
  bool contact_has_changed();
  // What contact adds to the stiffness of each point alone, N/m.
  std::vector<Tensor> contact_springs();

  // Collective; after commit(). The body, and all else that the next step depends on.
  void serialize(Archive& archive);

  void commit();   // collective; the last trial is where the next step begins
  void go_back();  // to the committed state

  Body& body() { return body_; }
  const Constraints& constraints() const { return *constraints_; }
  Vector start(int i) const { return committed_.place(i); }
  const contact::Contact& contact() const { return contact_; }
  const Conditions& conditions() const { return conditions_; }
  // Of the last trial: work of loads and of what holds points over the step, by the mean of the forces at its ends, J
  // on this rank.
  double external_work() const;
  double tool_work() const { return tools_.work(body_); }
  double friction_work() const;      // between bodies
  double work_of_round_off() const;  // collective; J, at most, of the forces that round-off leaves in this load step
  // Collective. Of the last trial, for so many conditions of the deck.
  Reactions reactions(int conditions) const;

 private:
  std::vector<Vector> step_way() const;  // of the owned points in this load step, m
  StepReport advance(double dt, bool with_diagnostics) {
    return advance_by_any_step(body_, dt, with_diagnostics, fracture_ ? &*fracture_ : nullptr);
  }
  void check_values();
  void add_contact();
  Imbalance measure(bool failed);
  void begin_flow_of_cells();

  Body& body_;
  Conditions conditions_;
  contact::Contact contact_;
  std::optional<Fracture> fracture_;  // no bond breaks, but springs go with the stress of points that fail
  ToolContact tools_;
  Committed committed_;
  std::optional<Constraints> constraints_;
  double t_ = 0, dt_ = 0, round_off_ = 0, last_scale_ = 0, largest_scale_ = 0;
  std::optional<Failure> failure_;
  Field forces_, residual_;                     // N: all; those that nothing holds
  Field inner_;                                 // N, of the body alone
  Field forces_before_;                         // N, of the committed state
  Field outer_, outer_before_;                  // loads and reactions, N; at the begin of the step
  Field mirror_forces_, mirror_forces_before_;  // N, of domain.mirrors on this rank's points
  std::vector<Vector> looked_at_;               // places that contact has last been asked about
  std::vector<PointTangent> tangents_;
  std::vector<Site> directions_;
};

}  // namespace strut

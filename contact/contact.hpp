// Public header of contact: between chosen blocks, and within them. It searches when points may have come near, adds
// the forces of those that touch, and says what this costs the step and the ledger.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/archive.hpp"
#include "contact/forces.hpp"
#include "contact/search/pairs.hpp"
#include "contact/search/skin_distances.hpp"
#include "contact/surfaces.hpp"

namespace strut::contact {

// Between the points of two blocks of the cloud, or within one.
struct Interaction {
  int first = 0, second = 0;
  Model model;
};

// Work of friction, J: the halves of an impulse's work before and after the step at which it acts.
struct FrictionWork {
  double before = 0, after = 0;
};

class Contact {
 public:
  Contact() = default;  // none: every call is free
  // Collective. Of bodies where they stand at first.
  Contact(const std::vector<Interaction>& interactions, const Domain& domain);

  bool any() const { return !contact_pairs_.empty(); }

  // Collective. Adds the forces of contact at the present places to force_density (N/m³). `dt`: of the step that led
  // here (s), 0 at the start.
  void add_forces(const Kinematics& kinematics, double dt, std::vector<Vector>& force_density);

  // Collective, after the forces at the start. What comes to touch in a first step of dt (s) by the velocities of
  // `kinematics` counts in stiffness().
  void foresee(const Kinematics& kinematics, double dt);

  // add_forces for a trial of an equilibrium: friction (of surfaces) starts where the last commit was; `way`: of the
  // owned points since then, m.
  void add_trial_forces(const Kinematics& kinematics, std::span<const Vector> way, std::vector<Vector>& force_density);
  // Before the last trial is committed: the work of friction since the last time, on this rank's points, J.
  double friction_work_of_trial(std::span<const Vector> way) const;
  void commit();

  // Collective, after add_forces. Adds the tangent stiffness of what touches, times a field of the owned points, to
  // result (N/m times the field's unit); of friction in trials.
  void add_stiffness(std::span<const Vector> field, std::span<Vector> result);
  void add_springs(std::span<Tensor> springs) const;  // what of it acts on a point by its own motion, N/m

  // Collective. What forces leave behind. Of a restored run, `kinematics` and `dt` are those of its last forces; pairs
  // are searched for anew, which does not change what they do.
  void serialize(Archive& archive, const Kinematics& kinematics, double dt);

  // What all ranks must agree on once a step. The solver takes the maximum of these numbers over all ranks together
  // with its own, and hands it back.
  void append_to_agree(const Kinematics& kinematics, std::vector<double>& numbers);
  void take_agreed(std::span<const double> numbers, double dt);

  double stiffness() const { return stiffness_; }  // a bound of ω² of all touching points, 1/s²; as last agreed
  double energy() const;                           // stored by this rank's points, J

  // Of the last forces: over all ranks, as last agreed, and of this rank's points.
  double penetration() const { return penetration_; }
  DeepestPenetration deepest() const;

  // Whether there is an interaction between two blocks, one of surfaces; of the last forces, what the block `first` of
  // this rank feels from all points of `second`, with friction, N.
  bool between(int first, int second) const;
  bool by_surfaces(int first, int second) const;
  Vector force(const Domain& domain, int first, int second) const;

  // Of the last forces of friction on this rank's points, over the time of an impulse (s) from the velocities `before`
  // to those `after`.
  FrictionWork friction_work(double impulse_time, std::span<const Vector> before, std::span<const Vector> after) const;

  // Adds `amount` to the number of each of this rank's points that felt a force, of surfaces or points, at the last
  // one.
  void add_where_touched(double amount, std::span<double> of_points) const;

  // Marks owned points that touch, or will in a step like the last one; by surfaces, those that feel a force.
  void mark_touching(std::span<std::uint8_t> marks) const;
  // Marks owned points that the last search has found near points of others.
  void mark_near(std::span<std::uint8_t> marks) const;

  int searches() const { return searches_; }  // so far, of all interactions

 private:
  // An interaction as it goes on: two blocks and the pairs of their points.
  struct ContactPair {
    Model model;
    BlockPair blocks;
    double skin = 0;                        // the usual skin distance of a point, m
    std::optional<Surfaces> surfaces = {};  // where the model is one of surfaces
    // As of the last search.
    Frame frame = {};
    std::vector<Vector> places = {};  // of blocks.points, m
    SkinDistances skins = {};
    Pairs pairs = {};
    Couples couples = {};  // of friction
    bool searched = false;
    std::vector<std::size_t> broken_counts = {};  // how many bonds of blocks.points had broken
    // As of the last look.
    Vector mean_velocity = Vector::Zero();  // m/s
    double used = 0;     // a bound of the part of its skin distance that any point has used since the last search
    bool meets = false;  // points whose bond has broken since are near each other
    bool due = true;     // that has come near 1
    ForceResult result = {};
    std::vector<Load> loads = {};       // of pairs.owned, where the model is one of points
    std::vector<Vector> friction = {};  // N, on pairs.owned
    // Its points that other contact pairs of points have, too: pairs.owned[k] is owned[there] of contact_pairs_[pair].
    struct Elsewhere {
      std::size_t k, pair, there;
    };
    std::vector<Elsewhere> elsewhere = {};
  };
  static void visit_normal_forces(const ContactPair& contact_pair,
                                  const std::function<void(std::size_t, Vector)>& visit);
  void search(const Kinematics& kinematics, double dt, ContactPair& contact_pair);
  static bool breaks_meet(const Kinematics& kinematics, const ContactPair& contact_pair);
  void look(const Kinematics& kinematics, double dt, ContactPair& contact_pair);
  // Collective.
  void look_where_due(const Kinematics& kinematics, double dt);
  void add_forces(const Kinematics& kinematics, double dt, const Sliding& sliding, std::vector<Vector>& force_density);
  static void add_normal_forces(const Kinematics& kinematics, double dt, ContactPair& contact_pair,
                                std::vector<Vector>& force_density);
  static void add_friction(const Kinematics& kinematics, double dt, const Sliding& sliding,
                           const std::vector<Load>& loads, ContactPair& contact_pair,
                           std::vector<Vector>& force_density);
  void find_points_of_several();
  std::vector<Load> loads_of_all(const Domain& domain, const ContactPair& contact_pair) const;
  std::vector<Load> joined_loads(const Domain& domain, ContactPair& contact_pair) const;

  std::vector<ContactPair> contact_pairs_;
  // How many bonds of each owned point had broken when ranks last agreed. Points whose bond breaks in a step touch
  // from the next step on, although a search may be due in the step itself, which round-off and so the ranks decide.
  BrokenCounts broken_before_;
  double stiffness_ = 0, penetration_ = 0;
  int searches_ = 0;
};

}  // namespace strut::contact

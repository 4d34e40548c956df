// Public header of contact between and within chosen blocks. It searches for pairs when points may have approached,
// adds the forces of touching points, and reports their stiffness (for the time step) and energy (for the ledger).
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/archive.hpp"
#include "contact/breaks.hpp"
#include "contact/forces.hpp"
#include "contact/search/pairs.hpp"
#include "contact/search/skin_distances.hpp"
#include "contact/surfaces.hpp"

namespace strut::contact {

// Contact between the points of two blocks of the cloud, or within one block.
struct Interaction {
  int first = 0, second = 0;
  Model model;
};

// Work of friction, J: half of the impulse times the velocity before it, and half of it times the velocity after it.
struct FrictionWork {
  double before = 0, after = 0;
};

class Contact {
 public:
  Contact() = default;  // no contact: every call returns at once
  // Collective. The bodies must be at their initial positions.
  Contact(const std::vector<Interaction>& interactions, const Domain& domain);

  bool any() const { return !contact_pairs_.empty(); }

  // Collective. Adds the contact forces at the present positions to force_density (N/m³). `dt`: length of the step that
  // led here (s), 0 at the start.
  void add_forces(const Kinematics& kinematics, double dt, std::vector<Vector>& force_density);

  // Collective; after add_forces at the start. Raises stiffness() by the pairs of points (not by surfaces) that would
  // touch within a first step of dt (s) at the velocities of `kinematics`.
  void foresee(const Kinematics& kinematics, double dt);

  // add_forces for a trial of an equilibrium: friction (of surfaces) starts from the last commit; `increments`:
  // displacements of the owned points since that commit, m.
  void add_trial_forces(const Kinematics& kinematics, std::span<const Vector> increments,
                        std::vector<Vector>& force_density);
  // Call it before the last trial is committed: work of friction since the last commit on this rank's points, J.
  double friction_work_of_trial(std::span<const Vector> increments) const;
  void commit();

  // Collective, after add_forces. Adds the tangent stiffness of touching points, times a field of the owned points, to
  // result (N/m times the field's unit), with the friction of trials.
  void add_stiffness(std::span<const Vector> field, std::span<Vector> result);
  // Adds the diagonal blocks of that tangent: the force on each point by its own displacement, N/m.
  void add_springs(std::span<Tensor> springs) const;

  // Collective. Saves or restores the state that forces depend on. On restoring, `kinematics` and `dt` are those of the
  // last forces; pairs are searched for anew, which does not change their forces.
  void serialize(Archive& archive, const Kinematics& kinematics, double dt);

  // Numbers that all ranks must agree on once per step. The solver takes the maximum over all ranks, together with its
  // own numbers, and passes the result to take_agreed.
  void append_to_agree(const Kinematics& kinematics, std::vector<double>& numbers);
  void take_agreed(std::span<const double> numbers, double dt);

  double stiffness() const { return stiffness_; }  // a bound of ω² of all touching points, 1/s²; as last agreed
  double energy() const;                           // stored by this rank's points, J
  double energy_of_surfaces() const;               // of it, by interactions between surfaces, J

  // Deepest penetration at the last forces, over the touching distance of the pair (between surfaces: in spacings).
  double penetration() const { return penetration_; }  // over all ranks, as last agreed
  DeepestPenetration deepest() const;                  // of this rank's points

  // True if two blocks have an interaction, or one by surfaces.
  bool between(int first, int second) const;
  bool by_surfaces(int first, int second) const;
  // The largest overlap of the surfaces of two blocks at the start, of this rank's points, in spacings: contact takes
  // it for touching.
  double overlap_at_start(int first, int second) const;
  // The last force by block `second` on this rank's points of block `first`, with friction, N.
  Vector force(const Domain& domain, int first, int second) const;

  // Work of the last friction forces on this rank's points, for an impulse over `impulse_time` (s) that changes the
  // velocities from `before` to `after`.
  FrictionWork friction_work(double impulse_time, std::span<const Vector> before, std::span<const Vector> after) const;

  // Adds forces on this rank's points to `of_mirrors`, N. Its entries are those of domain.mirrors, which get the
  // couples of friction by mirror images; or those of domain.periods, which get all contact through the sides.
  void add_mirror_reactions(const Domain& domain, std::vector<Vector>& of_mirrors) const;

  // Adds `amount` to the entry of each of this rank's points, once for each contact pair whose last normal force on
  // it was not zero.
  void add_where_touched(double amount, std::span<double> of_points) const;

  // Collective, after add_forces. Calls visit(number of an owned point, that of another one, whether an image of it
  // through periodic sides is meant) for all points that may touch where they are; `numbers`: of the owned points.
  void for_each_near(std::span<const int> numbers, const std::function<void(int, int, bool)>& visit) const;
  // Marks owned points that touch, or will in a step like the last one; by surfaces, those with a contact force.
  void mark_touching(std::span<std::uint8_t> marks) const;
  // Marks owned points that the last search found near other points.
  void mark_near(std::span<std::uint8_t> marks) const;

  int searches() const { return searches_; }  // so far, over all interactions

 private:
  // The state of an interaction: two blocks and the pairs of their points.
  struct ContactPair {
    Model model;
    BlockPair blocks;
    double skin = 0;                        // the usual skin distance of a point, m
    std::optional<Surfaces> surfaces = {};  // only if the model is one of surfaces
    // As of the last search.
    Frame frame = {};
    std::vector<Vector> places = {};  // positions of blocks.points, m
    SkinDistances skins = {};
    Pairs pairs = {};
    Couples couples = {};  // of friction
    bool searched = false;
    BrokenCounts broken_counts = {};        // numbers of broken bonds of blocks.points at the last search
    std::vector<PressedPair> pressed = {};  // of a checkpoint, for the next search
    // As of the last check of the skin distances.
    Vector mean_velocity = Vector::Zero();  // m/s
    double used = 0;     // in each step: bound of the fraction of a skin distance that a point has used since a search
    bool meets = false;  // in each step: points whose bonds have broken since the search are near each other
    bool check_pending = true;  // `used` is near 1: the skin distances must be checked in the next step
    ForceResult result = {};
    std::vector<Load> loads = {};       // of pairs.owned, if the model is one of points
    std::vector<Vector> friction = {};  // N, on pairs.owned
    // Points that are in another contact pair of points, too: pairs.owned[k] is pairs.owned[there] of
    // contact_pairs_[pair].
    struct Elsewhere {
      std::size_t k, pair, there;
    };
    std::vector<Elsewhere> elsewhere = {};
  };
  static void visit_normal_forces(const ContactPair& contact_pair,
                                  const std::function<void(std::size_t, Vector)>& visit);
  void search(const Kinematics& kinematics, double dt, ContactPair& contact_pair);
  void count_broken(const Domain& domain);
  BrokenCounts broken_of(const Domain& domain, const BlockPair& blocks) const;
  static void serialize_breaks(Archive& archive, const Domain& domain, ContactPair& pair);
  void restore(const Kinematics& kinematics, double dt);
  static bool breaks_meet(const Kinematics& kinematics, const ContactPair& contact_pair);
  void check(const Kinematics& kinematics, double dt, ContactPair& contact_pair);
  // Collective.
  void check_where_pending(const Kinematics& kinematics, double dt);
  void add_forces(const Kinematics& kinematics, double dt, const Sliding& sliding, std::vector<Vector>& force_density);
  static void add_normal_forces(const Kinematics& kinematics, double dt, ContactPair& contact_pair,
                                std::vector<Vector>& force_density);
  static void add_friction(const Kinematics& kinematics, double dt, const Sliding& sliding,
                           const std::vector<Load>& loads, ContactPair& contact_pair,
                           std::vector<Vector>& force_density);
  void find_points_of_several();
  std::vector<Load> joined_loads(const Domain& domain, ContactPair& contact_pair) const;

  std::vector<ContactPair> contact_pairs_;
  // Numbers of broken bonds of the owned points when ranks last agreed. Points whose bond breaks in a step touch from
  // the next step on: a search within the step depends on round-off, and so on the number of ranks.
  BrokenCounts broken_before_;
  double stiffness_ = 0, penetration_ = 0;
  int searches_ = 0;
};

}  // namespace strut::contact

// Begins a run in the state in which another one has ended (the deck's section Start From).
#pragma once

#include <optional>
#include <string>

#include "deck/changes.hpp"
#include "deck/deck.hpp"
#include "io/checkpoint/checkpoint_file.hpp"
#include "setup/scene.hpp"

namespace strut {

// The other run's checkpoint. All functions are collective.
class StartState {
 public:
  // Adds a problem if the file is no checkpoint, or of another body. Before the mesh is read.
  StartState(const deck::Deck& deck, const Communicator& communicator, deck::Problems& problems);

  // Gives the scene, as it was set up, the state of the body; its conditions see it from then on. Throws Error on all
  // ranks if the mesh is another one. Returns what it says to the user.
  std::string restore(const deck::Deck& deck, Scene& scene);

  // True if steps (or load steps) of the same kind, at the same time, go on as if the other run had not ended. The
  // solver of the scene must then be ToBeRestored, and gets the other one's steps.
  bool goes_on() const { return goes_on_; }
  void go_on(CentralDifference& solver);
  // Warns of energy out of nothing: what contact that begins here, after its first forces, stores in bodies that are
  // inside each other.
  std::string overlaps(const contact::Contact& contact, const Body& body) const;
  // Call it whether or not steps go on.
  void begin(QuasiStatic& solver);

 private:
  template <class Solver>
  void take_steps(Solver& solver, void (Solver::*serialize)(Archive&));
  void spare_files(const deck::Deck& deck, deck::Problems& problems) const;
  void compare_sets(const deck::Deck& deck, const Body& body);
  bool steps_go_on(const deck::Deck& deck) const;
  // True if no Initial Velocity of this deck replaces the velocities that the other run has left.
  bool keeps_all_velocities() const { return goes_on_ || (changes_.same_conditions && keeps_velocities_); }
  bool takes_of_steps(const std::string& name) const;
  std::string story(const deck::Deck& deck, const Scene& scene) const;

  io::CheckpointFacts facts_;  // all that is read is of this file, also where its run goes on and replaces it
  Communicator communicator_;
  deck::StartChanges changes_;
  bool keeps_velocities_ = false, goes_on_ = false, other_sets_ = false;
};

// Nothing, if the deck does not start from another run.
std::optional<StartState> start_state_of(const deck::Deck& deck, const Communicator& communicator,
                                         deck::Problems& problems);

}  // namespace strut

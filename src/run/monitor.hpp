// What ends a run that has gone wrong without a point that failed: a step that collapses, energy out of nothing, bodies
// that pass through each other.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>

#include "deck/deck.hpp"
#include "integrators/explicit/central_difference.hpp"
#include "integrators/ledger.hpp"
#include "mechanics/body.hpp"
#include "setup/scene.hpp"

namespace strut {

class Monitor {
 public:
  // `duration`: of the run, s. `tell`: takes a line, on any rank.
  Monitor(const deck::Watch& limits, double duration, const Body& body, std::function<void(const std::string&)> tell)
      : limits_(limits), pause_(duration / looks), body_(body), tell_(std::move(tell)) {}

  // Where a limit is passed each throws Error on all ranks, or tells of it once where the deck says that the run goes
  // on; else they are free.
  void check_step(const CentralDifference& solver);    // after advance_velocity()
  void check_energy(const Ledger& ledger, bool last);  // `last`: of the run; it counts, however early it is
  // Whether the ledger is to be looked at, also where nothing is written: the error of the balance is a part of the
  // largest energy so far, which is not that of the end.
  bool is_energy_due(double time) const { return time >= next_energy_; }
  void check_passing(double time, const contact::Contact& contact);  // bodies inside each other
  // What the points do not resolve, after a step with diagnostics: told once, and never the end of a run.
  void check_resolution(const Ledger& ledger, bool last);
  void check_failed(double time);  // points that have lost all stress in an equilibrium: told once
  // What the deck has forgotten or cannot have, at some looks: material that goes through material without contact,
  // and tools (named as in `tools`) between points that are bonded to each other.
  void check_undeclared(double time, const contact::Contact& contact);
  void check_tools(double time, const Conditions& conditions, const std::vector<ToolOfScene>& tools);

  void serialize(Archive& archive);

 private:
  enum What {
    step,
    energy,
    penetration,
    passing,
    point,
    imbalance,
    turning,
    springs,
    stretch,
    undeclared,
    crossing,
    breaking,
    failing,
    meeting,
    unstored,
    count
  };
  static constexpr double looks = 200;  // in a run, at energies, bodies inside each other, tools between points
  static constexpr double costly = 10;  // of these looks, one is for material without contact
  void passed(What what, const std::string& text);
  void tell_once(What what, const std::string& text);
  void warn(What what, const std::string& text);
  void check_meeting(double time, const Conditions& conditions, const std::vector<ToolOfScene>& tools);
  void check_springs(const Ledger& ledger);
  void check_stretch(double time);

  deck::Watch limits_;
  double pause_;  // s, between looks
  // s
  double next_look_ = std::numeric_limits<double>::lowest(), next_undeclared_ = next_look_, next_tools_ = next_look_,
         next_energy_ = next_look_;
  const Body& body_;
  std::function<void(const std::string&)> tell_;
  static constexpr std::uint8_t apart = 1, together = 2;  // how two tools were at the first look; 0: it is to come
  std::vector<std::uint8_t> overlapped_ = {};
  double first_step_ = 0;  // s, stable
  int ledgers_ = 0;
  double told_error_ = 0;  // of the balance
  bool told_[count] = {};
};

}  // namespace strut

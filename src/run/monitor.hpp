// Ends a run that has gone wrong without a failed point: the step collapses, energy is created, bodies
// interpenetrate.
#pragma once

#include <algorithm>
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
  enum class Steps { of_time, of_load };
  // `duration`: of the run, s. `print`: prints a line, on any rank.
  Monitor(const deck::Watch& limits, double duration, const Body& body, std::function<void(const std::string&)> print)
      : limits_(limits), pause_(duration / checks), body_(body), print_(std::move(print)) {}

  // Collective. Each check throws Error on all ranks if a limit is exceeded, or warns once if the deck says that the
  // run continues. All but check_step cost about as much as a step: they are made some two hundred times in a run
  // (`checks`), and not more often than every ten steps.
  void check_step(const CentralDifference& solver);    // after advance_velocity()
  void check_energy(const Ledger& ledger, bool last);  // `last`: of the run; it counts, however early it is
  // True if the ledger must be checked, also if nothing is written: the balance error is relative to the largest energy
  // so far, which is not that at the end.
  bool is_energy_check_scheduled(double time) const { return time >= next_energy_; }
  void check_interpenetration(double time, const contact::Contact& contact);  // interpenetration of bodies
  // Deformation that the points do not resolve, after a step with diagnostics: warns once, never ends a run.
  void check_resolution(const Ledger& ledger, bool last);
  // Points of ordinary solids that are turned inside out, after a step with diagnostics: warns once.
  void check_inverted(double time);
  // Collective. Contact between surfaces that gives way so much that bodies pressed on each other are too soft: told
  // once in a run, at its end.
  void check_soft_contact(const Ledger& ledger, const contact::Contact& contact, bool last, Steps steps);
  void check_breaks(const Fracture& fracture, double time);  // breaks in steps too long for them, at the end of a run
  void check_failed(double time);                            // points without stress in an equilibrium: warns once
  // Plastic work that load steps miss (J; energies.hpp), at the end of a run of equilibria.
  void check_plastic_work(const Ledger& ledger, double missed);
  // Omissions of the deck, at some checks: material that passes through material without contact, through a symmetry
  // plane, or through a tool (named as in `tools`) that acts on others, and tools between points bonded to each other.
  void check_undeclared(double time, const contact::Contact& contact);
  void check_tools(double time, const Conditions& conditions, const std::vector<ToolOfScene>& tools,
                   Steps steps = Steps::of_time);

  void serialize(Archive& archive, std::size_t tools);  // `tools`: how many the scene has

 private:
  enum What {
    step,
    energy,
    penetration,
    interpenetration,
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
    uncounted,
    soft_contact,
    fast_breaks,
    beyond_plane,
    beyond_tool,
    inverted,
    count
  };
  static constexpr double checks = 200;       // checks per run of energies, interpenetration and tools between points
  static constexpr double fewest_steps = 10;  // between these checks
  static constexpr double costly = 10;        // one of this many checks is for undeclared contact
  static constexpr double worth_a_warning = 0.01;  // least balance error that gets one, of the largest energy
  double pause() const { return std::max(pause_, fewest_steps * dt_); }  // s, between checks
  void passed(What what, const std::string& text);
  // True if this limit has nothing more to say. A run that continues may stop where the one before it went on.
  bool is_silent(What what) const { return warned_[what] && !limits_.stops; }
  void warn_once(What what, const std::string& text);
  static std::string at(double time);  // how its warnings begin
  void warn(What what, const std::string& text);
  void check_planes(double time);
  void check_sets_of_tools(double time, const Conditions& conditions, const std::vector<ToolOfScene>& tools);
  void check_meeting(double time, const Conditions& conditions, const std::vector<ToolOfScene>& tools);
  void warn_if_negative(What what, const char* name, double energy, const Ledger& ledger, const char* causes);
  void check_springs(double time);
  void check_stretch(double time);

  deck::Watch limits_;
  double pause_;   // s, the run's duration over `checks`
  double dt_ = 0;  // s, of the last step; none in equilibria
  // s
  double next_interpenetration_ = std::numeric_limits<double>::lowest(), next_undeclared_ = next_interpenetration_,
         next_tools_ = next_interpenetration_, next_energy_ = next_interpenetration_;
  const Body& body_;
  std::function<void(const std::string&)> print_;
  static constexpr std::uint8_t apart = 1, together = 2;  // state of two tools at the first check; 0: not yet checked
  std::vector<std::uint8_t> overlapped_ = {};
  double first_step_ = 0;  // s, stable step at the start
  int ledgers_ = 0;
  double warned_error_ = 0;  // of the balance
  // The most that surfaces in contact have stored while motion was slow, J, and its part of what they and the bodies
  // had taken up.
  double most_in_contact_ = 0, part_in_contact_ = 0;
  double failed_before_ = -1;  // points that had failed before the first load step; -1: not yet counted
  bool warned_[count] = {};
};

}  // namespace strut

// A law from a shared object: strut's own interface (strut_law.h), UMAT or VUMAT of Abaqus (User Subroutines Reference
// Guide). It is called as a function of one step in the unrotated frame, by strut's interface for several points at a
// time. The elastic constants bound the critical time step, and scale stabilization and contact.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "materials/elastic.hpp"
#include "materials/law.hpp"
#include "materials/library_calls.hpp"

namespace strut::materials {

enum class LibraryInterface { strut, umat, vumat };

// A function of a library that stays loaded as long as a law uses it.
struct LibraryFunction {
  std::string file, name;
  LibraryInterface interface = LibraryInterface::strut;
  std::shared_ptr<void> library;
  void* address = nullptr;
};

// Loads the library and finds its function. Throws Error, with the reason of the system, if there is none.
LibraryFunction loaded(const std::string& file, const std::string& name, LibraryInterface interface);

struct UserLaw {
  static constexpr int most_states = 24;

  double bulk = 0, shear = 0;     // Pa
  double density = 0;             // kg/m³, undeformed
  std::string name;               // of the material: CMNAME
  std::vector<double> constants;  // PROPS, then NaNs (with_none_behind), so that a law that reads too many fails
  int states = 1;                 // number of state variables of the library, STATEV
  LibraryFunction function;
  bool tells_energy = false;  // the library counts its energies; else they follow from the elastic constants

  template <class T>
  struct StateOf {
    T user[most_states]{};
    T stored{}, dissipated{};  // J per m³ of reference volume
    T strain[6]{};             // Σ d dt
    T displacement[6]{};       // U − I at the end of the last step
    T time{};                  // s, since the start
  };
  using State = StateOf<double>;
  static constexpr auto state_names = words<most_states + 15>(
      "User_State_1 User_State_2 User_State_3 User_State_4 User_State_5 User_State_6 User_State_7 User_State_8 "
      "User_State_9 User_State_10 User_State_11 User_State_12 User_State_13 User_State_14 User_State_15 User_State_16 "
      "User_State_17 User_State_18 User_State_19 User_State_20 User_State_21 User_State_22 User_State_23 User_State_24 "
      "Elastic_Energy_Density Dissipated_Energy_Density "
      "Rate_Strain_XX Rate_Strain_YY Rate_Strain_ZZ Rate_Strain_XY Rate_Strain_YZ Rate_Strain_ZX Stretch_Change_XX "
      "Stretch_Change_YY Stretch_Change_ZZ Stretch_Change_XY Stretch_Change_YZ Stretch_Change_ZX Time_In_Law");

  // True if output has the state variable at this index: those of the library, and the energies.
  bool shows(std::size_t k) const { return k < most_states ? static_cast<int>(k) < states : k < most_states + 2; }

  template <class T>
  StressOf<T> step(const StepOf<T>& step, const SymmetricOf<T>& stress, StateOf<T>& state) const {
    constexpr int points = sizeof(T) / sizeof(double);
    SymmetricOf<T> next = stress;
    T converged{};
    advance(points, numbers(step.dt), numbers(step.rate[0]), numbers(step.J), numbers(step.stretch[0]),
            numbers(state.user[0]), numbers(next[0]), numbers(converged));
    return {next, converged > 0};
  }

  // The next step of a library begins at the new stretch. A library of rates goes on from its stress; one whose stress
  // is a function of the stretch follows the jump.
  void move_stress(const Tensor& /* from */, const Tensor& to, State& state) const {
    Eigen::Map<Symmetric>(state.displacement) = symmetric_part(to - Tensor::Identity());
  }

  Moduli moduli() const { return {bulk, shear}; }
  double elastic_energy(const Symmetric& stress, const State&) const {
    return Elastic{bulk, shear}.elastic_energy(stress);
  }
  double stored_energy(const State& state) const { return state.stored; }
  double dissipation(const State& state) const { return state.dissipated; }
  // Flow is assumed to keep the volume, as in metals: integration points of a quadratic cell then share their change of
  // volume. Flow by a strain of some 1e-10 is round-off of a law that balances its energies.
  bool has_flowed(const State& state) const { return tells_energy && state.dissipated > 1e-12 * bulk; }
  double flow_stress(const State&) const { return std::numeric_limits<double>::infinity(); }
  std::string why_no_stress() const;  // for the last step without a stress

  static std::vector<double> with_none_behind(std::vector<double> constants);

 private:
  template <class T>
  static const double* numbers(const T& first) {
    return reinterpret_cast<const double*>(&first);
  }
  template <class T>
  static double* numbers(T& first) {
    return reinterpret_cast<double*>(&first);
  }
  // All arrays are [component][point]; `state` is a StateOf, `stress` that of the start, then of the end.
  void advance(int points, const double* dt, const double* rate, const double* J, const double* stretch, double* state,
               double* stress, double* converged) const;
};

static_assert(Law<UserLaw> && takes_lanes<UserLaw>);

// The result of a library's trial at the start of a run.
struct LibraryTrial {
  std::string problem;  // a sentence; "" if the law can be used
  std::string warning;
  bool tells_energy = false;
};

// Calls the library for steps of an undeformed point: no strain must give no stress, small strains a finite and
// symmetric stiffness, and no state beyond its own may change.
LibraryTrial tried(const UserLaw& law);

// Compares the stiffness of a law in steps of dt (s) with its elastic constants; a viscous law is stiffer in shorter
// steps. Returns "is stiffer, … Pa, than its elastic constants say, … in a step of … s", or "" if it is not stiffer.
std::string stiffer_in(const UserLaw& law, double dt);
// The same text, with the consequence for explicit steps, which are as long as the elastic constants allow.
std::string too_stiff_in(const UserLaw& law, double dt);

}  // namespace strut::materials

#include "materials/user_law.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cstring>
#include <fstream>
#include <iomanip>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "materials/library_calls.hpp"
#include "materials/step_work.hpp"
#include "materials/strut_law.h"
#include "materials/tangent.hpp"

namespace strut::materials {

namespace {

using library_calls::Inside;

// Why a library gave no stress.
constexpr const char* gave_up = "found no stress (PNEWDT below 1, or `failed`)";
constexpr const char* no_number =
    "gave a stress, a state variable or an energy that is no number; does it have all its Constants?";
constexpr const char* wrote_beyond = "changed a state variable beyond its State Variables, or what it may only read";
constexpr const char* wrote_constants = "changed its Constants (PROPS), which are those of all points";
std::atomic<const char*> complaint = gave_up;  // of the last step without a stress, on any thread

constexpr int none_behind = 32;  // NaNs behind the constants
int count_of(const std::vector<double>& constants) { return static_cast<int>(constants.size()) - none_behind; }

constexpr int most_points = 8, most = UserLaw::most_states;
constexpr int rows = sizeof(UserLaw::State) / sizeof(double);
constexpr int guards = most;         // rows behind a lent state,
constexpr double guard = 12345.678;  // which a library must leave alone

// ---- The interfaces -------------------------------------------------------------------------------------------------

using StrutLaw = void (*)(const strut_step*);
using Umat = void (*)(double* stress, double* statev, double* ddsdde, double* sse, double* spd, double* scd,
                      double* rpl, double* ddsddt, double* drplde, double* drpldt, double* stran, double* dstran,
                      double* time, double* dtime, double* temp, double* dtemp, double* predef, double* dpred,
                      char* cmname, int* ndi, int* nshr, int* ntens, int* nstatv, double* props, int* nprops,
                      double* coords, double* drot, double* pnewdt, double* celent, double* dfgrd0, double* dfgrd1,
                      int* noel, int* npt, int* layer, int* kspt, int* jstep, int* kinc, std::size_t cmname_length);
using Vumat = void (*)(int* nblock, int* ndir, int* nshr, int* nstatev, int* nfieldv, int* nprops, int* lanneal,
                       double* step_time, double* total_time, double* dt, char* cmname, double* coord,
                       double* char_length, double* props, double* density, double* strain_inc, double* rel_spin_inc,
                       double* temp_old, double* stretch_old, double* defgrad_old, double* field_old,
                       double* stress_old, double* state_old, double* ener_intern_old, double* ener_inelas_old,
                       double* temp_new, double* stretch_new, double* defgrad_new, double* field_new,
                       double* stress_new, double* state_new, double* ener_intern_new, double* ener_inelas_new,
                       std::size_t cmname_length);

constexpr std::size_t name_length = 80;

// A Fortran text: upper case, padded by blanks.
std::array<char, name_length> fortran_text(const std::string& name) {
  std::array<char, name_length> text;
  text.fill(' ');
  for (std::size_t k = 0; k < std::min(name.size(), name_length); ++k) {
    text[k] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[k])));
  }
  return text;
}

// The arguments of UMAT and VUMAT that all points share. Both get one point at a time, since points in substeps have
// steps of their own.
struct Fixed {
  const UserLaw& law;
  const double* constants;
  std::array<char, name_length> cmname = fortran_text(law.name);
  double* props = const_cast<double*>(constants);  // Fortran has no const
  int ndir = 3, nshr = 3, nprops = count_of(law.constants), nstatv = law.states;
};

void call_umat(const UserLaw& law, const strut_step& s, Inside& here) {
  // UMAT's shear components are xy xz yz, and shear strains are doubled.
  constexpr int place[6] = {0, 1, 2, 3, 5, 4};
  constexpr int full[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
  Fixed fixed{law, s.constants};
  for (int p = 0; p < s.points; ++p) {
    here.takes(p);
    const auto at = [&](const double* values, int c) { return values[c * s.points + p]; };
    double stress[6], strain[6], increment[6], statev[most], before[9], after[9];
    for (int c = 0; c < 6; ++c) {
      const int from = place[c];
      const double doubled = c < 3 ? 1 : 2;
      stress[c] = at(s.stress, from);
      strain[c] = doubled * at(s.strain, from);
      increment[c] = doubled * at(s.rate, from) * s.dt[p];
    }
    for (int k = 0; k < 9; ++k) before[k] = at(s.old_stretch, full[k]), after[k] = at(s.stretch, full[k]);
    for (int c = 0; c < most; ++c) statev[c] = at(s.state, c);
    double ddsdde[36] = {}, sse = s.stored[p] / s.J[p], spd = s.dissipated[p] / s.J[p], scd = 0, rpl = 0;
    double ddsddt[6] = {}, drplde[6] = {}, drpldt = 0, time[2] = {s.time[p], s.time[p]}, dtime = s.dt[p], temp = 0;
    double dtemp = 0, predef = 0, dpred = 0, coords[3] = {}, drot[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, pnewdt = 1;
    double celent = 0;
    int ntens = 6, noel = 1, npt = 1, layer = 1, kspt = 1, jstep[4] = {1, 0, 0, 0}, kinc = 1;
    reinterpret_cast<Umat>(law.function.address)(
        stress, statev, ddsdde, &sse, &spd, &scd, &rpl, ddsddt, drplde, &drpldt, strain, increment, time, &dtime, &temp,
        &dtemp, &predef, &dpred, fixed.cmname.data(), &fixed.ndir, &fixed.nshr, &ntens, &fixed.nstatv, fixed.props,
        &fixed.nprops, coords, drot, &pnewdt, &celent, before, after, &noel, &npt, &layer, &kspt, jstep, &kinc,
        name_length);
    for (int c = 0; c < 6; ++c) s.stress[place[c] * s.points + p] = stress[c];
    for (int c = 0; c < most; ++c) s.state[c * s.points + p] = statev[c];
    s.stored[p] = s.J[p] * sse, s.dissipated[p] = s.J[p] * (spd + scd);
    s.failed[p] = pnewdt < 1;
  }
}

void call_vumat(const UserLaw& law, const strut_step& s, Inside& here) {
  constexpr int full[9] = {0, 1, 2, 3, 4, 5, 3, 4, 5};  // 11 22 33 12 23 31 21 32 13
  Fixed fixed{law, s.constants};
  for (int p = 0; p < s.points; ++p) {
    here.takes(p);
    const auto at = [&](const double* values, int c) { return values[c * s.points + p]; };
    double old_stress[6], stress[6], increment[6], before[9], after[9], old_state[most], state[most];
    for (int c = 0; c < 6; ++c) {
      old_stress[c] = stress[c] = at(s.stress, c);
      increment[c] = at(s.rate, c) * s.dt[p];
    }
    for (int k = 0; k < 9; ++k) before[k] = at(s.old_stretch, full[k]), after[k] = at(s.stretch, full[k]);
    for (int c = 0; c < most; ++c) old_state[c] = state[c] = at(s.state, c);
    double density = law.density / s.J[p], inelastic = s.dissipated[p] / law.density;
    double intern = s.stored[p] / law.density + inelastic, new_intern = intern, new_inelastic = inelastic;
    double time = s.time[p] + s.dt[p], dt = s.dt[p], none[9] = {};
    double stretch_before[6], stretch[6];  // beside deformation gradients, which are stretches, too
    std::copy_n(before, 6, stretch_before);
    std::copy_n(after, 6, stretch);
    int nblock = 1, nfieldv = 0, lanneal = 0;
    reinterpret_cast<Vumat>(law.function.address)(
        &nblock, &fixed.ndir, &fixed.nshr, &fixed.nstatv, &nfieldv, &fixed.nprops, &lanneal, &time, &time, &dt,
        fixed.cmname.data(), none, none, fixed.props, &density, increment, none, none, stretch_before, before, none,
        old_stress, old_state, &intern, &inelastic, none, stretch, after, none, stress, state, &new_intern,
        &new_inelastic, name_length);
    for (int c = 0; c < 6; ++c) s.stress[c * s.points + p] = stress[c];
    for (int c = 0; c < most; ++c) s.state[c * s.points + p] = state[c];
    s.dissipated[p] = law.density * new_inelastic;
    s.stored[p] = law.density * (new_intern - new_inelastic);
  }
}

void call(const UserLaw& law, const strut_step& s) {
  Inside here(law.function.file);
  const LibraryInterface its = law.function.interface;
  if (its == LibraryInterface::strut) return reinterpret_cast<StrutLaw>(law.function.address)(&s);
  its == LibraryInterface::umat ? call_umat(law, s, here) : call_vumat(law, s, here);
}

// The points at which the library changed more of the state that it was lent than its state variables and energies.
std::array<bool, most_points> changed_beyond(const double* lent, const double* state, int points, int states) {
  const auto same = [&](int first, int end) {
    return std::memcmp(lent + first * points, state + first * points, sizeof(double) * (end - first) * points) == 0;
  };
  const auto is_guard = [](double number) { return number == guard; };
  const double* const behind = lent + rows * points;
  std::array<bool, most_points> changed{};
  if (same(states, most) && same(most + 2, rows) && std::all_of(behind, behind + guards * points, is_guard)) {
    return changed;
  }
  for (int k = states * points; k < (rows + guards) * points; ++k) {
    const bool is_energy = k >= most * points && k < (most + 2) * points;
    const bool is_same = k < rows * points ? std::memcmp(lent + k, state + k, sizeof(double)) == 0 : is_guard(lent[k]);
    if (!is_energy && !is_same) changed[k % points] = true;
  }
  return changed;
}

// "" if the file is no object code, or one of this processor's. The system's own message is "No such file".
std::string other_processor(const std::string& file) {
  const auto head = [](const std::string& name) {
    std::string bytes(20, '\0');
    std::ifstream(name, std::ios::binary).read(bytes.data(), std::ssize(bytes));
    return bytes;
  };
  const std::string its = head(file), own = head("/proc/self/exe");
  constexpr int machine = 18;  // ELF: e_machine, two bytes
  if (its.substr(0, 4) != own.substr(0, 4) || its.substr(machine) == own.substr(machine)) return "";
  const auto number = [](const std::string& bytes) {
    return std::to_string(static_cast<unsigned char>(bytes[machine]) +
                          256 * static_cast<unsigned char>(bytes[machine + 1]));
  };
  return "is compiled for another processor (machine " + number(its) + " of ELF; expected " + number(own) + ")";
}

}  // namespace

LibraryFunction loaded(const std::string& file, const std::string& name, LibraryInterface interface) {
  library_calls::watch();
  const auto reason = [] {
    const char* text = dlerror();
    return std::string(text ? text : "unknown error");
  };
  if (const std::string other = other_processor(file); !other.empty()) throw Error(other);
  void* handle = nullptr;
  {
    const Inside here(file);  // a damaged one crashes here, and constructors run
    handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  }
  if (!handle) throw Error("cannot be loaded: " + reason());
  std::shared_ptr<void> library(handle, dlclose);
  void* address = dlsym(handle, name.c_str());
  if (!address) throw Error("has no function '" + name + "': " + reason());
  return {file, name, interface, std::move(library), address};
}

std::vector<double> UserLaw::with_none_behind(std::vector<double> constants) {
  constants.resize(constants.size() + none_behind, std::numeric_limits<double>::quiet_NaN());
  return constants;
}

std::string UserLaw::why_no_stress() const { return "the library " + function.file + " " + complaint.load(); }

void UserLaw::advance(int points, const double* dt, const double* rate, const double* J, const double* stretch,
                      double* state, double* stress, double* converged) const {
  static_assert(sizeof(RawLanes) / sizeof(double) <= most_points);
  double lent[(rows + guards) * most_points];
  std::copy_n(state, rows * points, lent);
  std::fill_n(lent + rows * points, guards * points, guard);
  double* const stored = lent + most * points;
  double* const dissipated = stored + points;
  double* const strain = dissipated + points;
  double* const displacement = strain + 6 * points;
  double* const time = displacement + 6 * points;
  double d[6 * most_points], U[6 * most_points], old[6 * most_points], det[most_points], before[6 * most_points];
  int failed[most_points] = {};
  std::copy_n(stress, 6 * points, before);
  for (int p = 0; p < points; ++p) det[p] = J[p] > 0 ? J[p] : 1;
  for (int c = 0; c < 6; ++c) {
    for (int p = 0; p < points; ++p) {
      const int k = c * points + p;
      old[k] = displacement[k] + (c < 3);
      d[k] = J[p] > 0 ? rate[k] : 0;  // a caller discards points with J <= 0, which no library should see
      U[k] = J[p] > 0 ? stretch[k] : c < 3;
    }
  }
  thread_local std::vector<double> props;  // a library may change them by mistake
  props = constants;
  const strut_step step{
      points, count_of(constants), states, props.data(), time, dt, d, strain, old, U, det, stress, lent,
      stored, dissipated,          failed};
  call(*this, step);
  const bool spoiled = std::memcmp(props.data(), constants.data(), sizeof(double) * constants.size()) != 0;
  const std::array<bool, most_points> beyond = changed_beyond(lent, state, points, states);
  for (int p = 0; p < points; ++p) {
    double sum = stored[p] + dissipated[p];
    for (int c = 0; c < 6; ++c) sum += stress[c * points + p];
    for (int c = 0; c < states; ++c) sum += lent[c * points + p];
    const char* const wrong = failed[p] != 0    ? gave_up
                              : spoiled         ? wrote_constants
                              : beyond[p]       ? wrote_beyond
                              : !is_finite(sum) ? no_number
                                                : nullptr;
    converged[p] = wrong == nullptr;
    if (wrong) {
      complaint = wrong;
      continue;
    }
    if (!tells_energy) {
      PointStep one{.dt = dt[p], .J = det[p]};
      Symmetric from, to;
      for (int c = 0; c < 6; ++c) {
        one.rate[c] = d[c * points + p], from[c] = before[c * points + p], to[c] = stress[c * points + p];
      }
      stored[p] = det[p] * Elastic{bulk, shear}.elastic_energy(to);
      const double work = step_work(one, old_determinant(one), from, to);
      dissipated[p] = state[(most + 1) * points + p] + work - (stored[p] - state[most * points + p]);
    }
    for (int c = 0; c < 6; ++c) {
      strain[c * points + p] += d[c * points + p] * dt[p];
      displacement[c * points + p] = U[c * points + p] - (c < 3);
    }
    time[p] += dt[p];
    for (int c = 0; c < rows; ++c) state[c * points + p] = lent[c * points + p];
  }
}

namespace {

constexpr double trial_strain = 1e-7;
constexpr double trial_step = 1e-6;       // s
constexpr double given_constants = 0.01;  // tolerance of elastic constants that are given to two or three digits

Symmetric identity() {
  Symmetric unit = Symmetric::Zero();
  unit.head<3>().setOnes();
  return unit;
}

// Pa, the largest stiffness by the elastic constants.
double stiffness_given(const UserLaw& law) { return std::max(3 * law.moduli().bulk, 2 * law.moduli().shear); }

std::string problem_at_rest(const UserLaw& law) {
  UserLaw::State rest;
  std::fill(rest.user + law.states, rest.user + most, guard);  // which it must leave alone
  const PointStep step{Symmetric::Zero(), trial_step, 1, identity()};
  const PointStress still = law.step(step, Symmetric::Zero(), rest);
  if (!still.converged) return "in a step without strain " + std::string(complaint);
  const double large = still.stress.cwiseAbs().maxCoeff();
  if (!(large > 1e-9 * law.moduli().bulk)) return "";
  return text_of(std::setprecision(4), "gives a stress of ", large,
                 " Pa in a step of the undeformed state without strain; expected none");
}

struct TriedStiffness {
  StretchTangent stiffness = StretchTangent::Zero();  // Pa, of small strains of the undeformed state
  double softest = 0, stiffest = 0;
  bool found = true, tells_energy = false;
};

// In steps of dt (s).
TriedStiffness tried_stiffness(UserLaw law, double dt) {
  TriedStiffness tried;
  law.tells_energy = true;
  for (int c = 0; c < 6; ++c) {
    Symmetric d = Symmetric::Zero();
    d[c] = c < 3 ? trial_strain : 0.5 * trial_strain;  // an engineering shear strain
    UserLaw::State state;
    const Symmetric stretch = identity() + d;
    const PointStress next =
        law.step(PointStep{d / dt, dt, to_tensor(stretch).determinant(), stretch}, Symmetric::Zero(), state);
    tried.found = next.converged;
    if (!tried.found) return tried;
    if (state.stored > 0) tried.tells_energy = true;
    tried.stiffness.col(c) = next.stress / trial_strain;
  }
  const StretchTangent even = 0.5 * (tried.stiffness + tried.stiffness.transpose());
  const auto stiffnesses = Eigen::SelfAdjointEigenSolver<StretchTangent>(even).eigenvalues();
  tried.stiffest = stiffnesses.maxCoeff(), tried.softest = stiffnesses.minCoeff();
  return tried;
}

std::string if_unstable(const UserLaw& law, const TriedStiffness& tried) {
  if (!(tried.softest < -1e-3 * stiffness_given(law))) return "";
  return text_of(std::setprecision(4), "has an elastic stiffness of ", tried.softest,
                 " Pa in some direction, which lets no body stand; expected none below 0: are its signs, and the order "
                 "of its components, those of its interface?");
}

std::string if_soft(const UserLaw& law, const TriedStiffness& tried) {
  const double expected = stiffness_given(law);
  if (!(tried.stiffest < (1 - 10 * given_constants) * expected)) return "";
  return text_of(
      std::setprecision(4), "is softer, ", tried.stiffest, " Pa, than its elastic constants say, ", expected,
      " Pa (the larger of 3 K and 2 G): time steps will be shorter than necessary, contact and stabilization "
      "stiffer; are its constants in Pa?");
}

std::string if_unsymmetric(const TriedStiffness& tried) {
  const double size = tried.stiffness.cwiseAbs().maxCoeff();
  if (!((tried.stiffness - tried.stiffness.transpose()).cwiseAbs().maxCoeff() > 1e-3 * size)) return "";
  return "has an unsymmetric elastic stiffness, so that it has no elastic energy; are its components in the order of "
         "its interface?";
}

}  // namespace

// Uniaxial strain, as in the fastest waves, has a limit of its own: with the usual safety factor, 0.8, the stiffness
// may be 56 % too large, by viscosity half as much, since leapfrog evaluates it at older velocities.
std::string stiffer_in(const UserLaw& law, double dt) {
  constexpr double by_viscosity = 1.25;
  const TriedStiffness tried = tried_stiffness(law, dt);
  if (!tried.found) return "";
  const auto says = [dt](double found, double given, const char* name) {
    return text_of(std::setprecision(4), "is stiffer, ", found, " Pa, than its elastic constants say, ", given, " Pa (",
                   name, "), in a step of ", dt, " s");
  };
  const double given = stiffness_given(law), wave = law.bulk + 4 * law.shear / 3;
  const double uniaxial = tried.stiffness.diagonal().head<3>().maxCoeff();
  if (tried.stiffest > (1 + given_constants) * given) return says(tried.stiffest, given, "the larger of 3 K and 2 G");
  return uniaxial > by_viscosity * wave ? says(uniaxial, wave, "K + 4/3 G") : "";
}

std::string too_stiff_in(const UserLaw& law, double dt) {
  const std::string stiff = stiffer_in(law, dt);
  if (stiff.empty()) return stiff;
  return stiff +
         ": the time step would be too long for it; expected elastic constants that are not smaller than the law's";
}

LibraryTrial tried(const UserLaw& law) {
  LibraryTrial found{.problem = problem_at_rest(law)};
  if (!found.problem.empty()) return found;
  const TriedStiffness trial = tried_stiffness(law, trial_step);
  if (!trial.found) return {.problem = "for a strain of 1e-7 " + std::string(complaint)};
  found.tells_energy = trial.tells_energy;
  found.problem = if_unstable(law, trial);
  for (const std::string& warning : {if_soft(law, trial), if_unsymmetric(trial)}) {
    if (!warning.empty()) found.warning += (found.warning.empty() ? "" : "; it ") + warning;
  }
  return found;
}

}  // namespace strut::materials

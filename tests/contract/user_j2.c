/* J2 with linear hardening for tests of user libraries, by all three interfaces: the radial return in closed form. The
 * constants are K, G, the yield stress and the hardening modulus, Pa; the state is the equivalent plastic strain, and
 * where there are two state variables the sum of the steps, s. */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

#include "materials/strut_law.h"

/* Components xx yy zz and three shears, tensor components of strain. Returns the plastic strain's increment. */
static double step_of(const double* constants, const double* increment, const double* old, double strain,
                      double* stress, double* work) {
  const double K = constants[0], G = constants[1], yield = constants[2], hardening = constants[3];
  const double volume = (increment[0] + increment[1] + increment[2]) / 3, p = (old[0] + old[1] + old[2]) / 3;
  double s[6], squared = 0, with_old = 0;
  int c;
  for (c = 0; c < 6; ++c) {
    s[c] = old[c] - (c < 3 ? p : 0) + 2 * G * (increment[c] - (c < 3 ? volume : 0));
    squared += (c < 3 ? 1 : 2) * s[c] * s[c];
    with_old += (c < 3 ? 1 : 2) * s[c] * (old[c] - (c < 3 ? p : 0));
  }
  const double q = sqrt(1.5 * squared), flow = yield + hardening * strain;
  const double flows = q > flow ? (q - flow) / (3 * G + hardening) : 0;
  const double scale = flows > 0 ? 1 - 3 * G * flows / q : 1;
  for (c = 0; c < 6; ++c) stress[c] = scale * s[c] + (c < 3 ? p + 3 * K * volume : 0);
  *work = flows > 0 ? flows * fmax(0.5 * (flow + hardening * flows + 1.5 * with_old / q), 0) : 0;
  return flows;
}

static double elastic_energy(const double* constants, const double* stress) {
  const double p = (stress[0] + stress[1] + stress[2]) / 3;
  double squared = 0;
  int c;
  for (c = 0; c < 6; ++c) {
    const double s = stress[c] - (c < 3 ? p : 0);
    squared += (c < 3 ? 1 : 2) * s * s;
  }
  return p * p / (2 * constants[0]) + squared / (4 * constants[1]);
}

void strut_law(const struct strut_step* step) {
  const int n = step->points;
  int p, c;
  for (p = 0; p < n; ++p) {
    double increment[6], old[6], stress[6], work;
    for (c = 0; c < 6; ++c) {
      increment[c] = step->rate[c * n + p] * step->dt[p];
      old[c] = step->stress[c * n + p];
    }
    step->state[p] += step_of(step->constants, increment, old, step->state[p], stress, &work);
    for (c = 0; c < 6; ++c) step->stress[c * n + p] = stress[c];
    if (step->state_count > 1) step->state[n + p] += step->dt[p];
    step->stored[p] = step->J[p] * elastic_energy(step->constants, stress);
    step->dissipated[p] += step->J[p] * work;
  }
}

/* As gfortran names it. Shears are xy xz yz, and strains engineering ones. */
void umat_(double* stress, double* statev, double* ddsdde, double* sse, double* spd, double* scd, double* rpl,
           double* ddsddt, double* drplde, double* drpldt, double* stran, double* dstran, double* time, double* dtime,
           double* temp, double* dtemp, double* predef, double* dpred, char* cmname, int* ndi, int* nshr, int* ntens,
           int* nstatv, double* props, int* nprops, double* coords, double* drot, double* pnewdt, double* celent,
           double* dfgrd0, double* dfgrd1, int* noel, int* npt, int* layer, int* kspt, int* jstep, int* kinc,
           size_t length) {
  double increment[6], old[6], work;
  int c;
  for (c = 0; c < 6; ++c) increment[c] = (c < 3 ? 1 : 0.5) * dstran[c], old[c] = stress[c];
  statev[0] += step_of(props, increment, old, statev[0], stress, &work);
  if (*nstatv > 1) statev[1] += *dtime;
  *sse = elastic_energy(props, stress);
  *spd += work;
}

void vumat_(int* nblock, int* ndir, int* nshr, int* nstatev, int* nfieldv, int* nprops, int* lanneal, double* step_time,
            double* total_time, double* dt, char* cmname, double* coord, double* char_length, double* props,
            double* density, double* strain_inc, double* rel_spin_inc, double* temp_old, double* stretch_old,
            double* defgrad_old, double* field_old, double* stress_old, double* state_old, double* intern_old,
            double* inelastic_old, double* temp_new, double* stretch_new, double* defgrad_new, double* field_new,
            double* stress_new, double* state_new, double* intern_new, double* inelastic_new, size_t length) {
  const int n = *nblock;
  int p, c;
  for (p = 0; p < n; ++p) {
    double increment[6], old[6], stress[6], work;
    for (c = 0; c < 6; ++c) increment[c] = strain_inc[c * n + p], old[c] = stress_old[c * n + p];
    state_new[p] = state_old[p] + step_of(props, increment, old, state_old[p], stress, &work);
    if (*nstatev > 1) state_new[n + p] = state_old[n + p] + *dt;
    for (c = 0; c < 6; ++c) stress_new[c * n + p] = stress[c];
    inelastic_new[p] = inelastic_old[p] + work / density[p];
    intern_new[p] = inelastic_new[p] + elastic_energy(props, stress) / density[p];
  }
}

/* Kelvin & Voigt: the third constant is a viscosity, Pa s. */
void viscous(const struct strut_step* step) {
  const int n = step->points;
  int p, c;
  for (p = 0; p < n; ++p) {
    const double K = step->constants[0], G = step->constants[1], viscosity = step->constants[2];
    double rate[6], strain[6], volume, speed;
    for (c = 0; c < 6; ++c) {
      rate[c] = step->rate[c * n + p];
      strain[c] = step->strain[c * n + p] + rate[c] * step->dt[p];
    }
    volume = (strain[0] + strain[1] + strain[2]) / 3, speed = (rate[0] + rate[1] + rate[2]) / 3;
    for (c = 0; c < 6; ++c) {
      step->stress[c * n + p] = (c < 3 ? 3 * K * volume : 0) + 2 * G * (strain[c] - (c < 3 ? volume : 0)) +
                                2 * viscosity * (rate[c] - (c < 3 ? speed : 0));
    }
  }
}

/* Faults that the trial at the start of a run must find. */
void prestressed(const struct strut_step* step) {
  int p;
  for (p = 0; p < step->points; ++p) step->stress[p] = 1e6;
}
void beyond_its_states(const struct strut_step* step) {
  int k;
  for (k = 0; k < (step->state_count + 1) * step->points; ++k) step->state[k] = 1;
}
void far_beyond_its_states(const struct strut_step* step) { step->state[(step->state_count + 40) * step->points] += 1; }
void umat_far_beyond_its_states(double* stress, double* statev) { statev[20] = stress[0] + 1; }
void changes_the_strain(const struct strut_step* step) { ((double*)step->strain)[0] = 1; }
void changes_constants(const struct strut_step* step) { ((double*)step->constants)[0] *= 0.5; }
void of_the_wrong_sign(const struct strut_step* step) {
  int k;
  for (k = 0; k < 6 * step->points; ++k) step->stress[k] -= 1e9 * step->rate[k] * step->dt[k % step->points];
}
void umat_beyond_its_states(double* stress, double* statev) { statev[1] = stress[0] + 1; }
void in_megapascals(const struct strut_step* step) {
  int k;
  for (k = 0; k < 3 * step->points; ++k) step->stress[k] += 1e5 * step->rate[k] * step->dt[k % step->points];
}
void far_too_stiff(const struct strut_step* step) {
  int k;
  for (k = 0; k < 6 * step->points; ++k) step->stress[k] += 1e15 * step->rate[k] * step->dt[k % step->points];
}
void not_a_number(const struct strut_step* step) {
  int k;
  for (k = 0; k < 6 * step->points; ++k) step->stress[k] += sqrt(-1 - step->dt[0]);
}
void reads_a_fifth_constant(const struct strut_step* step) {
  int k;
  for (k = 0; k < 6 * step->points; ++k) step->stress[k] += step->constants[4] * step->rate[k];
}
void unable(const struct strut_step* step) { step->failed[0] = 1; }
void crashes(const struct strut_step* step) { *(volatile int*)(size_t)(step->points - 1) = 0; }
void stops(const struct strut_step* step) { exit(step->failed[0]); }

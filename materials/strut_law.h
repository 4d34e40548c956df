/* A constitutive law of your own, as a shared object that a deck names (Material Model "User Library"):
 *
 *     gcc -O3 -march=native -shared -fPIC my_law.c -o my_law.so
 *
 * A library exports one function, void strut_law(const struct strut_step* step), which takes one step of some
 * integration points side by side: component c of point p is at [c * points + p]. Tensors have the components xx yy zz
 * xy yz zx, with shear strains as a tensor has them (half of engineering ones), in the frame that follows the rotation
 * of the point (Flanagan & Taylor 1987): nothing turns there, and the deformation gradient is the stretch U. SI units. */
#ifndef STRUT_LAW_H
#define STRUT_LAW_H

#ifdef __cplusplus
extern "C" {
#endif

struct strut_step {
  int points; /* 1 or more */
  int constant_count, state_count;
  const double* constants; /* of the deck, in their order */
  const double* time;      /* [points] s, since the start of the run, at the start of the step */
  const double* dt;        /* [points] s */

  const double* rate;        /* [6][points] 1/s, rate of deformation d at mid-step */
  const double* strain;      /* [6][points] sum of d dt before the step */
  const double* old_stretch; /* [6][points] U at the start and */
  const double* stretch;     /* [6][points] at the end of the step */
  const double* J;           /* [points] det U at the end of the step */

  double* stress;     /* [6][points] Pa, Cauchy: that of the start, to be replaced by that of the end */
  double* state;      /* [state_count][points] likewise; zeros in the undeformed state */
  double* stored;     /* [points] J/m3 of the undeformed volume: elastic energy, likewise */
  double* dissipated; /* [points] J/m3 of the undeformed volume: all dissipation so far, likewise */
  int* failed;        /* [points] zeros; set to 1 where no stress was found, which ends the run there */
};

#ifdef __cplusplus
}
#endif

#endif

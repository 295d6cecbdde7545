/* Prints the torques of a few steps beside a robot file. */
#include <math.h>
#include <stdio.h>

#include "effects.h"

int main(void) {
  effects_state s;
  double q[EFFECTS_JOINTS], qd[EFFECTS_JOINTS], u[EFFECTS_JOINTS],
      out[EFFECTS_JOINTS];
  effects_reset(&s, BESIDE, NULL);
  for (int k = 0; k < 20; ++k) {
    for (int j = 0; j < EFFECTS_JOINTS; ++j) {
      q[j] = .1 * sin(.3 * k + j);
      qd[j] = 3 * cos(.3 * k + j);
      u[j] = 5 * sin(.2 * k + 2 * j);
    }
    effects_sense(&s, .01, q, qd, out);
    effects_act(&s, u, NULL, out);
    for (int j = 0; j < EFFECTS_JOINTS; ++j)
      printf("%.9g %.9g\n", out[j], s.damping[j]);
  }
  return 0;
}

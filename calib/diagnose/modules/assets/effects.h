/* The laws of effects_data.h in the loop of a simulator of rigid bodies.
   Written by armcal.

     effects_state s;
     effects_reset(&s, 0, NULL);
     each step of dt:
       effects_sense(&s, dt, q, qd, positions);    what encoders say
       effects_act(&s, commanded, NULL, torque);   to be given to the joints

   The module holds all of the joints' friction, their constant torques and the
   effects: the simulator's joints have none of their own, and as rotor inertia
   effects_armature(). With effects_reset(&s, EFFECTS_IN_MJCF, NULL)
   (.._MJCF_PLAIN, _URDF, _SDF, _YAML) it holds what that robot file lacks, and
   the simulator the rest; not where a joint yields. Compared with what armcal's
   own laws gave:

     cc -std=c99 -DEFFECTS_TEST effects.c -lm && ./a.out

   C99 and its libm, no allocation, no global state. SI units; arrays have
   EFFECTS_JOINTS entries, from the base on. */

#ifndef EFFECTS_H
#define EFFECTS_H

#include "effects_data.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  double t;                      /* s, of the log that was diagnosed */
  double warmth[EFFECTS_JOINTS]; /* K above the surroundings */
  /* Of the motors; the links'; what drives hand to them. */
  double position[EFFECTS_JOINTS], velocity[EFFECTS_JOINTS];
  double link_position[EFFECTS_JOINTS], link_velocity[EFFECTS_JOINTS];
  double load[EFFECTS_JOINTS];
  /* After effects_act(): how fast the torque falls with velocity, >= 0, and the
     torque with damping times velocity added. A simulator whose joints are
     implicit in their damping is given both, and steps through standstill
     without chatter. */
  double damping[EFFECTS_JOINTS], undamped[EFFECTS_JOINTS];
  /* The module's own. */
  double bristles[EFFECTS_LAWS];
  double lag[EFFECTS_JOINTS], commanded[EFFECTS_JOINTS], given[EFFECTS_JOINTS];
  double drive[EFFECTS_JOINTS], heat[EFFECTS_JOINTS], change[EFFECTS_JOINTS];
  double missing[EFFECTS_JOINTS], ends[EFFECTS_JOINTS];
  unsigned beside;
  int started, acted, load_known;
} effects_state;

/* To the begin, cold. `beside`: the robot file whose part the simulator holds,
   0: none. `load`: what joints hold at rest and wind up springs by, or NULL. */
void effects_reset(effects_state* s, unsigned beside, const double* load);
/* The simulator's joints are at q, qd, dt after the call before. */
void effects_sense(effects_state* s, double dt, const double* q,
                   const double* qd, double* positions);
/* `load`: what joints hand to their links if the simulator knows, or NULL. */
void effects_act(effects_state* s, const double* commanded, const double* load,
                 double* torque);
/* The rotor inertia that the simulator's joint is to have. */
double effects_armature(int joint);
/* Torque is recorded this much later than it acts, s. */
double effects_record_delay(void);

#ifdef __cplusplus
}
#endif

#endif

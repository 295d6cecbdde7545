/* See effects.h. */

#define EFFECTS_TABLES
#include "effects.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#define N EFFECTS_JOINTS

typedef struct effects_law law_t;

/* Of differences for slopes. */
static const double velocity_step = 1e-4, deflection_step = 1e-6;
/* Of a motor on its spring. */
static const double phase_per_substep = .05;
static const int most_substeps = 100;

/* What a motor gives of its command. */

/* x + fall x^3 = y has one real root. */
static double nonlinearity(double u, const double* p) {
  if (p[0] <= 0) return u;
  const double a = sqrt(3 * p[0]);
  return p[1] * 2 / a * sinh(asinh(1.5 * a * u / p[1]) / 3);
}

static double softplus(double x) {
  if (fabs(x) > 25) return fmax(x, 0);
  return log1p(exp(x));
}

/* A limit of current, or of voltage, which falls with the speed along the
 * torque. */
static double saturation(double u, double v, const double* p) {
  const double share = p[0], at_rest = p[1], slope = p[2], knee = p[4];
  const double limit = fmax(p[3], at_rest - slope * copysign(v, v * u));
  const double w = knee * limit;
  const double passed =
      w * (softplus(1 / knee) - softplus((limit - fabs(u)) / w));
  return u - share * (u - copysign(passed, u));
}

/* x + d tanh(x / s) = y by Newton's steps, which rise to x. */
static double deadband(double u, const double* p) {
  const double d = p[0], s = p[1], y = fabs(u);
  if (d <= 0) return u;
  double x = fmax(0, y - d);
  for (int i = 0; i < 20; ++i) {
    const double t = tanh(x / s);
    const double step = (y - x - d * t) / (1 + d / s * (1 - t * t));
    x += step;
    if (fabs(step) <= 1e-12 * (x + s)) break;
  }
  return copysign(x, u);
}

static void command(const law_t* law, const double* velocity, double* torque) {
  const double* p = law->p;
  double* u = &torque[law->joint];
  switch (law->kind) {
    case EFFECTS_TORQUE_GAIN:
      *u /= 1 + p[0];
      break;
    case EFFECTS_TORQUE_OFFSET:
      *u -= p[0];
      break;
    case EFFECTS_TORQUE_NONLINEARITY:
      *u = nonlinearity(*u, p);
      break;
    case EFFECTS_TORQUE_SATURATION:
      *u = saturation(*u, velocity[law->joint], p);
      break;
    case EFFECTS_TORQUE_DEADBAND:
      *u = deadband(*u, p);
      break;
    case EFFECTS_TORQUE_CROSSTALK:
      *u -= p[0] * torque[law->neighbour];
      break;
    default:
      break;
  }
}

/* Torques on joints. */

static double wave(const double* p, double x) {
  return p[0] * sin(x) + p[1] * cos(x);
}

static double coupled(const effects_state* s, const law_t* law) {
  const double* p = law->p;
  const double u = s->velocity[law->joint] + p[2] * s->velocity[law->neighbour];
  return -(p[0] * tanh(u / p[3]) + p[1] * u);
}

static double thermal(const double* p, double v, double warmth) {
  return -p[0] * v * expm1(-p[2] * warmth) -
         p[1] * tanh(v / p[4]) * expm1(-p[3] * warmth);
}

/* Of the law number k, N m or N; 0 of what is none. */
static double law_torque(const effects_state* s, int k) {
  const law_t* law = &effects_laws[k];
  const double* p = law->p;
  const double q = s->position[law->joint], v = s->velocity[law->joint];
  switch (law->kind) {
    case EFFECTS_CONSTANT:
      return -p[0];
    case EFFECTS_VISCOUS_FRICTION:
      return -p[0] * v;
    case EFFECTS_COULOMB_FRICTION:
      return -p[0] * tanh(v / p[1]);
    case EFFECTS_YIELDING_FRICTION:
    case EFFECTS_PRESLIDING:
      return -p[0] * s->bristles[k];
    case EFFECTS_ASYMMETRIC_FRICTION:
      return -p[0] * fabs(v);
    case EFFECTS_QUADRATIC_FRICTION:
      return -p[0] * v * fabs(v);
    case EFFECTS_STRIBECK:
      return -p[0] * exp(-v * v / (p[1] * p[1])) * tanh(v / p[2]);
    case EFFECTS_LOAD_FRICTION:
      return -p[0] * fabs(s->load[law->joint]) * tanh(v / p[1]);
    case EFFECTS_POSITION_FRICTION:
      return -wave(p, p[2] * q) * tanh(v / p[3]);
    case EFFECTS_COUPLED_FRICTION:
      return coupled(s, law);
    case EFFECTS_THERMAL_FRICTION:
      return thermal(p, v, s->warmth[law->joint]);
    case EFFECTS_SPRING:
      return p[1] - p[0] * q;
    case EFFECTS_CABLE:
      return -p[0] * tanh((q - p[1]) / p[2]);
    case EFFECTS_TORQUE_RIPPLE:
      return -wave(p, p[2] * q);
    case EFFECTS_VIBRATION:
      return wave(p, 2 * 3.14159265358979323846 * p[2] * s->t);
    case EFFECTS_TIME_DRIFT:
      return p[0] * expm1(-(s->t - p[2]) / p[1]);
    default:
      return 0;
  }
}

static int heats(const law_t* law) {
  switch (law->kind) {
    case EFFECTS_CONSTANT:
    case EFFECTS_SPRING:
    case EFFECTS_CABLE:
    case EFFECTS_TORQUE_RIPPLE:
    case EFFECTS_VIBRATION:
    case EFFECTS_TIME_DRIFT:
      return 0;
    default:
      return 1;
  }
}

/* Of law k on joint j; a bearing between two joints acts on both. */
static double torque_on(const effects_state* s, int k, int j) {
  const law_t* law = &effects_laws[k];
  if (law->joint == j) return law_torque(s, k);
  if (law->kind == EFFECTS_COUPLED_FRICTION && law->neighbour == j) {
    return law->p[2] * law_torque(s, k);
  }
  return 0;
}

/* Of commands, that the simulator does not hold. */
static int lags(const effects_state* s) {
  return effects_delay < 0 && (effects_delay_in & s->beside) == 0;
}

static int is_held(const effects_state* s, int k) {
  return (effects_laws[k].in & s->beside) != 0;
}

/* Of all laws that the simulator does not hold. */
static double on_motor(const effects_state* s, int j) {
  double torque = 0;
  for (int k = 0; k < EFFECTS_LAWS; ++k) {
    const law_t* law = &effects_laws[k];
    if (is_held(s, k)) continue;
    torque += torque_on(s, k, j);
    if (s->beside == 0 || law->joint != j) continue;
    /* What stands in the robot file in its stead. */
    torque += law->share.viscous * s->velocity[j];
    if (law->share.coulomb != 0) {
      torque += law->share.coulomb * tanh(s->velocity[j] / law->share.width);
    }
    if (s->beside & effects_offset_in) torque += law->share.offset;
  }
  return torque;
}

static double friction_slope(effects_state* s, int j) {
  const double v = s->velocity[j];
  s->velocity[j] = v + velocity_step;
  const double ahead = on_motor(s, j);
  s->velocity[j] = v - velocity_step;
  const double behind = on_motor(s, j);
  s->velocity[j] = v;
  return (ahead - behind) / (2 * velocity_step);
}

/* Bristles of the laws of joint j bend as it moves, by `move` rad or m. */
static void follow(effects_state* s, int j, double move) {
  for (int k = 0; k < EFFECTS_LAWS; ++k) {
    const law_t* law = &effects_laws[k];
    double* z = &s->bristles[k];
    if (law->joint != j) continue;
    if (law->kind == EFFECTS_PRESLIDING && move != 0) {
      const double end = copysign(1, move);
      *z = end + (*z - end) * exp(-fabs(move) / law->p[1]);
    }
    if (law->kind == EFFECTS_YIELDING_FRICTION) {
      *z = fmin(1, fmax(-1, *z + move / law->p[1]));
    }
  }
}

/* Between motors and links. */

static const law_t* spring_of(int j) {
  for (int k = 0; k < EFFECTS_LAWS; ++k) {
    const law_t* law = &effects_laws[k];
    const int yields =
        law->kind == EFFECTS_ELASTICITY || law->kind == EFFECTS_BACKLASH;
    if (yields && law->joint == j) return law;
  }
  return NULL;
}

static double stiffness_of(const law_t* spring) {
  return spring->kind == EFFECTS_BACKLASH ? spring->p[1] : spring->p[0];
}

static double spring_torque(const effects_state* s, const law_t* law,
                            double more, double faster) {
  const int j = law->joint;
  const double* p = law->p;
  const double d = s->position[j] - s->link_position[j] + more;
  const double rate = s->velocity[j] - s->link_velocity[j] + faster;
  if (law->kind == EFFECTS_ELASTICITY) {
    return p[0] * d * (1 + p[2] * d * d) + p[1] * rate;
  }
  /* Flanks that press and never pull; the corner of a ramp is a parabola from
   * -1 to 1. */
  const double side = d < 0 ? -1 : 1, w = .005 * p[0];
  const double x = (fabs(d) - p[0] / 2) / w;
  const double slope = fmin(1, fmax(0, (1 + x) / 2));
  const double ramp = x > 1 ? x : slope * slope;
  return side * fmax(0, p[1] * w * ramp + p[2] * slope * side * rate);
}

static double slope_over_rate(const effects_state* s, const law_t* law) {
  return (spring_torque(s, law, 0, velocity_step) -
          spring_torque(s, law, 0, -velocity_step)) /
         (2 * velocity_step);
}

static double slope_over_deflection(const effects_state* s, const law_t* law) {
  return (spring_torque(s, law, deflection_step, 0) -
          spring_torque(s, law, -deflection_step, 0)) /
         (2 * deflection_step);
}

/* An implicit midpoint step of the linearised law. */
static void motor_step(effects_state* s, const law_t* spring, double h) {
  const int j = spring->joint;
  const double force =
      s->given[j] + on_motor(s, j) - spring_torque(s, spring, 0, 0);
  const double by_q = -slope_over_deflection(s, spring);
  const double friction_by_v = friction_slope(s, j);
  const double by_v = friction_by_v - slope_over_rate(s, spring);
  const double v = s->velocity[j];
  const double rate =
      (force + h / 2 * by_q * v) /
      (effects_joints[j].armature - h / 2 * by_v - h * h / 4 * by_q);
  const double move = h * (v + h / 2 * rate);
  s->missing[j] += s->given[j] + on_motor(s, j) +
                   (h / 2 * friction_by_v - effects_joints[j].armature) * rate;
  follow(s, j, move);
  s->position[j] += move;
  s->velocity[j] += h * rate;
}

/* A motor on its spring while its link moves evenly. */
static void advance_motor(effects_state* s, const law_t* spring, double dt,
                          double link_before) {
  if (!s->acted) return;
  const int j = spring->joint;
  const double end = s->link_position[j], end_velocity = s->link_velocity[j];
  const double phase =
      dt * sqrt(stiffness_of(spring) / effects_joints[j].armature);
  const int count =
      (int)fmin(most_substeps, fmax(1, ceil(phase / phase_per_substep)));
  s->link_velocity[j] = (end - link_before) / dt;
  s->missing[j] = 0;
  for (int k = 0; k < count; ++k) {
    s->link_position[j] = link_before + (end - link_before) * (k + .5) / count;
    motor_step(s, spring, dt / count);
  }
  s->link_position[j] = end;
  s->link_velocity[j] = end_velocity;
  /* What the motor felt in the mean and the ends did not show. */
  s->missing[j] =
      s->missing[j] / count - (s->ends[j] + spring_torque(s, spring, 0, 0)) / 2;
}

/* Lags of commands, warmth and loads until now. */
static void advance_slow_states(effects_state* s, double dt, const double* qd) {
  if (!s->acted) return;
  for (int j = 0; j < N; ++j) {
    if (lags(s)) {
      s->lag[j] -= expm1(dt / effects_delay) * (s->commanded[j] - s->lag[j]);
    }
    s->load[j] =
        s->drive[j] - effects_armature(j) * (qd[j] - s->link_velocity[j]) / dt;
  }
  for (int k = 0; k < EFFECTS_LAWS; ++k) {
    const law_t* law = &effects_laws[k];
    if (law->kind != EFFECTS_THERMAL_FRICTION) continue;
    const int j = law->joint;
    const double capacity = law->p[5], resistance = law->p[6];
    const double kept = exp(-dt / (resistance * capacity));
    s->warmth[j] = kept * s->warmth[j] + resistance * s->heat[j] * (1 - kept);
  }
}

static void advance(effects_state* s, double dt, const double* q,
                    const double* qd) {
  double before[N];
  advance_slow_states(s, dt, qd);
  memcpy(before, s->link_position, sizeof(before));
  for (int j = 0; j < N; ++j) s->change[j] = qd[j] - s->link_velocity[j];
  memcpy(s->link_position, q, sizeof(before));
  memcpy(s->link_velocity, qd, sizeof(before));
  for (int j = 0; j < N; ++j) {
    if (spring_of(j) != NULL) continue;
    follow(s, j, q[j] - before[j]);
    s->position[j] = q[j];
    s->velocity[j] = qd[j];
  }
  for (int j = 0; j < N; ++j) {
    if (spring_of(j) != NULL) advance_motor(s, spring_of(j), dt, before[j]);
  }
  s->t += dt;
}

static void start(effects_state* s, const double* q, const double* qd) {
  s->started = 1;
  for (int j = 0; j < N; ++j) {
    const law_t* spring = spring_of(j);
    const double load = s->load[j];
    s->link_position[j] = s->position[j] = q[j];
    s->link_velocity[j] = s->velocity[j] = qd[j];
    if (spring == NULL) continue;
    if (spring->kind == EFFECTS_BACKLASH && load != 0) {
      s->position[j] += copysign(spring->p[0] / 2, load);
    }
    s->position[j] += load / stiffness_of(spring);
  }
}

void effects_reset(effects_state* s, unsigned beside, const double* load) {
  memset(s, 0, sizeof(*s));
  s->beside = beside;
  if (load == NULL) return;
  memcpy(s->load, load, sizeof(s->load));
  s->load_known = 1;
}

void effects_sense(effects_state* s, double dt, const double* q,
                   const double* qd, double* positions) {
  if (s->started) {
    advance(s, dt, q, qd);
  } else {
    start(s, q, qd);
  }
  memcpy(positions, s->position, sizeof(s->position));
  for (int k = 0; k < EFFECTS_LAWS; ++k) {
    const law_t* law = &effects_laws[k];
    if (law->kind == EFFECTS_ENCODER_OFFSET) positions[law->joint] += law->p[0];
  }
}

/* What the drives hand on, all laws counted, and what warms the joints. */
static void set_drive(effects_state* s) {
  memset(s->heat, 0, sizeof(s->heat));
  memcpy(s->drive, s->given, sizeof(s->drive));
  for (int k = 0; k < EFFECTS_LAWS; ++k) {
    for (int j = 0; j < N; ++j) {
      const double torque = torque_on(s, k, j);
      s->drive[j] += torque;
      if (heats(&effects_laws[k])) s->heat[j] -= torque * s->velocity[j];
    }
  }
}

void effects_act(effects_state* s, const double* commanded, const double* load,
                 double* torque) {
  if (!s->acted) {
    memcpy(s->lag, commanded, sizeof(s->lag));
    if (!s->load_known) memcpy(s->load, commanded, sizeof(s->load));
  }
  s->acted = 1;
  if (load != NULL) memcpy(s->load, load, sizeof(s->load));
  memcpy(s->commanded, commanded, sizeof(s->commanded));
  memcpy(s->given, lags(s) ? s->lag : commanded, sizeof(s->given));
  memcpy(torque, s->given, sizeof(s->given));
  for (int k = 0; k < EFFECTS_LAWS; ++k) {
    command(&effects_laws[k], s->velocity, s->given);
    if (!is_held(s, k)) command(&effects_laws[k], s->velocity, torque);
  }
  set_drive(s);
  for (int j = 0; j < N; ++j) {
    const law_t* spring = spring_of(j);
    torque[j] += on_motor(s, j);
    s->damping[j] =
        fmax(0, spring ? slope_over_rate(s, spring) : -friction_slope(s, j));
    if (spring != NULL) {
      s->ends[j] = spring_torque(s, spring, 0, 0);
      s->drive[j] = torque[j] = s->ends[j] + s->missing[j];
    }
    /* A motor that yields goes along with its link, about as that went before.
     */
    s->undamped[j] =
        torque[j] + s->damping[j] * (s->link_velocity[j] +
                                     (spring != NULL ? s->change[j] : 0));
  }
}

double effects_armature(int joint) {
  return spring_of(joint) != NULL ? 0 : effects_joints[joint].armature;
}

double effects_record_delay(void) {
  return effects_delay > 0 ? effects_delay : 0;
}

#ifdef EFFECTS_TEST

#include <stdio.h>

/* The worst of N differences. */
static double differs(const double* found, const double* expected,
                      double largest) {
  double worst = 0;
  for (int j = 0; j < N; ++j)
    worst = fmax(worst, fabs(found[j] - expected[j]) / largest);
  return worst;
}

int main(void) {
  effects_state s;
  double worst = 0;
  effects_reset(&s, 0, effects_test_load);
  s.t = effects_test_t;
  memcpy(s.warmth, effects_test_warmth, sizeof(s.warmth));
  for (size_t k = 0; k < sizeof(effects_test) / sizeof(effects_test[0]); ++k) {
    const struct effects_test_step* step = &effects_test[k];
    double reading[N], torque[N];
    effects_sense(&s, effects_test_dt, step->q, step->qd, reading);
    effects_act(&s, step->commanded, step->has_load ? step->load : NULL,
                torque);
    worst =
        fmax(worst, differs(reading, step->reading, effects_test_largest[0]));
    worst = fmax(worst, differs(torque, step->torque, effects_test_largest[1]));
    worst =
        fmax(worst, differs(s.damping, step->damping, effects_test_largest[2]));
    worst = fmax(worst,
                 differs(s.undamped, step->undamped, effects_test_largest[3]));
  }
  printf("%s: differs by %.1e\n", worst <= 1e-9 ? "ok" : "FAILED", worst);
  return worst <= 1e-9 ? 0 : 1;
}

#endif

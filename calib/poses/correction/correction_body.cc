#include "calib/poses/correction/correction_body.h"

namespace armcal {

// Poses are 3 x 4 matrices, row by row.
const char kCorrectionBody[] = R"(
static void pose_times(const double a[12], const double b[12], double ab[12]) {
  double out[12];
  int i, j, k;
  for (i = 0; i < 3; ++i) {
    for (j = 0; j < 4; ++j) {
      out[4 * i + j] = j == 3 ? a[4 * i + 3] : 0;
      for (k = 0; k < 3; ++k) out[4 * i + j] += a[4 * i + k] * b[4 * k + j];
    }
  }
  for (i = 0; i < 12; ++i) ab[i] = out[i];
}

/* Rotation by a rotation vector (Rodrigues), without translation. */
static void turned(const double v[3], double pose[12]) {
  const double angle = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  const double s = angle < 1e-12 ? 1 : sin(angle) / angle;
  const double c = angle < 1e-6 ? .5 : (1 - cos(angle)) / (angle * angle);
  int i, j;
  for (i = 0; i < 3; ++i) {
    const int y = (i + 1) % 3, z = (i + 2) % 3;
    for (j = 0; j < 3; ++j) pose[4 * i + j] = c * v[i] * v[j];
    pose[4 * i + i] += cos(angle);
    pose[4 * i + y] -= s * v[z];
    pose[4 * i + z] += s * v[y];
    pose[4 * i + 3] = 0;
  }
}

/* The tool by `links`; where `frames` and `bodies` are given, also each joint's
   frame, whose z axis is the joint's, and each link's own. */
static void tool_pose(const struct link links[], const double q[],
                      double pose[12], double frames[][12],
                      double bodies[][12]) {
  double moved[12];
  int i, k;
  for (i = 0; i < 12; ++i) pose[i] = i % 5 == 0;
  for (i = 0; i < JOINTS; ++i) {
    pose_times(pose, links[i].before, pose);
    for (k = 0; frames && k < 12; ++k) frames[i][k] = pose[k];
    for (k = 0; k < 12; ++k) moved[k] = k % 5 == 0;
    if (links[i].slides) {
      moved[11] = q[i];
    } else {
      moved[0] = moved[5] = cos(q[i]);
      moved[4] = sin(q[i]);
      moved[1] = -moved[4];
    }
    pose_times(pose, moved, pose);
    pose_times(pose, links[i].after, pose);
    for (k = 0; bodies && k < 12; ++k) bodies[i][k] = pose[k];
  }
  pose_times(pose, tool, pose);
}

static double triple(const double a[3], const double b[3], const double c[3]) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) +
         a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* What a term's displacement goes with, where joints were recorded at q and
   stand at `at` but for their zeros. */
static double signal_of(const struct term* t, const double q[],
                        const double at[]) {
  double pose[12], frames[JOINTS][12], bodies[JOINTS][12];
  double axis[3] = {0, 0, 0}, lever[3], standing[JOINTS];
  const int j = t->of;
  int i, k;
  for (i = 0; i < JOINTS; ++i) standing[i] = at[i] + zeros[i];
  if (t->kind == ONE) return 1;
  if (t->kind == POSITION) return q[j];
  if (t->kind == SINE) return sin(t->harmonic * standing[j]);
  if (t->kind == COSINE) return cos(t->harmonic * standing[j]);
  tool_pose(by_file, standing, pose, frames, bodies);
  if (t->kind == TOOL_GRAVITY) {
    return pose[j] * down[0] + pose[4 + j] * down[1] + pose[8 + j] * down[2];
  }
  for (k = 0; k < 3; ++k) lever[k] = pose[4 * k + 3];
  if (t->kind == BASE_MOMENT) {
    axis[j] = 1;
    return triple(axis, lever, down);
  }
  if (by_file[j].slides) return 0;
  for (k = 0; k < 3; ++k) {
    axis[k] = frames[j][4 * k + 2];
    lever[k] -= frames[j][4 * k + 3];
    if (t->kind == LINK_MOMENT || t->kind == WEIGHT_MOMENT) lever[k] = 0;
    for (i = j; t->kind == WEIGHT_MOMENT && i < JOINTS; ++i) {
      lever[k] += weights[i][0] * (bodies[i][4 * k + 3] - frames[j][4 * k + 3]) +
                  weights[i][1] * bodies[i][4 * k] +
                  weights[i][2] * bodies[i][4 * k + 1] +
                  weights[i][3] * bodies[i][4 * k + 2];
    }
    for (i = j + 1; t->kind == LINK_MOMENT && i < JOINTS; ++i) {
      lever[k] += (frames[i][4 * k + 3] - frames[j][4 * k + 3]) / (JOINTS - j);
    }
  }
  lever[0] = triple(axis, lever, down);
  if (t->kind == LOAD_SIDE) return (lever[0] > 0) - (lever[0] < 0);
  return lever[0];
}

void armcal_actual_pose(const double q[JOINTS], double pose[12]) {
  double standing[JOINTS], joints[JOINTS], moved[9], part[12];
  int pass, i;
  for (i = 0; i < JOINTS; ++i) standing[i] = q[i];
  /* Signals are of where joints stand, which signals displace. */
  for (pass = 0; pass < 2; ++pass) {
    for (i = 0; i < JOINTS; ++i) joints[i] = 0;
    for (i = 0; i < 9; ++i) moved[i] = 0;
    for (i = 0; i < TERMS; ++i) {
      const double by = terms[i].amount * signal_of(&terms[i], q, standing);
      if (terms[i].moves == JOINT) joints[terms[i].index] += by;
      if (terms[i].moves == BASE) moved[terms[i].index] += by;
      if (terms[i].moves == TOOL) moved[3 + terms[i].index] += by;
    }
    for (i = 0; i < JOINTS; ++i) standing[i] = q[i] + joints[i];
  }
  tool_pose(refined, standing, pose, 0, 0);
  turned(moved, part);
  pose_times(part, pose, pose);
  turned(moved + 6, part);
  for (i = 0; i < 3; ++i) part[4 * i + 3] = moved[3 + i];
  pose_times(pose, part, pose);
}

void armcal_file_pose(const double q[JOINTS], double pose[12]) {
  tool_pose(by_file, q, pose, 0, 0);
}

/* Position and LEVER times the rotation vector that lead from one pose to
   another, of small rotations. */
static void away(const double from[12], const double to[12], double d[6]) {
  double R[9], s, angle, v[3];
  int i, j, k;
  for (i = 0; i < 3; ++i) {
    d[i] = to[4 * i + 3] - from[4 * i + 3];
    for (j = 0; j < 3; ++j) {
      R[3 * i + j] = 0;
      for (k = 0; k < 3; ++k) R[3 * i + j] += to[4 * i + k] * from[4 * j + k];
    }
  }
  for (i = 0; i < 3; ++i) {
    const int y = (i + 1) % 3, z = (i + 2) % 3;
    v[i] = .5 * (R[3 * z + y] - R[3 * y + z]);
  }
  s = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  angle = atan2(s, .5 * (R[0] + R[4] + R[8] - 1));
  for (i = 0; i < 3; ++i) d[3 + i] = LEVER * (s < 1e-12 ? 1 : angle / s) * v[i];
}

/* Adds to q what brings `pose_at` to `wanted`: damped Gauss-Newton steps, of
   which the nearest is kept. Returns whether it is met. */
static int reach(void (*pose_at)(const double[], double[]),
                  const double wanted[12], double q[JOINTS]) {
  double pose[12], other[12], d[6], J[JOINTS][6], A[JOINTS][JOINTS], b[JOINTS];
  double nearest[JOINTS], least = -1;
  int step, i, j, k;
  for (step = 0; step <= STEPS; ++step) {
    double most = 0, miss = 0;
    pose_at(q, pose);
    away(pose, wanted, d);
    for (k = 0; k < 6; ++k) miss += d[k] * d[k];
    for (i = 0; (least < 0 || miss < least) && i < JOINTS; ++i) nearest[i] = q[i];
    if (least < 0 || miss < least) least = miss;
    for (i = 0; i < JOINTS; ++i) {
      const double was = q[i];
      q[i] += DIFFERENCE;
      pose_at(q, other);
      q[i] = was;
      away(pose, other, J[i]);
      for (k = 0; k < 6; ++k) J[i][k] /= DIFFERENCE;
    }
    for (i = 0; i < JOINTS; ++i) {
      for (j = 0; j < JOINTS; ++j) {
        A[i][j] = i == j ? DAMPING * DAMPING : 0;
        for (k = 0; k < 6; ++k) A[i][j] += J[i][k] * J[j][k];
      }
      for (b[i] = 0, k = 0; k < 6; ++k) b[i] += J[i][k] * d[k];
    }
    /* A is positive definite: elimination needs no pivoting. */
    for (i = 0; i < JOINTS; ++i) {
      for (j = i + 1; j < JOINTS; ++j) {
        const double f = A[j][i] / A[i][i];
        for (k = i; k < JOINTS; ++k) A[j][k] -= f * A[i][k];
        b[j] -= f * b[i];
      }
    }
    for (i = JOINTS - 1; i >= 0; i -= 1) {
      for (j = i + 1; j < JOINTS; ++j) b[i] -= A[i][j] * b[j];
      b[i] /= A[i][i];
      if (fabs(b[i]) > most) most = fabs(b[i]);
    }
    if (most < SETTLED) break;
    for (i = 0; i < JOINTS; ++i) q[i] += b[i];
  }
  for (i = 0; i < JOINTS; ++i) q[i] = nearest[i];
  return least < MET * MET;
}

/* What brings `pose_at` from q to where `goal` is at q. */
static int correction(void (*pose_at)(const double[], double[]),
                      void (*goal)(const double[], double[]),
                      const double q[JOINTS], double dq[JOINTS]) {
  double wanted[12], at[JOINTS];
  int i, met;
  for (i = 0; i < JOINTS; ++i) at[i] = q[i];
  goal(q, wanted);
  met = reach(pose_at, wanted, at);
  for (i = 0; i < JOINTS; ++i) dq[i] = at[i] - q[i];
  return met;
}

int armcal_forward_correction(const double q[JOINTS], double dq[JOINTS]) {
  return correction(armcal_file_pose, armcal_actual_pose, q, dq);
}

int armcal_command_correction(const double q[JOINTS], double dq[JOINTS]) {
  return correction(armcal_actual_pose, armcal_file_pose, q, dq);
}
)";

}  // namespace armcal

#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/commanded_reference.h"
#include "model/arm_plan.h"
#include "model/joint_controller.h"
#include "model/motion_tangent.h"

namespace armcal {

// An arm and what of its controller can be estimated.
struct LoopValues {
  RolloutArm arm;              // Coulomb friction by velocity laws
  Eigen::VectorXd kp, kd, ki;  // as ControllerOptions has them
  double delay = 0;            // s, of the command
  // Simulated steps of a control period; more where friction would not leave
  // them stable.
  int substeps = 1;
};

// Enough of them for friction some times the values'.
int EnoughSubsteps(const LoopValues& values, double rate_hz);

// Where a window of a log begins.
struct LoopStart {
  Eigen::VectorXd q, qd;     // rad, rad/s, or m
  Eigen::VectorXd integral;  // of the controller, N m or N
};

// A control period, linearised: of (q, qd), 2 n, by itself and by the torque,
// n; and which torques are free: neither limited nor, for the integral,
// stopped.
struct LoopPeriod {
  Eigen::MatrixXd step;             // 2 n x 3 n
  Eigen::ArrayXd acts, integrates;  // 1 or 0
};

// A stretch of a log simulated in closed loop with its derivatives.
struct LoopRun {
  bool finite = true;
  // Measured minus simulated positions, joint j of row k at n k + j, rad or m.
  Eigen::VectorXd residual;
  // Of simulated positions by LoopColumns, in the same rows; if asked for.
  Eigen::MatrixXd by_values;
  std::vector<LoopPeriod> periods;  // if asked for
  // Period in which each row lies, and after which share of it.
  std::vector<long> period_of_row;
  std::vector<double> share_of_row;
  Eigen::VectorXd torque_squares;  // of all periods, per joint
};

// How a row lies between the begin and the end of its period, s: the position
// by q and qd there, a Hermite cubic.
struct RowWeights {
  RowWeights(double share, double period);
  double q0, qd0, q1, qd1;
};

// Columns of derivatives: MotionTangent's, gains, delay, start.
struct LoopColumns {
  explicit LoopColumns(int num_joints) : n(num_joints) {}
  int kp() const { return 15 * n; }
  int kd() const { return 16 * n; }
  int ki() const { return 17 * n; }
  int delay() const { return 18 * n; }
  int num_values() const { return 18 * n + 1; }
  int start() const { return num_values(); }  // q, qd, integral
  int size() const { return num_values() + 3 * n; }
  int n;
};

// Simulates rows of a log, from where they begin to where they end: the arm
// under a position controller that follows the log's command (JointController
// with DifferencedVelocity, drives of kPd or kP without lag), which begins a
// period at the first row.
class PositionLoop {
 public:
  enum class Wanted { kResidual, kTangents, kPeriods };

  PositionLoop(const ControllerOptions& controller,
               const CommandedReference& reference, const Log& log);

  LoopRun Run(const LoopValues& values, const LoopStart& start, long first_row,
              long num_rows, Wanted wanted) const;
  // At rest's torque, or moving as the log does.
  LoopStart StartAt(long first_row) const;

 private:
  ControllerOptions controller_;
  const CommandedReference& reference_;
  const Log& log_;
};

}  // namespace armcal

#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "calib/closed_loop_replay.h"
#include "calib/log_set.h"
#include "calib/position_loop.h"

namespace armcal {

// What all windows of logs say of a loop's values about some of them, the
// windows' starts eliminated; whitened by the encoders' noise.
struct LoopEquations {
  bool finite = true;  // else nothing follows
  Eigen::MatrixXd R;   // R dx = z, triangular
  Eigen::VectorXd z;
  double cost = 0;  // the residuals' squares, and the starts' priors'
  Eigen::VectorXd torque_rms;  // per joint
  // Of each window: where it starts (q, qd, integral), and the triangle of
  // start, values and residual.
  struct Window {
    Eigen::VectorXd start;
    Eigen::MatrixXd triangle;
  };
  std::vector<Window> windows;
};

// What encoder noise makes of the scores of such equations.
struct LoopScores {
  Eigen::MatrixXd covariance;  // of all values
  // The scores themselves, summed over a second each: a row per second.
  Eigen::MatrixXd sums;
  double residual_squares = 0;
  double expected_squares = 0;  // by noise alone
};

// Logs of commands and positions cut into windows that are simulated each from
// a state of its own.
class LoopWindows {
 public:
  // Logs and controller are kept by reference.
  LoopWindows(const Robot& known, const ControllerOptions& controller,
              double window_s, const std::vector<CommandedLog>& logs);

  // At `values`; the starts are those of Move.
  LoopEquations Linearise(const LoopValues& values,
                          const Progress& progress) const;
  // Takes the starts to where `equations` put them for a step `dx` of the
  // values, times `share`.
  void Move(const LoopEquations& equations, const Eigen::VectorXd& dx,
            double share);
  // Of equations at `values`.
  LoopScores Scores(const LoopValues& values,
                    const LoopEquations& equations) const;
  // rms of residuals per joint, rad or m, without each window's first second.
  Eigen::VectorXd ResidualRms(const LoopValues& values) const;
  // Of the encoders, per joint, rad or m: all logs'.
  const Eigen::VectorXd& noise() const { return noise_; }

 private:
  struct Window {
    int log;
    long first, rows;
    LoopStart nominal;
    Eigen::VectorXd start;  // q, qd, integral
  };
  LoopStart StartOf(const Eigen::VectorXd& start) const;
  void AddWindows(int log, double window_s);
  Eigen::VectorXd StartPrior() const;
  Eigen::VectorXd RowScale(long rows) const;

  const ControllerOptions& controller_;
  const std::vector<CommandedLog>& logs_;
  std::vector<std::unique_ptr<const CommandedReference>> references_;
  std::vector<std::unique_ptr<const PositionLoop>> loops_;
  std::vector<Window> windows_;
  Eigen::VectorXd noise_;
  int n_;
};

}  // namespace armcal

#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "calib/closed_loop/columns.h"
#include "calib/closed_loop/replay.h"
#include "calib/closed_loop/simulation.h"
#include "calib/closed_loop/tangent.h"
#include "calib/logs/log_set.h"
#include "problems/make_rows.h"

namespace armcal {

// All windows simulated with some values.
struct LoopRun {
  bool finite = true;  // else nothing follows
  double cost = 0;     // the residuals' squares, and the starts' priors'
  std::vector<LoopTrack> tracks;
  std::vector<Eigen::VectorXd> residuals;  // of each track
  Eigen::VectorXd torque_rms;              // per joint

  // rms of the whitened residuals: 1 where they are encoder noise.
  double Excess() const;
};

// What all windows of logs say of a loop's values about some of them, the
// windows' starts eliminated; whitened by the encoders' noise.
struct LoopEquations {
  Eigen::MatrixXd R;  // R dx = z, a column for each of LoopOrder
  Eigen::VectorXd z;
  // Of each window: where it starts (q, qd, integral), and the triangle of
  // start, columns and residual.
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
// a state of its own, side by side.
class LoopWindows {
 public:
  // Logs and controller are kept by reference.
  LoopWindows(const Robot& known, const ControllerOptions& controller,
              double window_s, const std::vector<CommandedLog>& logs);
  // Every so-manieth window of another length, from the logs' begin on.
  LoopWindows Thinned(double window_s, int every) const;

  // From where Move has put the starts.
  LoopRun Simulate(const LoopValues& values) const;
  LoopEquations Linearise(const LoopValues& values, const LoopColumns& columns,
                          const LoopRun& run) const;
  // Takes the starts to where `equations` put them for a step `dx` of all
  // values, times `share`.
  void Move(const LoopColumns& columns, const LoopEquations& equations,
            const Eigen::VectorXd& dx, double share);
  LoopScores Scores(const LoopValues& values, const LoopColumns& columns,
                    const LoopRun& run, const LoopEquations& equations) const;
  // rms of residuals per joint, rad or m, without each window's first second.
  Eigen::VectorXd ResidualRms(const LoopRun& run) const;
  // Visits the rows of all windows; `counts`: not in a window's first second,
  // in which its simulation forgets where it began.
  using VisitRow =
      std::function<void(const CommandedLog& log, long row, size_t window,
                         long row_of_window, bool counts)>;
  void ForEachRow(const VisitRow& visit) const;
  // Of the encoders, per joint, rad or m: all logs'.
  const Eigen::VectorXd& noise() const { return noise_; }

 private:
  struct Window {
    int log;
    LoopStretch stretch;
    Eigen::VectorXd nominal, start;  // q, qd, integral
  };
  // All but the windows.
  LoopWindows(const ControllerOptions& controller,
              const std::vector<CommandedLog>& logs, int num_joints)
      : controller_(controller), logs_(logs), n_(num_joints) {}
  void AddWindows(int log, double window_s, int every);
  LoopEquations::Window Reduce(const Window& window, const LoopTangent& tangent,
                               const Eigen::VectorXd& residual) const;
  double StartCost(const Window& window) const;
  Eigen::VectorXd StartPrior() const;
  Eigen::VectorXd RowScale(long rows) const;

  const ControllerOptions& controller_;
  const std::vector<CommandedLog>& logs_;
  std::vector<std::shared_ptr<const CommandedReference>> references_;
  std::vector<Window> windows_;
  Eigen::VectorXd noise_;
  int n_;
};

}  // namespace armcal

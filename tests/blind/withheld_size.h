#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "tests/blind/absorbing_columns.h"
#include "tests/blind/blind_case.h"
#include "tests/blind/effect_size.h"
#include "tests/blind/real_log.h"
#include "tests/blind/withheld_effect.h"

namespace armcal {

// How visible an effect in a real log is: ENR as in effect_size.h, but
//   - the model is fitted to the reference log, links, friction, offsets, time
//     and all, with no prior worth the name; what that log tells is what the
//     diagnosed one may not absorb;
//   - the noise is what this fit leaves of the reference log while it moves:
//     an autoregression per joint of real residuals, misfit included.
class WithheldSizer {
 public:
  // `robot`: of the file, which may lack friction.
  WithheldSizer(Robot robot, const Log& reference);

  // Of an effect in a uniform log.
  EffectSize Size(const WithheldEffect& effect, const Log& uniform);
  // rms of the recorded torque while the reference moves, N m or N.
  const Eigen::VectorXd& usual_torque() const { return usual_; }
  // rms of what the fit leaves of the reference, N m or N.
  const Eigen::VectorXd& noise_rms() const { return noise_rms_; }

 private:
  // Recorded torque without the robot's, whitened, and the columns; rows at
  // which the joint stands are zero, as friction there is anything.
  struct Rows {
    Eigen::VectorXd torque;
    Eigen::MatrixXd columns;
    Eigen::MatrixXd moves;  // thin, samples x joints, 1 or 0
  };
  Rows RowsOf(const Log& uniform) const;
  // What the fit leaves.
  Eigen::VectorXd Residual(const Rows& rows) const {
    return rows.torque - rows.columns * fit_;
  }
  Eigen::MatrixXd Whitened(const Rows& rows, const Eigen::MatrixXd& x) const;

  BlindCase model_;  // the robot and its spreads
  Eigen::VectorXd usual_, noise_rms_;
  std::vector<ResidualNoise> noise_;
  Eigen::VectorXd fit_;    // coefficients of the columns
  Eigen::MatrixXd known_;  // the reference's information about them
};

}  // namespace armcal

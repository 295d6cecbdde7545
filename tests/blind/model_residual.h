#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/log_files/log.h"
#include "tests/blind/blind_case.h"

namespace armcal {

// Samples of torques that the bench compares: 25 Hz after a low pass at 10 Hz,
// joints one below the other where they are stacked.
inline constexpr double kResidualRateHz = 25;

// What a noiseless log says of the motion, samples in rows.
struct PlantMotion {
  Eigen::MatrixXd q, qd, qdd;
  double rate;  // Hz
};
// Rates by the log's own stamps, which an effect may have made wrong.
PlantMotion MotionOf(const Log& log);
PlantMotion MotionOf(const ReferenceMotion& motion, double rate);

// Widths of the zero velocity of the case's friction, rad/s or m/s.
Eigen::VectorXd ZeroVelocityWidths(const BlindCase& blind);
// Inverse dynamics with armature, friction and offset, samples x joints.
Eigen::MatrixXd ModelTorque(const Robot& robot, const Eigen::VectorXd& widths,
                            const PlantMotion& motion);
// Low-passed samples at kResidualRateHz; a second at both ends belongs to the
// filter and is left out.
Eigen::MatrixXd ThinTorque(const Eigen::MatrixXd& x, double rate);

// Torque of the true robot, without effects, beyond that of its file; thin.
Eigen::MatrixXd FileError(const BlindCase& blind, const PlantMotion& motion);

// Torques of a log, or what its commands were if the case has none, without
// those of the case's robot file.
struct ModelResidual {
  Eigen::MatrixXd torque;  // thin, samples x joints, N m or N
  PlantMotion motion;
};
// Nothing where the arm does not follow.
std::optional<ModelResidual> SimulateResidual(const BlindCase& blind,
                                              const Scenario& scenario);

// Noiseless runs of one log of a case with any of its effects, each simulated
// once.
class QuietRuns {
 public:
  QuietRuns(const BlindCase& blind, BlindLog log) : blind_(blind), log_(log) {}

  // Thin residual; nullptr where the arm does not follow.
  const Eigen::MatrixXd* Residual(const std::vector<ChosenEffect>& effects);
  // How the arm moves without effects.
  const PlantMotion& Motion();

 private:
  const ModelResidual* Run(const std::vector<ChosenEffect>& effects);

  const BlindCase& blind_;
  BlindLog log_;
  std::map<std::string, std::optional<ModelResidual>> runs_;
};

}  // namespace armcal

#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/excite/posture_options.h"
#include "calib/poses/diagnosis/equations.h"
#include "calib/poses/diagnosis/model.h"

namespace armcal {

// What postures tell of an arm's geometry, of the instrument's frame and the
// target, and of effects beside these: equations that are linear about the
// robot file without effects.
class PostureModel {
 public:
  // Unknowns are those that `q`, rich enough, tell apart. Throws OptionError
  // for effects that are none of poses, or that the arm cannot show.
  PostureModel(const Robot& robot, const PostureOptions& options,
               const Eigen::MatrixXd& q);

  // Of each posture, in units of the noise, rows x unknowns.
  std::vector<Eigen::MatrixXd> Rows(const Eigen::MatrixXd& q) const;

  // Which unknowns are to be told: the geometry, or the effects' amounts.
  const std::vector<int>& wanted() const { return wanted_; }
  const std::vector<std::string>& names() const { return names_; }
  const std::vector<std::string>& units() const { return units_; }
  // Information of the priors; what has none gets one that says next to
  // nothing.
  Eigen::MatrixXd Prior() const;
  // By which standard deviations of what is wanted are measured.
  Eigen::VectorXd Scale() const;

 private:
  PoseCalibrationOptions FitOptions() const;
  PoseState At(const PoseFit& fit) const;
  std::vector<PoseTerm> Terms(const PoseMeasurements& measured) const;
  void AddEffects(const PoseMeasurements& measured);

  const Robot& robot_;
  const PostureOptions& options_;
  std::vector<bool> free_;  // of the geometry's parameters
  std::vector<PlacedPoseEffect> effects_;
  std::vector<double> prior_;  // standard deviations of all unknowns; 0: none
  std::vector<int> wanted_;
  std::vector<std::string> names_, units_;
};

}  // namespace armcal

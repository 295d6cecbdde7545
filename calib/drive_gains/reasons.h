#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/drive_gains/drive_gains.h"
#include "calib/drive_gains/solution.h"

namespace armcal {

// Why gains are not identifiable.
class GainReasons {
 public:
  GainReasons(const GainSensitivity& sensitivity, bool has_payload);

  // The next joint: whether it has current, and the gradient of its inverse
  // gain by (g, x, p).
  void Add(bool has_current, const Eigen::VectorXd& gradient,
           bool identifiable);
  // After all were added; empty for a joint that is identifiable.
  std::string Text(Eigen::Index joint) const;

 private:
  struct Joint {
    bool has_current;
    Eigen::VectorXd gradient;
    bool identifiable;
  };
  bool MomentsHide(const Joint& joint) const;

  const GainSensitivity& sensitivity_;
  bool has_payload_;
  std::vector<Joint> joints_;
};

// One sentence about all gains; empty where all are identifiable.
std::string GainVerdict(const std::vector<DriveGain>& gains);

}  // namespace armcal

#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/drive_gains/start.h"
#include "calib/numerics/block_triangular_factor.h"
#include "problems/drive_gain_residual.h"

namespace armcal {

// The equations of logs of the bare arm and of logs with a payload, in amperes.
struct CurrentFactors {
  explicit CurrentFactors(const ModelParameters& parameters)
      : bare(parameters), loaded(parameters) {}
  BlockTriangularFactor bare;
  BlockTriangularFactor loaded;  // without rows where there is no such log

  long rows(int joint) const { return bare.rows(joint) + loaded.rows(joint); }
};

// The noise of each joint's equations (A) where nothing ties them: not to other
// joints and not the bare arm to the loaded one, so that no gain is needed. 0
// for a joint without current in either kind of log, or with too few equations:
// its equations are left out.
Eigen::VectorXd UntiedNoise(const CurrentFactors& factors);
// What is left of them at an estimate, corrected for the parameters spent.
Eigen::VectorXd GainNoise(const CurrentFactors& factors,
                          const Eigen::MatrixXd& B,
                          const GainEstimate& estimate,
                          const Eigen::VectorXd& noise);

std::vector<CurrentEquations> WhitenedEquations(const CurrentFactors& factors,
                                                const Eigen::VectorXd& noise);

// The minimum of DriveGainResidual from `estimate`, g[reference] held at 1.
// False where numbers overflow.
bool RefineGains(const std::vector<CurrentEquations>& equations,
                 const Eigen::MatrixXd& B, int reference,
                 GainEstimate* estimate);

// How errors of the equations reach an estimate: the columns of its Jacobian by
// (g, x, p), each divided by its length, in singular vectors. Directions below
// 1e-8 of the best are not seen; g[reference] is known.
class GainSensitivity {
 public:
  GainSensitivity(const std::vector<CurrentEquations>& equations,
                  const Eigen::MatrixXd& B, const GainEstimate& estimate,
                  int reference);

  // The same where these entries of (g, x, p) were known.
  GainSensitivity(const GainSensitivity& other, const std::vector<int>& known);

  int rank() const { return rank_; }
  // Whether d.(g, x, p) does not depend on what is not seen.
  bool Sees(const Eigen::VectorXd& d) const;
  // (J' J)^+: n + m + 10 square.
  Eigen::MatrixXd Gain() const;

 private:
  void Decompose();

  Eigen::MatrixXd J_;
  Eigen::VectorXd inverse_norms_;
  Eigen::MatrixXd V_;
  Eigen::VectorXd s_;
  int rank_ = 0;
};

}  // namespace armcal

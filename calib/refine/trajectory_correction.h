#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "calib/numerics/block_tridiagonal_factor.h"
#include "calib/numerics/noise_sums.h"
#include "model/dynamics/model_parameters.h"
#include "model/signals/trajectory.h"
#include "problems/torque_sensitivity.h"
#include "problems/trajectory_spline.h"

namespace armcal {

// How torque residuals of z standard deviations count.
enum class TorqueWeighting {
  kSquared,    // all alike
  kHuber,      // by Huber's weights
  kLinearised  // Huber's loss, linear about its minimum, for covariances: all
               // alike, with residuals psi(z) / mean psi'
};

// Of single samples, per joint.
struct TrajectoryNoise {
  Eigen::ArrayXd encoder;  // standard deviation, rad or m
  Eigen::ArrayXd torque;   // N m or N; infinite: left out
  // Of Huber's psi, for kLinearised.
  Eigen::ArrayXd mean_slope, mean_square;
};

// Maximum likelihood of one stretch of motion: its true positions are a spline
// with control points c, and recorded positions and torques are both noisy,
//   q_k = B_k c + noise,   tau_k = U(B_k c) x + noise.
// The control points are fitted at given x, and then eliminated from the normal
// equations of the border: x, and the log widths of Coulomb friction. One for
// each pass over a log.
class TrajectoryCorrection {
 public:
  TrajectoryCorrection(const ModelParameters& parameters, double knot_s);

  // Unknowns of the border: parameters, then widths.
  int border() const { return m_ + sensitivity_.num_widths(); }
  const TorqueSensitivity& sensitivity() const { return sensitivity_; }

  // Takes the core of a stretch, with the spline that fits its positions alone;
  // false where it is too short.
  bool Enter(const Trajectory& trajectory);
  // Improves the spline by Gauss-Newton steps, the torque's derivatives taken
  // once; without steps only the residuals are found. False where the equations
  // overflow or are singular.
  bool Fit(const Eigen::VectorXd& x, const TrajectoryNoise& noise,
           TorqueWeighting weighting, int steps);
  int num_points() const { return spline_.num_points(); }
  // The motion with the spline in its core; and what it leaves of the core:
  // position errors, and (after Fit) torque residuals in units of their noise,
  // 0 where left out (samples x joints).
  const Trajectory& motion() const { return motion_; }
  Eigen::MatrixXd PositionErrors() const;
  const Eigen::MatrixXd& torque_residuals() const { return z_; }

  // After Fit: adds the normal equations of the border about x, and what the
  // residuals say of the noise. False where the spline is not determined.
  bool Eliminate(Eigen::MatrixXd* information, Eigen::VectorXd* gradient,
                 NoiseSums* encoder, NoiseSums* torque);
  // After Eliminate: the score of the border at every sample, in order, with
  // what the spline passes on to it.
  using ScoreSink = std::function<void(const Eigen::VectorXd& score)>;
  void ForEachScore(const ScoreSink& sink);

 private:
  // Normal equations of the control points, n at a time, and the border.
  struct Equations {
    BlockTridiagonalFactor::Blocks H;
    Eigen::VectorXd g;
    Eigen::MatrixXd H_border, border;
    Eigen::VectorXd g_border;
  };

  int num_joints() const { return motion_.num_joints(); }
  int size() const { return spline_.size(); }
  int sample(int k) const { return motion_.core_begin + k; }
  void FollowSpline();
  void Weigh();
  Eigen::MatrixXd SplineRows(int k) const;  // whitened, n x 6 n
  Eigen::MatrixXd BorderRows(int k);        // whitened, n x border
  Equations Assemble(bool with_border);
  void AddTorques(int begin, int end, bool with_border, Equations* equations);
  void AddPositions(int begin, int end, Equations* equations) const;
  void SumNoise(const BlockTridiagonalFactor::Blocks& inverse,
                NoiseSums* encoder, NoiseSums* torque) const;

  TorqueSensitivity sensitivity_;
  int m_;
  double knot_s_;
  Eigen::MatrixXd recorded_;  // positions of the core
  Trajectory motion_;
  TrajectorySpline spline_;
  Eigen::MatrixXd points_;
  Eigen::VectorXd x_;
  TrajectoryNoise noise_;
  TorqueWeighting weighting_ = TorqueWeighting::kSquared;
  std::vector<Eigen::MatrixXd> T_;  // d tau / d (q, qd, qdd) per sample
  // Per sample (rows) and joint: residuals in units of noise; what whitens a
  // row of the torque; the whitened residual.
  Eigen::MatrixXd z_, whitening_, whitened_;
  Eigen::MatrixXd gain_;  // H^-1 H_border
};

}  // namespace armcal

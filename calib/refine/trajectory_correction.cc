#include "calib/refine/trajectory_correction.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "problems/robust_loss.h"

namespace armcal {
namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSupport = TrajectorySpline::kSupport;
// Control points in a block: a sample never reaches beyond the next one.
constexpr int kBlockPoints = kSupport - 1;

// The blocks of control points that a spline needs; the last may be partly
// empty.
int NumBlocks(const TrajectorySpline& spline) {
  return (spline.num_points() + kBlockPoints - 1) / kBlockPoints;
}

LossAt HuberAt(double z) { return EvaluateLoss(RobustLoss::kHuber, z); }

}  // namespace

TrajectoryCorrection::TrajectoryCorrection(const ModelParameters& parameters,
                                           double knot_s)
    : sensitivity_(parameters),
      m_(parameters.size()),
      knot_s_(knot_s),
      spline_(TrajectorySpline::kLeastSamples, 1, 1) {}

bool TrajectoryCorrection::Enter(const Trajectory& trajectory) {
  const int size = trajectory.core_end - trajectory.core_begin;
  if (size < TrajectorySpline::kLeastSamples) return false;
  motion_ = trajectory;
  motion_.friction_q.resize(0, 0);  // friction follows the spline
  recorded_ = trajectory.q.middleRows(trajectory.core_begin, size);
  spline_ = TrajectorySpline(size, trajectory.dt, knot_s_);
  points_ = spline_.Fit(recorded_);
  FollowSpline();
  return true;
}

void TrajectoryCorrection::FollowSpline() {
  motion_.q.middleRows(sample(0), size()) = spline_.Evaluate(points_, 0);
  motion_.qd.middleRows(sample(0), size()) = spline_.Evaluate(points_, 1);
  motion_.qdd.middleRows(sample(0), size()) = spline_.Evaluate(points_, 2);
  sensitivity_.Enter(motion_);
}

MatrixXd TrajectoryCorrection::PositionErrors() const {
  return recorded_ - motion_.q.middleRows(sample(0), size());
}

// Finds residuals at the present spline, z = (tau - U x) / sigma, and how they
// count. Huber's loss multiplies row and residual by sqrt(psi(z) / z).
// Linearised, for covariances, rows have mean psi' / rms psi and residuals psi
// / rms psi: an information of (E psi')^2 / E psi^2 and scores of variance 1,
// as an M-estimate has.
void TrajectoryCorrection::Weigh() {
  const int n = num_joints();
  z_.resize(size(), n);
  whitening_.resize(size(), n);
  whitened_.resize(size(), n);
  const bool has_coulomb = sensitivity_.num_widths() > 0;
  MatrixXd U;
  for (int k = 0; k < size(); ++k) {
    // With Coulomb friction in the model, standstill can have any torque.
    const bool useless = has_coulomb && motion_.standstill[sample(k)];
    sensitivity_.Regress(sample(k), &U);
    const VectorXd e = motion_.tau.row(sample(k)).transpose() - U * x_;
    for (int i = 0; i < n; ++i) {
      const double z = useless ? 0 : e[i] / noise_.torque[i];
      double factor = useless ? 0 : 1 / noise_.torque[i], psi = z;
      if (weighting_ == TorqueWeighting::kHuber) {
        factor *= std::sqrt(HuberAt(z).weight);
        psi *= std::sqrt(HuberAt(z).weight);
      } else if (weighting_ == TorqueWeighting::kLinearised) {
        const double rms = std::sqrt(noise_.mean_square[i]);
        factor *= noise_.mean_slope[i] / rms;
        psi *= HuberAt(z).weight / rms;
      }
      z_(k, i) = z;
      whitening_(k, i) = factor;
      whitened_(k, i) = psi;
    }
  }
}

// d tau / d c by the chain rule: T = d tau / d (q, qd, qdd), and the weights of
// the six control points in these.
MatrixXd TrajectoryCorrection::SplineRows(int k) const {
  const int n = num_joints();
  const auto& w = spline_.basis(k).weights;
  MatrixXd rows(n, kSupport * n);
  for (int a = 0; a < kSupport; ++a) {
    rows.middleCols(a * n, n) = w(0, a) * T_[k].leftCols(n) +
                                w(1, a) * T_[k].middleCols(n, n) +
                                w(2, a) * T_[k].rightCols(n);
  }
  return whitening_.row(k).asDiagonal() * rows;
}

// d tau / d (x, log widths): U, and x_c d state / d log(width).
MatrixXd TrajectoryCorrection::BorderRows(int k) {
  MatrixXd rows(num_joints(), border()), U;
  rows.rightCols(border() - m_).setZero();
  sensitivity_.Regress(sample(k), &U);
  rows.leftCols(m_) = U;
  for (int w = 0; w < sensitivity_.num_widths(); ++w) {
    rows(sensitivity_.width_joint(w), m_ + w) =
        x_[sensitivity_.width_parameter(w)] *
        sensitivity_.WidthDerivative(sample(k), w);
  }
  return whitening_.row(k).asDiagonal() * rows;
}

// Adds samples begin..end - 1, which share their control points, by one
// product.
void TrajectoryCorrection::AddTorques(int begin, int end, bool with_border,
                                      Equations* equations) {
  const int n = num_joints(), first = n * spline_.basis(begin).first;
  MatrixXd J((end - begin) * n, kSupport * n);
  MatrixXd V(J.rows(), with_border ? border() : 0);
  VectorXd r(J.rows());
  for (int k = begin; k < end; ++k) {
    J.middleRows((k - begin) * n, n) = SplineRows(k);
    r.segment((k - begin) * n, n) = whitened_.row(k);
    if (with_border) V.middleRows((k - begin) * n, n) = BorderRows(k);
  }
  equations->H.Add(first, J.transpose() * J);
  equations->g.segment(first, J.cols()) += J.transpose() * r;
  if (!with_border) return;
  equations->H_border.middleRows(first, J.cols()) += J.transpose() * V;
  equations->border += V.transpose() * V;
  equations->g_border += V.transpose() * r;
}

// Adds B'B / sigma^2 joint by joint: recorded positions have independent
// errors.
void TrajectoryCorrection::AddPositions(int begin, int end,
                                        Equations* equations) const {
  const int n = num_joints(), first = spline_.basis(begin).first * n;
  Eigen::Matrix<double, kSupport, kSupport> ww;
  ww.setZero();
  const ArrayXd weight = noise_.encoder.square().inverse();
  for (int k = begin; k < end; ++k) {
    const Eigen::Matrix<double, kSupport, 1> w =
        spline_.basis(k).weights.row(0);
    ww += w * w.transpose();
    const VectorXd e =
        weight *
        (recorded_.row(k) - motion_.q.row(sample(k))).transpose().array();
    for (int a = 0; a < kSupport; ++a) {
      equations->g.segment(first + a * n, n) += w[a] * e;
    }
  }
  MatrixXd square = MatrixXd::Zero(kSupport * n, kSupport * n);
  for (int a = 0; a < kSupport; ++a) {
    for (int b = 0; b < kSupport; ++b) {
      square.block(a * n, b * n, n, n).diagonal() = ww(a, b) * weight;
    }
  }
  equations->H.Add(first, square);
}

// Errors in the regressor shrink an estimate (attenuation; Fuller 1987,
// Measurement Error Models, 1.1). So the true motion is an unknown, too:
// orthogonal distance regression (Boggs, Byrd & Schnabel 1987, SIAM J. Sci.
// Stat. Comput. 8). The normal equations of control points c and border b = (x,
// log widths) are
//   [H  B; B' A] [dc; db] = [g; g_b].
// H is block tridiagonal, so that a stretch costs time linear in its length.
TrajectoryCorrection::Equations TrajectoryCorrection::Assemble(
    bool with_border) {
  const int n = num_joints(), blocks = NumBlocks(spline_);
  const int rows = blocks * kBlockPoints * n, b = with_border ? border() : 0;
  Equations equations{{blocks, kBlockPoints * n},
                      VectorXd::Zero(rows),
                      MatrixXd::Zero(rows, b),
                      MatrixXd::Zero(b, b),
                      VectorXd::Zero(b)};
  for (int i = n * spline_.num_points(); i < rows; ++i) {  // beyond the end
    equations.H.Add(i, MatrixXd::Identity(1, 1));
  }
  for (int begin = 0, k = 0; begin < size(); begin = k) {
    const int first = spline_.basis(begin).first;
    for (k = begin; k < size() && spline_.basis(k).first == first;) ++k;
    AddPositions(begin, k, &equations);
    AddTorques(begin, k, with_border, &equations);
  }
  return equations;
}

// Gauss-Newton steps in the control points alone. T stays that of the first
// spline: steps are small, and it is most of the work.
bool TrajectoryCorrection::Fit(const VectorXd& x, const TrajectoryNoise& noise,
                               TorqueWeighting weighting, int steps) {
  x_ = x;
  noise_ = noise;
  // The first step by squares: where positions alone say little, at the ends,
  // Huber's weights would take what they leave for outliers.
  weighting_ = steps > 0 ? TorqueWeighting::kSquared : weighting;
  T_.resize(size());
  for (int k = 0; steps > 0 && k < size(); ++k) {
    sensitivity_.Differentiate(sample(k), x, &T_[k]);
  }
  Weigh();
  for (int step = 0; step < steps; ++step) {
    const Equations equations = Assemble(false);
    const BlockTridiagonalFactor factor(equations.H);
    if (!factor.positive()) return false;
    const MatrixXd change = factor.Solve(equations.g);
    if (!change.allFinite()) return false;
    points_ += change
                   .reshaped<Eigen::RowMajor>(change.size() / num_joints(),
                                              num_joints())
                   .topRows(points_.rows());
    FollowSpline();
    weighting_ = weighting;
    Weigh();
  }
  return true;
}

// Adds the Schur complement of the control points and its right side,
//   (A - B' H^-1 B) db = g_b - B' H^-1 g.
bool TrajectoryCorrection::Eliminate(MatrixXd* information, VectorXd* gradient,
                                     NoiseSums* encoder, NoiseSums* torque) {
  const Equations equations = Assemble(true);
  const BlockTridiagonalFactor factor(equations.H);
  if (!factor.positive()) return false;
  gain_ = factor.Solve(equations.H_border);
  *information += equations.border - equations.H_border.transpose() * gain_;
  *gradient += equations.g_border - gain_.transpose() * equations.g;
  SumNoise(factor.Inverse(), encoder, torque);
  return true;
}

// Counts what the spline takes of each residual: the diagonal of the hat matrix
// J H^-1 J', whose sum is the degrees of freedom spent. Without it, noise would
// come out too small by what knots half a period apart can follow. Only blocks
// of H^-1 within the band are needed.
void TrajectoryCorrection::SumNoise(
    const BlockTridiagonalFactor::Blocks& inverse, NoiseSums* encoder,
    NoiseSums* torque) const {
  const int n = num_joints();
  MatrixXd Z;
  int first = -1;
  for (int k = 0; k < size(); ++k) {
    const TrajectorySpline::Basis& basis = spline_.basis(k);
    if (basis.first != first) Z = inverse.Square(basis.first * n, kSupport * n);
    first = basis.first;
    const MatrixXd J = SplineRows(k);
    const VectorXd taken = (J * Z).cwiseProduct(J).rowwise().sum();
    for (int j = 0; j < n; ++j) {
      if (whitening_(k, j) > 0) {
        const double z = z_(k, j), weight = HuberAt(z).weight;
        const bool huber = weighting_ != TorqueWeighting::kSquared;
        torque->count[j] += 1;
        torque->fitted[j] += taken[j];
        torque->squares[j] += z * z * (huber ? weight * weight : 1);
        torque->slope[j] += huber ? HuberAt(z).slope : 1;
        torque->outliers[j] += weight < 0.5;
      }
      double variance = 0;  // of the spline's position
      for (int a = 0; a < kSupport; ++a) {
        for (int b = 0; b < kSupport; ++b) {
          variance += basis.weights(0, a) * basis.weights(0, b) *
                      Z(a * n + j, b * n + j);
        }
      }
      const double sigma = noise_.encoder[j];
      encoder->count[j] += 1;
      encoder->fitted[j] += variance / (sigma * sigma);
      encoder->squares[j] +=
          std::pow((recorded_(k, j) - motion_.q(sample(k), j)) / sigma, 2);
    }
  }
}

// A sample's score about b with c eliminated: (V - J H^-1 B)' r of its torques
// and -(w H^-1 B)' e / sigma^2 of its positions, V and J being the rows of
// border and spline.
void TrajectoryCorrection::ForEachScore(const ScoreSink& sink) {
  const int n = num_joints();
  for (int k = 0; k < size(); ++k) {
    const TrajectorySpline::Basis& basis = spline_.basis(k);
    const auto gain = gain_.middleRows(basis.first * n, kSupport * n);
    const MatrixXd rows = BorderRows(k) - SplineRows(k) * gain;
    VectorXd score = rows.transpose() * whitened_.row(k).transpose();
    for (int j = 0; j < n; ++j) {
      const double e = recorded_(k, j) - motion_.q(sample(k), j);
      const double scaled = e / (noise_.encoder[j] * noise_.encoder[j]);
      for (int a = 0; a < kSupport; ++a) {
        score -= scaled * basis.weights(0, a) * gain.row(a * n + j).transpose();
      }
    }
    sink(score);
  }
}

}  // namespace armcal

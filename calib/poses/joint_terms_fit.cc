#include "calib/poses/joint_terms_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "calib/numerics/median.h"
#include "calib/poses/identifiability.h"
#include "calib/poses/repeated_poses.h"
#include "calib/poses/start.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// rad or m: beside it, the rounding of a metre's difference is 1e-9.
constexpr double kJointDifference = 1e-7;
constexpr int kMostTermSteps = 60;
// A step that lowers chi^2 by less than this share of it was the last: what is
// compared differs by percents.
constexpr double kAtRest = 1e-5;
constexpr int kNoiseRounds = 3;

// Each residual of a pose times the pose's value.
VectorXd Weighted(const VectorXd& column, const std::vector<int>& rows,
                  const VectorXd& signal) {
  VectorXd weighted = column;
  const Eigen::Index per_pose = column.size() / rows.size();
  for (size_t k = 0; k < rows.size(); ++k) {
    weighted.segment(k * per_pose, per_pose) *= signal[rows[k]];
  }
  return weighted;
}

}  // namespace

JointTermsFit::JointTermsFit(const Robot& robot,
                             const PoseMeasurements& measured,
                             const PoseCalibrationOptions& options,
                             std::vector<JointCorrection> terms)
    : measured_(measured),
      corrected_(measured),
      fit_(robot, corrected_, options),
      terms_(std::move(terms)),
      nominal_(fit_.geometry().Values()) {}

void JointTermsFit::Free(RefineGeometry what, const JointTermsState& at) {
  Correct(at.amounts);
  const std::vector<bool> free =
      HoldUnseen(fit_, fit_.Wanted(what), fit_.AllRows(), at.unknowns, nullptr);
  free_.clear();
  for (int k = 0; k < fit_.geometry().size(); ++k) {
    if (free[k]) free_.push_back(k);
  }
  for (int k = 0; k < at.unknowns.other.size(); ++k) {
    free_.push_back(fit_.geometry().size() + k);
  }
}

JointTermsState JointTermsFit::Start() {
  JointTermsState start;
  start.amounts = VectorXd::Zero(terms_.size());
  Correct(start.amounts);
  start.unknowns = StartPoses(fit_.geometry(), corrected_);
  return start;
}

void JointTermsFit::Correct(const VectorXd& amounts) {
  corrected_.q = measured_.q;
  for (size_t k = 0; k < terms_.size(); ++k) {
    corrected_.q.col(terms_[k].joint) += amounts[k] * terms_[k].signal;
  }
}

VectorXd JointTermsFit::Residuals(const std::vector<int>& rows,
                                  const JointTermsState& at) {
  Correct(at.amounts);
  return fit_.Residuals(rows, at.unknowns);
}

std::pair<double, double> JointTermsFit::PriorOf(
    int unknown, const JointTermsState& at) const {
  const int num_free = static_cast<int>(free_.size());
  double sigma = 0, difference = 0;
  if (unknown >= num_free) {
    sigma = terms_[unknown - num_free].prior;
    difference = at.amounts[unknown - num_free];
  } else if (free_[unknown] < fit_.geometry().size()) {
    sigma = fit_.PriorOf(free_[unknown]);
    difference =
        at.unknowns.geometry[free_[unknown]] - nominal_[free_[unknown]];
  } else {
    const int other = free_[unknown] - fit_.geometry().size();
    sigma = PoseUnknowns::OtherPriors(measured_)[other];
    difference = at.unknowns.other[other];
  }
  if (sigma <= 0) return {0, 0};
  return {1 / (sigma * sigma), difference / (sigma * sigma)};
}

double JointTermsFit::Cost(const std::vector<int>& rows,
                           const JointTermsState& at) {
  double cost = Residuals(rows, at).squaredNorm();
  for (size_t k = 0; k < free_.size() + terms_.size(); ++k) {
    const auto [information, pull] = PriorOf(static_cast<int>(k), at);
    if (information > 0) cost += pull * pull / information;
  }
  return cost;
}

VectorXd JointTermsFit::JointColumn(int joint, const std::vector<int>& rows,
                                    const JointTermsState& at,
                                    const VectorXd& residuals) {
  Correct(at.amounts);
  corrected_.q.col(joint).array() += kJointDifference;
  return (fit_.Residuals(rows, at.unknowns) - residuals) / kJointDifference;
}

MatrixXd JointTermsFit::Jacobian(const std::vector<int>& rows,
                                 const JointTermsState& at, VectorXd* r) {
  *r = Residuals(rows, at);
  const MatrixXd all = fit_.Jacobian(rows, at.unknowns);
  const Eigen::Index num_free = free_.size();
  MatrixXd J(all.rows(), num_free + terms_.size());
  for (Eigen::Index k = 0; k < num_free; ++k) J.col(k) = all.col(free_[k]);
  for (size_t k = 0; k < terms_.size(); ++k) {
    J.col(num_free + k) = Weighted(JointColumn(terms_[k].joint, rows, at, *r),
                                   rows, terms_[k].signal);
  }
  return J;
}

JointTermsFit::Equations JointTermsFit::Normal(
    const MatrixXd& J, const VectorXd& r, const JointTermsState& at) const {
  Equations e = {J.transpose() * J, -J.transpose() * r};
  for (Eigen::Index k = 0; k < J.cols(); ++k) {
    const auto [information, pull] = PriorOf(static_cast<int>(k), at);
    e.A(k, k) += information;
    e.b[k] -= pull;
  }
  return e;
}

JointTermsState JointTermsFit::Moved(const JointTermsState& at,
                                     const VectorXd& step) const {
  JointTermsState moved = at;
  const int g = fit_.geometry().size();
  for (size_t k = 0; k < free_.size(); ++k) {
    const int p = free_[k];
    (p < g ? moved.unknowns.geometry[p] : moved.unknowns.other[p - g]) +=
        step[k];
  }
  moved.amounts += step.tail(terms_.size());
  return moved;
}

// Levenberg and Marquardt: the diagonal grows until the cost falls.
bool JointTermsFit::Solve(const std::vector<int>& rows,
                          JointTermsState* state) {
  double damping = 1e-8, cost = Cost(rows, *state);
  for (int step = 0; step < kMostTermSteps; ++step) {
    VectorXd r;
    const MatrixXd J = Jacobian(rows, *state, &r);
    const Equations e = Normal(J, r, *state);
    double lower = cost;
    for (; damping < 1e6; damping *= 10) {
      MatrixXd A = e.A;
      A.diagonal() += damping * (e.A.diagonal().array() + 1e-12).matrix();
      const JointTermsState moved = Moved(*state, A.ldlt().solve(e.b));
      lower = Cost(rows, moved);
      if (!(lower <= cost)) continue;
      *state = moved;
      break;
    }
    if (!(lower <= cost)) return std::isfinite(cost);
    damping = std::max(1e-8, damping / 100);
    const bool at_rest = cost - lower <= kAtRest * cost;
    cost = lower;
    if (at_rest) break;
  }
  return std::isfinite(cost);
}

bool JointTermsFit::SolveWithNoise(const std::vector<int>& rows,
                                   JointTermsState* state) {
  for (int round = 0; round < kNoiseRounds; ++round) {
    const std::vector<double> left = MeanSquares(rows, *state);
    PoseNoise noise = fit_.noise();
    noise.position = std::max(1e-7, std::sqrt(left[0]));
    if (left.size() > 1) noise.rotation = std::max(1e-7, std::sqrt(left[1]));
    fit_.set_noise(noise);
    if (!Solve(rows, state)) return false;
  }
  return true;
}

// With c the column of one more term and all others refitted, chi^2 falls by
// pull^2 / own: own = c'c - c'J A^-1 J'c is the information on its amount, and
// pull what is left of -c'r (the score test; Rao 1948). One factor of A serves
// all candidates.
MatrixXd JointTermsFit::Gains(const std::vector<int>& rows,
                              const MatrixXd& signals,
                              const JointTermsState& at) {
  VectorXd r;
  const MatrixXd J = Jacobian(rows, at, &r);
  const Equations e = Normal(J, r, at);
  const Eigen::LDLT<MatrixXd> factor(e.A);
  MatrixXd gains(measured_.q.cols(), signals.cols());
  for (Eigen::Index i = 0; i < gains.rows(); ++i) {
    const VectorXd column = JointColumn(static_cast<int>(i), rows, at, r);
    for (Eigen::Index j = 0; j < signals.cols(); ++j) {
      const VectorXd c = Weighted(column, rows, signals.col(j));
      const VectorXd shared = J.transpose() * c;
      const VectorXd part = factor.solve(shared);
      const double own = c.squaredNorm() - shared.dot(part);
      const double pull = -c.dot(r) - part.dot(e.b);
      const bool seen = own > 1e-6 * c.squaredNorm();
      gains(i, j) = seen ? pull * pull / own : 0;
    }
  }
  return gains;
}

// The sandwich over poses: the amount moves by the sum over poses of (J A^-1
// e_k)'r.
double JointTermsFit::Stddev(int term, const std::vector<int>& rows,
                             const JointTermsState& at) {
  VectorXd r;
  const MatrixXd J = Jacobian(rows, at, &r);
  const Equations e = Normal(J, r, at);
  const Eigen::LDLT<MatrixXd> factor(e.A);
  const Eigen::Index k = static_cast<Eigen::Index>(free_.size()) + term;
  const VectorXd one = factor.solve(VectorXd::Unit(e.A.rows(), k));
  // Errors of a pose are one error in the sandwich (Liang and Zeger 1986).
  const VectorXd influence = J * one;
  const Eigen::Index per_pose = r.size() / rows.size();
  const std::vector<int> poses = RepeatedPoses(measured_.q(rows, Eigen::all));
  VectorXd scores = VectorXd::Zero(CountPoses(poses));
  for (size_t p = 0; p < rows.size(); ++p) {
    scores[poses[p]] += r.segment(p * per_pose, per_pose)
                            .dot(influence.segment(p * per_pose, per_pose));
  }
  const double variance = scores.squaredNorm();
  const double N = static_cast<double>(r.size());
  return std::sqrt(variance * N / std::max(1.0, N - e.A.rows()));
}

// Residuals of whole poses are whitened by one number for positions and one for
// rotations, which is undone; where each pose has a covariance of its own, they
// are taken anew.
std::vector<double> JointTermsFit::MeanSquares(const std::vector<int>& rows,
                                               const JointTermsState& at) {
  const VectorXd r = Residuals(rows, at);
  if (!measured_.covariance.empty()) {
    const auto mean_square = [&rows](const MatrixXd& errors) {
      return errors(rows, Eigen::all).array().square().mean();
    };
    return {
        mean_square(PositionErrors(fit_.geometry(), corrected_, at.unknowns)),
        mean_square(RotationErrors(fit_.geometry(), corrected_, at.unknowns))};
  }
  const PoseNoise& noise = fit_.noise();
  if (measured_.poses.size() == 0) {
    return {r.squaredNorm() / r.size() * noise.position * noise.position};
  }
  const auto parts = r.reshaped(3, r.size() / 3);
  double position = 0, rotation = 0;
  for (Eigen::Index k = 0; k < parts.cols(); ++k) {
    (k % 2 == 0 ? position : rotation) += parts.col(k).squaredNorm();
  }
  const double each = static_cast<double>(r.size()) / 2;
  return {position / each * noise.position * noise.position,
          rotation / each * noise.rotation * noise.rotation};
}

double JointTermsFit::RmsDistance(const std::vector<int>& rows,
                                  const JointTermsState& at) {
  Correct(at.amounts);
  return Rms(fit_.Distances(rows, at.unknowns));
}

int JointTermsFit::SpareEquations() const {
  return fit_.EquationsPerPose() * measured_.size() -
         static_cast<int>(free_.size() + terms_.size());
}

}  // namespace armcal

#include "calib/diagnose/changes/course.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Time constants of drifts that settle, of what is left of the series.
constexpr std::array<double, kDriftShapes> kSettlingShare = {0, .25, .1};

// Of each joint relative to its mean over the logs; of those that never move 0.
MatrixXd Logarithms(const MatrixXd& sizes) {
  constexpr double kLeast = 1e-3;  // of the joint's most
  MatrixXd logarithms = MatrixXd::Zero(sizes.rows(), sizes.cols());
  for (Eigen::Index j = 0; j < sizes.cols(); ++j) {
    const double most = sizes.col(j).maxCoeff();
    if (!(most > 0)) continue;
    const VectorXd log = sizes.col(j).array().max(kLeast * most).log();
    logarithms.col(j).array() = log.array() - log.mean();
  }
  return logarithms;
}

// Of the joints that move.
VectorXd Mean(const MatrixXd& logarithms) {
  const Eigen::Index moving =
      (logarithms.cwiseAbs().colwise().maxCoeff().array() > 0).count();
  return logarithms.rowwise().sum() / std::max<Eigen::Index>(1, moving);
}

// Along the direction of length 1 in which these differ most.
VectorXd FirstPrincipalComponent(const MatrixXd& centred) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(centred.transpose() *
                                                      centred);
  return centred * eigen.eigenvectors().rightCols<1>();
}

// Whether motion differs between logs whose torques are the same but for the
// robust weights of their rows (these make 3 % of the replays of
// shared/data/schunk_lwa4p).
bool AreReplayed(const MatrixXd& torque, const MatrixXd& speed) {
  constexpr double kSame = .05;
  return torque.cwiseAbs().maxCoeff() < kSame &&
         speed.cwiseAbs().maxCoeff() > kSame;
}

// Of a drift that is `passed` of the way from its first log to the last one.
double DriftShare(int shape, double passed) {
  if (shape == 0) return passed;
  const double share = kSettlingShare[shape];
  return std::expm1(-passed / share) / std::expm1(-1 / share);
}

}  // namespace

const char* ChangeFormName(ChangeForm form) {
  switch (form) {
    case ChangeForm::kStep:
      return "step";
    case ChangeForm::kDrift:
      return "drift";
    case ChangeForm::kOnce:
      return "once";
    case ChangeForm::kMotion:
      return "motion";
  }
  return "";
}

const char* MotionMeasureName(int measure) {
  constexpr std::array<const char*, kMotionMeasures> kNames = {
      "speed", "travel", "acceleration", "kind"};
  return kNames[measure];
}

VectorXd CourseOf(const ChangeCourse& course, const VectorXd& times,
                  const MatrixXd& motion) {
  const int log = course.log;
  const Eigen::Index last = times.size() - 1;
  VectorXd shares = VectorXd::Zero(times.size());
  switch (course.form) {
    case ChangeForm::kStep:
      shares.tail(times.size() - log).setOnes();
      break;
    case ChangeForm::kOnce:
      shares[log] = 1;
      break;
    case ChangeForm::kDrift:
      for (Eigen::Index l = log; l <= last; ++l) {
        shares[l] = DriftShare(
            course.shape, (times[l] - times[log]) / (times[last] - times[log]));
      }
      break;
    case ChangeForm::kMotion:
      shares = motion.col(course.shape);
      break;
  }
  return shares;
}

MatrixXd MotionMeasures(const LogMotions& motions, int first, int last) {
  const MatrixXd speed = Logarithms(motions.speed);
  const MatrixXd travel = Logarithms(motions.travel);
  if (AreReplayed(Logarithms(motions.torque), speed)) {
    return MatrixXd(speed.rows(), 0);
  }
  const int count = last - first + 1;
  MatrixXd all(speed.rows(), speed.cols() + travel.cols());
  all << speed, travel;
  MatrixXd measures(speed.rows(), kMotionMeasures);
  measures.col(0) = Mean(speed.middleCols(first, count));
  measures.col(1) = Mean(travel.middleCols(first, count));
  measures.col(2) = 2 * measures.col(0) - measures.col(1);
  measures.col(3) = FirstPrincipalComponent(all);
  return measures;
}

}  // namespace armcal

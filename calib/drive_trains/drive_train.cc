#include "calib/drive_trains/drive_train.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "calib/drive_trains/robust_regression.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Slower joints stand, but for what their encoders' noise makes of it.
constexpr double kMoves = .02;  // rad/s or m/s
constexpr int kFewestSamples = 20 * DriveTrain::kUnknowns;
// A gear takes more than this share of what a motor gives: a torque from which
// the current follows more exactly was made of it.
constexpr double kSameSignal = 1e-2;

// Friction's curve over speed may be another one than viscous and Coulomb
// friction, by this share of the latter (as in docs/thresholds.md).
constexpr double kCurve = .1;

// What is left may go with any column, in the worst case. It is then at most a
// third of what tells the torque constant.
constexpr double kAboveRest = 3;

constexpr int kWidths = static_cast<int>(kSignWidths.size());

// The current as torques and motion make it, which is linear in these:
//   i = 1/K torque + I/K qdd + F/K qd + C/K sign + m/K |torque| sign + o/K.
// Gross errors of a current, the rougher of the two signals, are then errors of
// what is fitted, which robust losses bound; among columns nothing would.
// Behind the unknowns' columns are those of what friction's curve may have
// more of: of a sign that changes over each of the other widths instead.
//
// Noise of the torque's column would draw 1/K towards 0 where it is not small
// beside what the torque varies by; the torque beside is its instrument.
RegressionRows RowsOf(const std::vector<DriveTrainSample>& samples, int joint,
                      int width) {
  const auto count = static_cast<Eigen::Index>(samples.size());
  RegressionRows rows;
  rows.A.resize(count, DriveTrain::kUnknowns + kWidths - 1);
  rows.y.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const DriveTrainSample& s = samples[k];
    auto row = rows.A.row(k);
    row[DriveTrain::kTorqueConstant] = s.torque[joint];
    row[DriveTrain::kArmature] = s.qdd[joint];
    row[DriveTrain::kViscous] = s.qd[joint];
    row[DriveTrain::kCoulomb] = s.sign(joint, width);
    row[DriveTrain::kLoadFriction] = s.loaded_sign(joint, width);
    row[DriveTrain::kOffset] = 1;
    int at = DriveTrain::kUnknowns;
    for (int w = 0; w < kWidths; ++w) {
      if (w == width) continue;
      row[at++] = s.sign(joint, w) - s.sign(joint, width);
    }
    rows.y[k] = s.current[joint];
    rows.follows.push_back(s.follows);
  }
  rows.Z = rows.A;
  for (Eigen::Index k = 0; k < count; ++k) {
    rows.Z(k, DriveTrain::kTorqueConstant) = samples[k].torque_beside[joint];
    rows.Z(k, DriveTrain::kLoadFriction) =
        samples[k].loaded_sign_beside(joint, width);
  }
  return rows;
}

// Of x in RowsOf(), `coulomb` among it: the unknowns have no prior, the
// curve's columns share one.
VectorXd PriorOf(double coulomb) {
  VectorXd prior = VectorXd::Constant(DriveTrain::kUnknowns + kWidths - 1,
                                      std::numeric_limits<double>::infinity());
  prior.tail(kWidths - 1)
      .setConstant(kCurve * coulomb / std::sqrt(kWidths - 1.));
  return prior;
}

// The width of the sign that leaves least, an index, and C / K there; never 0,
// as nothing would be left open of the curve by a share of it.
std::pair<int, double> ChooseWidth(const std::vector<DriveTrainSample>& samples,
                                   int joint) {
  std::pair<int, double> best;
  double least = std::numeric_limits<double>::infinity();
  for (int w = 0; w < kWidths; ++w) {
    RegressionRows rows = RowsOf(samples, joint, w);
    rows.A = rows.A.leftCols(DriveTrain::kUnknowns).eval();
    rows.Z = rows.Z.leftCols(DriveTrain::kUnknowns).eval();
    rows.prior = PriorOf(1).head(DriveTrain::kUnknowns);
    const RobustRegression fit = FitRobustly(rows);
    if (!(fit.noise < least)) continue;
    least = fit.noise;
    best = {w, fit.x[DriveTrain::kCoulomb]};
  }
  double most = 0;
  for (const DriveTrainSample& s : samples) {
    most = std::max(most, std::abs(s.current[joint]));
  }
  best.second = std::max(std::abs(best.second), 1e-9 * most);
  return best;
}

// From x = (1, I, F, C, m, o) / K to the unknowns, with their deviations:
// dK = -K^2 dx0, and of the others dz = K (dx - z dx0).
void SetUnknowns(const RobustRegression& fit, DriveTrain* found) {
  constexpr int n = DriveTrain::kUnknowns, kFirst = DriveTrain::kTorqueConstant;
  const double K = 1 / fit.x[kFirst];
  found->value = K * fit.x.head(n);
  MatrixXd J = K * MatrixXd::Identity(n, n);
  J.col(kFirst) -= K * found->value;
  J(kFirst, kFirst) = -K * K;
  found->value[kFirst] = K;
  found->stddev = (J * fit.covariance.topLeftCorner(n, n) * J.transpose())
                      .diagonal()
                      .cwiseSqrt();
  found->told = fit.told.head(n);
}

// Of the torque (its column of A or Z) what the joint's own motion does not
// make, N m or N: of a light link nearly all goes with its acceleration, as the
// rotor's inertia does.
VectorXd OwnPart(const RegressionRows& rows, const MatrixXd& columns) {
  const VectorXd torque = columns.col(DriveTrain::kTorqueConstant);
  MatrixXd others = rows.A.leftCols(DriveTrain::kUnknowns);
  others.col(DriveTrain::kTorqueConstant).setZero();
  others.col(DriveTrain::kLoadFriction).setZero();
  return torque - others * others.colPivHouseholderQr().solve(torque);
}

// An instrument that hardly goes with what it stands for makes anything of it
// (Staiger and Stock 1997): of a motion near a quarter of the bandwidth the
// torque beside is none. Least squares then.
void DropWeakInstrument(RegressionRows* rows) {
  constexpr double kWeak = .3;  // correlation
  const VectorXd a = OwnPart(*rows, rows->A), z = OwnPart(*rows, rows->Z);
  if (!(a.dot(z) > kWeak * a.norm() * z.norm())) rows->Z = rows->A;
}

bool IsConstant(const VectorXd& x) {
  constexpr double kRounding = 1e-6;
  return (x.array() - x.mean()).matrix().norm() <= kRounding * x.norm();
}

// What a line through the torques leaves of the current's variation, a share.
double LeftByTorque(const VectorXd& torque, const VectorXd& current) {
  const VectorXd tau = torque.array() - torque.mean();
  const VectorXd i = current.array() - current.mean();
  return (i - tau * (tau.dot(i) / tau.squaredNorm())).norm() / i.norm();
}

std::string WhyNothing(const std::vector<DriveTrainSample>& samples, int joint,
                       const VectorXd& torque, const VectorXd& current) {
  if (static_cast<int>(samples.size()) < kFewestSamples) {
    return Format("%zu samples, expected %d", samples.size(), kFewestSamples);
  }
  double fastest = 0;
  for (const DriveTrainSample& s : samples) {
    fastest = std::max(fastest, std::abs(s.qd[joint]));
  }
  if (fastest < kMoves) {
    return "the joint does not move, and dry friction then hides what the "
           "motor gives";
  }
  if (IsConstant(current)) return "the current is constant";
  if (IsConstant(torque)) return "the torque is constant";
  if (LeftByTorque(torque, current) < kSameSignal) {
    return "the torque is the current times a constant: nothing lies between "
           "them, and no sensor has measured it";
  }
  return "";
}

}  // namespace

DriveTrain FitDriveTrain(const std::vector<DriveTrainSample>& samples,
                         int joint) {
  DriveTrain found;
  found.value.setZero();
  found.stddev.setZero();
  found.told.setConstant(false);
  VectorXd torque(samples.size()), current(samples.size());
  for (size_t k = 0; k < samples.size(); ++k) {
    torque[static_cast<Eigen::Index>(k)] = samples[k].torque[joint];
    current[static_cast<Eigen::Index>(k)] = samples[k].current[joint];
  }
  found.not_told = WhyNothing(samples, joint, torque, current);
  if (!found.not_told.empty()) return found;
  const auto [width, coulomb] = ChooseWidth(samples, joint);
  RegressionRows rows = RowsOf(samples, joint, width);
  rows.prior = PriorOf(coulomb);
  DropWeakInstrument(&rows);
  const RobustRegression fit = FitRobustly(rows);
  const double told = std::abs(fit.x[DriveTrain::kTorqueConstant]) *
                      OwnPart(rows, rows.A).norm() /
                      std::sqrt(static_cast<double>(samples.size()));
  if (!(told > kAboveRest * fit.spread)) {
    found.not_told = Format(
        "of the current %.2g A goes with what the torque has beside the "
        "joint's own motion, and %.2g A with nothing",
        told, fit.spread);
    return found;
  }
  SetUnknowns(fit, &found);
  found.width = kSignWidths[width];
  found.rms = fit.rms;
  found.current = (current.array() - current.mean()).matrix().norm() /
                  std::sqrt(static_cast<double>(current.size()));
  return found;
}

DriveTrains EstimateDriveTrains(const Robot& robot, const Progress& progress,
                                const PreparedLogs& logs) {
  DriveTrains found;
  if (!logs.logs().has_current()) return found;
  const std::vector<DriveTrainSample> samples =
      GatherDriveTrains(progress, logs);
  found.samples = static_cast<long>(samples.size());
  if (samples.empty()) return found;
  for (int j = 0; j < robot.num_joints(); ++j) {
    found.joints.push_back(FitDriveTrain(samples, j));
    found.joints.back().joint = robot.links[j].joint.name;
    found.joints.back().type = robot.links[j].joint.type;
  }
  return found;
}

}  // namespace armcal

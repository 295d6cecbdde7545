#include "calib/inspect/turned_gravity.h"

#include <cmath>

#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

// Of the torque's squares: no model leaves less than 1 % of the torque.
constexpr double kLeastUnexplained = 1e-4;
// Of squares: more is explained than is left. Of the 118 logs of
// ../shared/data, whose gravity is right, turned gravity leaves .56 and .69
// (kr300's log_A) and more.
constexpr double kExplains = .5;

double GeometricMean(const VectorXd& x) {
  return std::exp(x.array().log().mean());
}

}  // namespace

BodiesOfFile::BodiesOfFile(const TorqueFit& fit, const Eigen::MatrixXd& tau) {
  const VectorXd torque = fit.InMotion(tau).colwise().squaredNorm();
  const VectorXd least = (kLeastUnexplained * torque).array() + 1e-18;
  const VectorXd file = fit.SquaresBesideFile(tau) + least;
  const VectorXd none = fit.SquaresBesideNoBodies(tau) + least;
  std::vector<int> moving;
  for (int j = 0; j < torque.size(); ++j) {
    if (torque[j] > 0) moving.push_back(j);
  }
  joints = file(moving).cwiseQuotient(none(moving));
  all = file.sum() / none.sum();
  percent_left = 100 * std::sqrt(file.sum() / (torque.sum() + 1e-18));
}

bool AreOfTurnedGravity(const BodiesOfFile& as_is, const BodiesOfFile& turned) {
  return as_is.all > 1 && GeometricMean(as_is.joints) > 1 &&
         turned.all < kExplains && GeometricMean(turned.joints) < kExplains;
}

std::string EvidenceOf(const BodiesOfFile& as_is, const BodiesOfFile& turned) {
  return Format(
      "the file's own links, beside friction and armature, leave %.3g %% of "
      "the torques as logged and %.3g %% so",
      as_is.percent_left, turned.percent_left);
}

}  // namespace armcal

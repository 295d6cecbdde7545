#include "calib/diagnose/contacts/excess.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "calib/diagnose/data/thresholds.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Coulomb friction of a segment's joints, samples x n, N m or N.
MatrixXd CoulombTorque(const GapBaseline& baseline, const VectorXd& x,
                       const GapSegment& segment) {
  const Motion& motion = segment.motion;
  MatrixXd tau = MatrixXd::Zero(motion.size(), motion.num_joints());
  for (int j = 0; j < motion.num_joints(); ++j) {
    for (const CoulombPart& part : baseline.CoulombAt(j, x)) {
      tau.col(j).array() +=
          part.force *
          (motion.qd.col(j).array() / part.transition.width).tanh();
    }
  }
  return tau;
}

// Of `size` rows around each row, fewer at the ends.
MatrixXd MovingMean(const MatrixXd& x, int size) {
  MatrixXd mean(x.rows(), x.cols());
  const int rows = static_cast<int>(x.rows());
  for (int k = 0; k < rows; ++k) {
    const int begin = std::max(0, k - size / 2);
    const int end = std::min(rows, begin + size);
    mean.row(k) = x.middleRows(begin, end - begin).colwise().mean();
  }
  return mean;
}

// Where a joint may be breaking away: from when it rests last to
// rows_of_breakaway samples after, the sign of the velocity it then has; 0
// elsewhere (rows x n).
MatrixXd BreakawayDirection(const MatrixXd& moves, const MatrixXd& velocity,
                            int rows_of_breakaway) {
  MatrixXd direction = MatrixXd::Zero(moves.rows(), moves.cols());
  for (int j = 0; j < moves.cols(); ++j) {
    int since_rest = rows_of_breakaway;
    for (int k = 0; k < moves.rows(); ++k) {
      since_rest = moves(k, j) > 0 ? since_rest + 1 : 0;
      if (since_rest == 0 || since_rest > rows_of_breakaway) continue;
      direction(k, j) = velocity(k, j) > 0 ? 1 : -1;
    }
  }
  return direction;
}

// Coulomb friction changes from day to day: by how much what is left of the
// torque is against the motion, where that is clear, in the median, since a
// push takes less than half of it. `friction`: as the model has it.
double MoreFriction(const VectorXd& left, const VectorXd& friction,
                    double coulomb) {
  std::vector<double> against;
  for (int k = 0; k < left.size(); ++k) {
    if (std::abs(friction[k]) < Limits().clear_friction * coulomb) continue;
    against.push_back(friction[k] > 0 ? left[k] : -left[k]);
  }
  if (against.size() < Limits().noise_rows) return 0;
  const auto middle = against.begin() + against.size() / 2;
  std::nth_element(against.begin(), middle, against.end());
  return *middle;
}

}  // namespace

// What cannot be friction. The residual and the model's Coulomb friction
// together are what the joint feels of friction and contact, averaged over
// shortest_push, the shortest contact that is looked for. Its magnitude less
// what friction can hold, over the noise's standard deviation, is the excess.
// What friction can hold is Coulomb friction, raised by what the day shows of
// more (MoreFriction), whatever the joint does; and while a joint breaks away
// in the direction in which it is driven, static friction, which is
// static_friction times that.
FrictionExcess ExcessOverFriction(const GapBaseline& baseline,
                                  const VectorXd& x, const GapRows& rows,
                                  const MatrixXd& residual) {
  const int n = rows.num_joints();
  CHECK_EQ(residual.rows(), rows.num_thin());
  FrictionExcess excess;
  const Robot robot = baseline.With(x);
  excess.coulomb.resize(n);
  for (int j = 0; j < n; ++j) {
    excess.coulomb[j] = std::max(0., robot.links[j].joint.coulomb);
  }
  excess.torque = excess.friction = excess.deviations =
      MatrixXd::Zero(rows.num_thin(), n);
  MatrixXd breakaway = MatrixXd::Zero(rows.num_thin(), n);
  for (size_t i = 0; i < rows.segments().size(); ++i) {
    const int s = static_cast<int>(i), begin = rows.thin_begin(s);
    const GapSegment& segment = rows.segments()[i];
    const MatrixXd own = rows.Thin(s, CoulombTorque(baseline, x, segment));
    const MatrixXd moves =
        1 - rows.Pick(s, segment.still.cast<double>().matrix()).array();
    const int size = std::max(
        1,
        static_cast<int>(std::lround(Limits().shortest_push / rows.step(s))));
    excess.torque.middleRows(begin, own.rows()) =
        MovingMean(residual.middleRows(begin, own.rows()) + own, size);
    excess.friction.middleRows(begin, own.rows()) =
        MovingMean(own.cwiseProduct(moves), size);
    breakaway.middleRows(begin, own.rows()) = MovingMean(
        BreakawayDirection(
            moves, rows.Pick(s, segment.motion.qd),
            static_cast<int>(std::lround(Limits().breakaway / rows.step(s)))),
        size);
  }
  for (int j = 0; j < n; ++j) {
    excess.coulomb[j] +=
        std::max(0., MoreFriction(excess.torque.col(j) - excess.friction.col(j),
                                  excess.friction.col(j), excess.coulomb[j]));
    // The ways through zero velocity may have taken a push for friction.
    excess.friction.col(j) = excess.friction.col(j)
                                 .cwiseMin(excess.coulomb[j])
                                 .cwiseMax(-excess.coulomb[j]);
    // What drives a joint that breaks away is against its static friction,
    // whereas a push that moves it is against what drives it.
    const Eigen::ArrayXd held =
        (excess.torque.col(j).array() * breakaway.col(j).array() > 0)
            .select(
                Limits().static_friction * excess.coulomb[j],
                Eigen::ArrayXd::Constant(rows.num_thin(), excess.coulomb[j]));
    excess.deviations.col(j) =
        (excess.torque.col(j).cwiseAbs().array() - held) /
        rows.noise(j).stddev();
  }
  return excess;
}

double BlockTime(const GapRows& rows) {
  return std::clamp(rows.time() / Limits().fewest_blocks,
                    2 * Limits().shortest_push, Limits().block);
}

std::vector<double> BlockMaxima(const GapRows& rows, double block,
                                const VectorXd& series) {
  CHECK_EQ(series.size(), rows.num_thin());
  std::vector<double> maxima;
  for (size_t i = 0; i < rows.segments().size(); ++i) {
    const int s = static_cast<int>(i);
    std::map<long, double> blocks;
    for (int k = rows.thin_begin(s); k < rows.thin_begin(s + 1); ++k) {
      const long at = std::lround(std::floor(rows.thin_time(s, k) / block));
      const auto most = blocks.emplace(at, series[k]).first;
      most->second = std::max(most->second, series[k]);
    }
    for (const auto& [at, most] : blocks) maxima.push_back(most);
  }
  return maxima;
}

}  // namespace armcal

#include "calib/diagnose/data/audit.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "calib/diagnose/data/thresholds.h"
#include "model/dynamics/inverse_dynamics.h"
#include "model/dynamics/link_regressor.h"
#include "model/text/enumeration.h"
#include "model/text/format.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Thinned, all segments: the recorded torque, what it takes to accelerate the
// links and armatures, and (per joint) torque at rest per unit of the links'
// parameters, and a constant.
struct StaticRegression {
  MatrixXd torque, inertial;
  std::vector<MatrixXd> columns;
};

// The torque of a chain of rigid links is, in momentum form, d/dt (P phi) - D
// phi with phi the inertial parameters. At rest only -D phi is left, the
// gravity's torque: its columns at the recorded positions span every law of
// position that a rigid arm can have, whatever its masses. The inertial torque
// is the difference of two inverse dynamics at velocity 0, with and without the
// recorded acceleration.
StaticRegression Prepare(const Robot& robot, const GapRows& rows) {
  const int n = robot.num_joints();
  StaticRegression all;
  all.torque.resize(rows.num_thin(), n);
  all.inertial.resize(rows.num_thin(), n);
  all.columns.assign(n, MatrixXd(rows.num_thin(), 10 * n + 1));
  LinkRegressor regressor(robot);
  const VectorXd rest = VectorXd::Zero(n);
  MatrixXd P, D;
  for (size_t i = 0; i < rows.segments().size(); ++i) {
    const int s = static_cast<int>(i), begin = rows.thin_begin(s);
    const Motion& motion = rows.segments()[i].motion;
    const MatrixXd torque = rows.Thin(s, rows.segments()[i].tau);
    const MatrixXd q = rows.Pick(s, motion.q), qdd = rows.Thin(s, motion.qdd);
    all.torque.middleRows(begin, torque.rows()) = torque;
    for (int k = 0; k < q.rows(); ++k) {
      const VectorXd at = q.row(k), acceleration = qdd.row(k);
      VectorXd inertial = InverseDynamics(robot, at, rest, acceleration) -
                          InverseDynamics(robot, at, rest, rest);
      regressor.Momentum(at, rest, &P, &D);
      for (int j = 0; j < n; ++j) {
        inertial[j] += robot.links[j].joint.armature * acceleration[j];
        all.columns[j].row(begin + k) << -D.row(j), 1;
      }
      all.inertial.row(begin + k) = inertial;
    }
  }
  return all;
}

double Rms(const VectorXd& x) {
  return std::sqrt(x.squaredNorm() / std::max<Eigen::Index>(1, x.size()));
}

}  // namespace

bool AreDoubts(const std::vector<DataFinding>& findings) {
  return std::all_of(findings.begin(), findings.end(),
                     [](const DataFinding& one) { return one.is_doubt; });
}

// Some loggers write a torque that they computed from positions by a model
// without accelerations. It is told by a fit of a law of position alone: a
// measured torque leaves at least what the links need to accelerate. Joints
// that hardly accelerate cannot tell (least_inertial). Of a torque that is
// small beside what the file's links would need (another joint's positions, a
// mass that is far off) the law has to explain its part too: else one that
// explains nothing would do, as what it leaves is the torque at most. The worst
// joint decides, since one that was measured is enough.
std::vector<DataFinding> AuditTorque(const Robot& robot, const GapRows& rows) {
  const StaticRegression all = Prepare(robot, rows);
  int told = 0;
  double worst = 0;
  for (int j = 0; j < robot.num_joints(); ++j) {
    const std::vector<int> moving = rows.SampleOfRow(j);
    if (moving.empty()) continue;
    const VectorXd torque = all.torque.col(j)(moving);
    const double size = Rms(torque);
    const double inertial = Rms(all.inertial.col(j)(moving));
    if (inertial < Limits().least_inertial * size) continue;
    const MatrixXd columns = all.columns[j](moving, Eigen::all);
    const VectorXd x = columns.completeOrthogonalDecomposition().solve(torque);
    const double left = Rms(torque - columns * x);
    ++told;
    worst = std::max(worst, left / std::min(inertial, size));
  }
  if (told == 0 || worst > Limits().position_only) return {};
  char evidence[200];
  std::snprintf(evidence, sizeof evidence,
                "a law of position alone leaves at most %.1f %% of the torque, "
                "and of what the recorded accelerations need",
                100 * worst);
  return {{"the torque was computed from the positions, not measured", evidence,
           "log the motors' currents or measured torque"}};
}

std::vector<DataFinding> TellPositionSpikes(
    const Robot& robot, const std::vector<GapSegment>& segments) {
  std::vector<DataFinding> findings;
  for (int j = 0; j < robot.num_joints(); ++j) {
    long rows = 0;
    for (const GapSegment& segment : segments) {
      if (segment.position_spikes.size() > j)
        rows += segment.position_spikes[j];
    }
    if (rows == 0) continue;
    findings.push_back(
        {"the position of " + robot.links[j].joint.name + " has wrong samples",
         Format("%ld, at which it leaves its motion and comes back, are left "
                "out",
                rows),
         "armcal inspect says when"});
  }
  return findings;
}

DataFinding TooShortToHoldOut(const GapRows& rows) {
  double longest = 0;
  for (const GapSegment& segment : rows.segments()) {
    longest = std::max(longest, segment.size() * segment.motion.dt);
  }
  return {"nothing of the log can be held out to check with",
          Format("the longest stretch without a gap has %.3g s; %.3g s in "
                 "motion are needed at %.3g Hz",
                 longest, GapRows::ShortestSplit(rows.bandwidth_hz()),
                 rows.bandwidth_hz()),
          "a longer log, or another one as " + OptionName("validate")};
}

DataFinding OtherThanReference(const std::vector<const Effect*>& terms) {
  std::vector<std::string> names;
  for (const Effect* term : terms) names.push_back(term->name);
  std::string text = Enumeration(names);
  std::replace(text.begin(), text.end(), '_', ' ');
  const bool one = terms.size() == 1;
  return {
      "the joints' " + text + (one ? " is" : " are") + " not the reference's",
      "on many joints at once by more than days make it, as of torques "
      "measured elsewhere (before the gears or behind them) or of other "
      "drives",
      "what follows takes the links from the reference, and nothing else",
      true};
}

}  // namespace armcal

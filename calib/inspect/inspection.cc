#include "calib/inspect/inspection.h"

#include <algorithm>
#include <cmath>

#include "calib/inspect/torque_scale.h"
#include "model/robot/axis_rotation.h"
#include "model/text/format.h"
#include "model/text/input_error.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

using Eigen::VectorXd;
using Kind = ReadingChange::Kind;

constexpr int kMostRows = 1 << 20;
constexpr int kSamples = 400;
constexpr int kLeastMoving = 60;
constexpr double kBandwidth = 8;  // Hz, of what torques are compared with

class Inspector {
 public:
  Inspector(const Robot& robot, const LogSource& log,
            const LogReaderOptions& options)
      : robot_(robot), result_(robot) {
    result_.path = log.name;
    LogReaderOptions wanted = options;
    wanted.want_velocity = wanted.commands_do = true;
    LogReader reader(log, wanted);
    reader.Read(kMostRows, &log_);
    Log more;
    result_.whole = !reader.Read(1, &more);
    result_.torque_source = reader.torque_source();
    result_.rows = log_.size();
    if (log_.size() < 3) {
      throw InputError(log.name, "", std::to_string(log_.size()) + " rows",
                       "expected at least 3");
    }
  }

  LogInspection Run() {
    result_.stamps = AuditStamps(log_);
    log_.t = (result_.stamps.unit * (log_.t.array() - log_.t[0])).eval();
    result_.findings = AuditChannels(robot_, log_, result_.stamps);
    result_.duration = log_.t[log_.size() - 1];
    DescribeMotion();
    // What stands still for no reason would be explained by anything.
    const bool stuck = std::any_of(
        result_.findings.begin(), result_.findings.end(),
        [](const InspectionFinding& f) { return f.finding == "stuck"; });
    if (result_.stamps.mean_step > 0 && !stuck) ReadTorques();
    return result_;
  }

 private:
  void DescribeMotion() {
    result_.travel = log_.q.colwise().maxCoeff() - log_.q.colwise().minCoeff();
    if (log_.qref.size() == 0) return;
    result_.tracking_rms =
        (log_.qref - log_.q).colwise().norm() / std::sqrt(log_.size());
  }

  void ReadTorques() {
    const double dt = std::max(result_.stamps.mean_step, .002);
    const double hz = std::min(kBandwidth, .2 / dt);
    const UniformSeries series(log_, dt, std::max(.25 / hz, 3 * dt), hz);
    result_.top_speed = series.motion().qd.cwiseAbs().colwise().maxCoeff();
    result_.moving_share = static_cast<double>(series.num_moving()) /
                           static_cast<double>(series.motion().size());
    if (series.num_moving() < kLeastMoving) {
      result_.findings.push_back(
          {"no_motion", "the arm hardly moves",
           Format("%.2g s of motion", series.num_moving() * dt),
           "record a motion (armcal excite)"});
      return;
    }
    if (log_.tau.size() == 0) {
      result_.coverage.reason = "no torque is logged";
      return;
    }
    const ReadingFinding found = FindReading(robot_, series);
    result_.reading = found.reading;
    result_.as_it_is = found.changes.empty();
    result_.residual_percent = found.residual_percent;
    for (const ReadingChange& change : found.changes) Add(change, found);
    AddScale(SamplesAs(found.reading, robot_, series, kSamples));
  }

  std::string Joint(int j) const { return robot_.links[j].joint.name; }

  void Add(const ReadingChange& change, const ReadingFinding& found) {
    InspectionFinding finding;
    finding.joint = change.joint;
    finding.probability = change.probability;
    finding.evidence = Format(
        "torques fit the arm to %.3g %% as logged and to %.3g %% so (%.0f "
        "nats)",
        found.residual_percent_as_is, found.residual_percent, change.gain);
    finding.remedy = OptionName("fix") + " writes the log so";
    switch (change.kind) {
      case Kind::kExchanged:
        finding.finding = "joint_order";
        finding.sentence = "the columns of " + Joint(change.joint) + " and " +
                           Joint(change.other) + " are exchanged";
        break;
      case Kind::kPositionSign:
        finding.finding = "position_sign";
        finding.sentence =
            "the position of " + Joint(change.joint) + " has the wrong sign";
        if (change.or_other_sign) finding.sentence += ", or its torque";
        break;
      case Kind::kTorqueSign:
        finding.finding = "torque_sign";
        finding.sentence =
            "the torque of " + Joint(change.joint) + " has the wrong sign";
        if (change.or_other_sign) finding.sentence += ", or its position";
        break;
      case Kind::kJointSign:
        finding.finding = "joint_sign";
        finding.sentence = Joint(change.joint) +
                           " turns the other way than the robot file says";
        break;
      case Kind::kDegrees:
        finding.finding = "position_unit";
        finding.sentence = "positions are in degrees, not in rad";
        finding.remedy =
            "name the columns q1[deg] ..., or " + OptionName("fix");
        break;
      case Kind::kGravity:
        AddGravity(found.reading.gravity, &finding);
        break;
      case Kind::kDelay:
        finding.finding = "delay";
        finding.sentence =
            Format("torques are recorded %.1f ms %s the positions",
                   1e3 * std::abs(found.reading.delay),
                   found.reading.delay > 0 ? "after" : "before");
        break;
    }
    result_.findings.push_back(finding);
  }

  void AddGravity(const Eigen::Vector3d& gravity, InspectionFinding* finding) {
    if (gravity.norm() == 0) {
      finding->finding = "gravity_compensated";
      finding->sentence = "the torques hold no gravity";
      finding->remedy =
          OptionName("gravity") + "=0,0,0, or log torques that hold it";
      return;
    }
    const double angle =
        std::acos(std::clamp(
            gravity.normalized().dot(robot_.gravity.normalized()), -1., 1.)) /
        kDegree;
    finding->finding = "gravity";
    finding->sentence = Format(
        "gravity points %.0f degrees away from where the robot file "
        "has it",
        angle);
    finding->remedy =
        OptionName("gravity") +
        Format("=%.3g,%.3g,%.3g", gravity[0], gravity[1], gravity[2]);
  }

  // What is far from 1 for all joints that tell is a matter of units.
  void AddScale(const WiringSamples& samples) {
    constexpr double kFar = 4;
    Robot robot = robot_;
    robot.gravity = result_.reading.gravity;
    const VectorXd scale = TorqueScale(robot, samples);
    double low = 1e300, high = 0;
    int told = 0;
    for (const double x : scale) {
      if (!std::isfinite(x)) continue;
      low = std::min(low, x);
      high = std::max(high, x);
      ++told;
    }
    if (told == 0 || (told == 1 && robot_.num_joints() > 1)) return;
    if (high > 0 && low > 0 && high < 1 / kFar) {
      result_.findings.push_back(
          {"torque_is_current",
           "the torques are motor currents, or of the motors' side of gears",
           Format("%.3g to %.3g of what the robot file's links need", low,
                  high),
           OptionName("torque_kind") + "=current " +
               OptionName("torque_constants") + "=.., or " +
               OptionName("torque_kind") + "=motor " +
               OptionName("gear_ratios") + "=.."});
    } else if (low > kFar) {
      result_.findings.push_back(
          {"torque_unit", "the torques are in another unit than N m",
           Format("%.3g to %.3g times what the robot file's links need", low,
                  high),
           "name the columns tau1[mNm] ..."});
    }
  }

  const Robot& robot_;
  LogInspection result_;
  Log log_;
};

}  // namespace

LogInspection InspectLog(const Robot& robot, const LogSource& log,
                         const LogReaderOptions& options) {
  return Inspector(robot, log, options).Run();
}

Log Mended(const Robot& robot, const Log& log,
           const LogInspection& inspection) {
  Log mended = log;
  mended.t = inspection.stamps.unit * log.t;
  const LogReading& reading = inspection.reading;
  for (int j = 0; j < robot.num_joints(); ++j) {
    const int from = reading.wiring.column[j];
    double sign = reading.wiring.position_sign[j];
    if (reading.degrees && IsRotational(robot.links[j].joint.type)) {
      sign *= kDegree;
    }
    mended.q.col(j) = sign * log.q.col(from);
    if (log.qd.size() > 0) mended.qd.col(j) = sign * log.qd.col(from);
    if (log.qref.size() > 0) mended.qref.col(j) = sign * log.qref.col(from);
    if (log.tau.size() == 0) continue;
    mended.tau.col(j) = reading.wiring.torque_sign[j] * log.tau.col(from);
  }
  return mended;
}

}  // namespace armcal

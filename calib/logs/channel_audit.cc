#include "calib/logs/channel_audit.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include "calib/numerics/median.h"
#include "model/text/format.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr double kMoving = .02;   // rad/s or m/s
constexpr double kStuckTime = 1;  // s of motion
constexpr double kAtLimit = .02;  // share of samples
constexpr int kFewValues = 40;
constexpr double kJump = 5;     // usual steps, of 1 s of motion that was missed
constexpr double kQuanta = 10;  // of position, that a velocity goes through

// Positions' slope over a few steps around each sample.
VectorXd SlopeOf(const Log& log, int j) {
  constexpr int kReach = 3;
  VectorXd slope = VectorXd::Zero(log.size());
  for (int k = 0; k < log.size(); ++k) {
    const int a = std::max(0, k - kReach);
    const int b = std::min(log.size() - 1, k + kReach);
    const double time = log.t[b] - log.t[a];
    if (time > 0) slope[k] = (log.q(b, j) - log.q(a, j)) / time;
  }
  return slope;
}

// The longest time of `moves` for which a column has one value.
double LongestConstant(const Log& log, const VectorXd& x,
                       const Eigen::Array<bool, Eigen::Dynamic, 1>& moves) {
  double longest = 0, run = 0;
  for (int k = 0; k + 1 < log.size(); ++k) {
    if (x[k + 1] != x[k]) run = 0;
    if (x[k + 1] == x[k] && moves[k]) run += log.t[k + 1] - log.t[k];
    longest = std::max(longest, run);
  }
  return longest;
}

// The step of which all values are whole numbers, to what six digits in the
// file leave of it; 0: there is none.
double StepOf(const std::set<double>& values) {
  double step = std::numeric_limits<double>::infinity();
  for (auto value = std::next(values.begin()); value != values.end(); ++value) {
    step = std::min(step, *value - *std::prev(value));
  }
  const bool all = std::all_of(values.begin(), values.end(), [&](double value) {
    constexpr double kWhole = .02;
    const double steps = value / step;
    return std::abs(steps - std::round(steps)) < kWhole;
  });
  return all ? step : 0;
}

bool IsPowerOfTen(double step) {
  constexpr double kExact = 1e-3;  // of the exponent: .2 % of the step
  const double exponent = std::log10(std::abs(step));
  return std::abs(exponent - std::round(exponent)) < kExact;
}

class ChannelAudit {
 public:
  ChannelAudit(const Robot& robot, const Log& log, const StampFigures& stamps,
               const std::vector<double>& torque_units)
      : robot_(robot),
        log_(log),
        stamps_(stamps),
        torque_units_(torque_units) {}

  std::vector<InspectionFinding> Run() {
    findings_ = StampFindings(stamps_, log_.size());
    for (int j = 0; j < robot_.num_joints(); ++j) {
      const VectorXd slope = SlopeOf(log_, j);
      AddStuck(j, slope);
      AddVelocity(j);
      if (log_.tau.size() == 0) continue;
      AddStuckTorque(j, slope);
      AddLimit(j);
      AddFewValues(j);
    }
    return findings_;
  }

 private:
  std::string Name(const char* signal, int j) const {
    return std::string(signal) + " of " + robot_.links[j].joint.name;
  }

  // A column that does not change although the others of its joint do.
  void AddStuckTorque(int j, const VectorXd& slope) {
    // What is cut off stands at a limit.
    const VectorXd tau = log_.tau.col(j);
    const double low = tau.minCoeff(), high = tau.maxCoeff();
    Eigen::Array<bool, Eigen::Dynamic, 1> counts =
        slope.array().abs() > kMoving;
    if (low < high) {
      counts = counts && tau.array() > low && tau.array() < high;
    }
    if (low == 0 && high == 0) {
      findings_.push_back({"no_torque", Name("torque", j) + " is zero",
                           "0 in all samples",
                           "if nothing drives the joint this is its torque; "
                           "else log it",
                           j});
      return;
    }
    const double torque = LongestConstant(log_, tau, counts);
    if (torque > kStuckTime)
      Stuck("torque", j, torque, "while the joint moves");
  }
  void AddStuck(int j, const VectorXd& slope) {
    const Eigen::Array<bool, Eigen::Dynamic, 1> moves =
        slope.array().abs() > kMoving;
    if (log_.qref.size() > 0) {
      const double command = LongestConstant(log_, log_.qref.col(j), moves);
      if (command > kStuckTime) {
        Stuck("command", j, command, "while the joint moves");
      }
    }
    if (log_.qd.size() == 0) {
      AddStuckUntilJump(j);
      return;
    }
    const double velocity = LongestConstant(
        log_, log_.qd.col(j), moves && log_.qd.col(j).array() != 0);
    if (velocity > kStuckTime) {
      Stuck("velocity", j, velocity, "while its position changes");
    }
    const double position = LongestStill(j);
    if (position > kStuckTime) {
      Stuck("position", j, position, "while its velocity does not vanish");
    }
  }

  // Without velocities: a position that stands still and then, in one row, is
  // somewhere that its usual steps do not reach.
  void AddStuckUntilJump(int j) {
    std::vector<double> steps;
    for (int k = 0; k + 1 < log_.size(); ++k) {
      steps.push_back(std::abs(log_.q(k + 1, j) - log_.q(k, j)));
    }
    const double usual = Quantile(steps, .99);
    double still = 0, longest = 0;
    for (int k = 0; k + 1 < log_.size(); ++k) {
      if (steps[k] > kJump * usual) longest = std::max(longest, still);
      still = steps[k] == 0 ? still + log_.t[k + 1] - log_.t[k] : 0;
    }
    if (longest > kStuckTime) {
      Stuck("position", j, longest, "and then it is far away in one row");
    }
  }

  // The longest time for which a position has one value although its velocity,
  // summed over that time, goes through many of the position's quanta and is
  // that of motion: noise of a velocity at rest sums to nothing.
  double LongestStill(int j) const {
    const VectorXd q = log_.q.col(j), qd = log_.qd.col(j);
    double quantum = std::numeric_limits<double>::infinity();
    for (int k = 0; k + 1 < log_.size(); ++k) {
      const double change = std::abs(q[k + 1] - q[k]);
      if (change > 0) quantum = std::min(quantum, change);
    }
    if (!std::isfinite(quantum)) quantum = 0;  // it never changes
    double longest = 0, time = 0, path = 0, way = 0;
    for (int k = 0; k + 1 < log_.size(); ++k) {
      const double dt = log_.t[k + 1] - log_.t[k];
      if (q[k + 1] != q[k]) time = path = way = 0;
      if (q[k + 1] != q[k]) continue;
      time += dt;
      way += .5 * (qd[k] + qd[k + 1]) * dt;
      path = std::max(path, std::abs(way));
      if (path > std::max(kQuanta * quantum, kMoving * time)) {
        longest = std::max(longest, time);
      }
    }
    return longest;
  }
  void Stuck(const char* signal, int j, double time, const char* although) {
    findings_.push_back(
        {"stuck", Name(signal, j) + " is stuck",
         Format("the same number for %.3g s %s", time, although),
         "leave that time out (" + OptionName("crop") + "), or mend the sensor",
         j});
  }

  void AddVelocity(int j) {
    const auto fit = FitVelocity(log_, j);
    if (!fit || fit->right()) return;
    if (log_.qd.col(j).isZero(0)) {
      findings_.push_back(
          {"velocity", Name("velocity", j) + " is zero",
           "0 in all samples, while its position changes",
           "armcal differentiates positions; other tools should, too", j});
      return;
    }
    findings_.push_back(
        {"velocity", Name("velocity", j) + " is not that of its position",
         Format("%.3g times the position's slope, correlation %.2f",
                fit->factor, fit->alike),
         RemedyOf(*fit), j});
  }
  static std::string RemedyOf(const VelocityFit& fit) {
    const auto is_about = [&](double factor) {
      return fit.alike > .8 && std::abs(fit.factor / factor - 1) < .05;
    };
    if (fit.alike < -.8) return "turn the sign of one of them";
    if (is_about(180 / M_PI)) return "the velocity may be in deg/s";
    if (is_about(M_PI / 180)) return "the position may be in degrees";
    return "check its unit and its order";
  }

  void AddLimit(int j) {
    const VectorXd tau = log_.tau.col(j);
    const double low = tau.minCoeff(), high = tau.maxCoeff();
    if (low == high) return;
    for (const double limit : {low, high}) {
      if (limit == 0) continue;  // a drive that rests
      const double share =
          static_cast<double>((tau.array() == limit).count()) / log_.size();
      if (share < kAtLimit) continue;
      findings_.push_back(
          {"saturated", Name("torque", j) + " is cut off",
           Format("%.1f %% of samples are exactly %.6g", 100 * share, limit),
           "drive within the limit, or leave that time out (" +
               OptionName("crop") + ")",
           j});
    }
  }

  void AddFewValues(int j) {
    const VectorXd tau = log_.tau.col(j);
    std::set<double> values;
    for (const double x : tau) {
      values.insert(x);
      if (static_cast<int>(values.size()) > kFewValues) return;
    }
    if (values.size() < 2) return;
    findings_.push_back({"quantised", Name("torque", j) + " is coarse",
                         Format("%d different values in %d samples",
                                static_cast<int>(values.size()), log_.size()),
                         RemedyOfFewValues(values, j), j});
  }

  // Values that are rounded when they are written are whole numbers of a power
  // of ten in the file's unit; those of any other step are the sensor's, and no
  // digits of the log are finer.
  std::string RemedyOfFewValues(const std::set<double>& values, int j) const {
    const double step = StepOf(values);
    if (step == 0) return "log more digits, if what measures it has them";
    const double of_unit =
        j < static_cast<int>(torque_units_.size()) ? torque_units_[j] : 1;
    if (IsPowerOfTen(step) || IsPowerOfTen(step / of_unit)) {
      return "log more digits";
    }
    return Format("all are whole numbers of %.3g ", step) +
           EffortUnit(robot_.links[j].joint.type) +
           ", the resolution of what measures it: more digits do not help; "
           "let this joint carry more, or move faster";
  }

  const Robot& robot_;
  const Log& log_;
  const StampFigures& stamps_;
  const std::vector<double>& torque_units_;
  std::vector<InspectionFinding> findings_;
};

}  // namespace

std::optional<VelocityFit> FitVelocity(const Log& log, int joint) {
  if (log.qd.size() == 0) return {};
  const VectorXd slope = SlopeOf(log, joint), qd = log.qd.col(joint);
  const double square = slope.squaredNorm();
  if (square < log.size() * kMoving * kMoving) return {};
  const double both = std::sqrt(square * qd.squaredNorm());
  return VelocityFit{slope.dot(qd) / square,
                     both > 0 ? slope.dot(qd) / both : 0};
}

void SayOfAllVelocities(const Robot& robot, const Log& log,
                        std::vector<InspectionFinding>* findings) {
  constexpr double kOneFactor = 1.03;
  std::vector<double> factors;
  for (int j = 0; j < robot.num_joints(); ++j) {
    const auto fit = FitVelocity(log, j);
    if (!fit) continue;
    if (fit->right() || fit->alike < .9) return;
    factors.push_back(fit->factor);
  }
  if (factors.size() < 2) return;
  const auto [least, most] =
      std::minmax_element(factors.begin(), factors.end());
  if (*most > kOneFactor * *least) return;
  const double factor = Median(factors);
  const bool degrees = std::abs(factor * M_PI / 180 - 1) < .05;
  const InspectionFinding finding = {
      "velocity", "the velocities are not those of the positions",
      Format("those of all joints that move are %.4g times the positions' "
             "slopes",
             factor),
      degrees
          ? "they may be in deg/s"
          : Format("the log's time may be %.4g times too %s, or they are in "
                   "another unit",
                   factor > 1 ? factor : 1 / factor,
                   factor > 1 ? "long" : "short")};
  DropFindings(
      [](const InspectionFinding& f) { return f.finding == "velocity"; },
      findings);
  findings->insert(findings->begin(), finding);
}

std::vector<InspectionFinding> AuditChannels(const Robot& robot, const Log& log,
                                             const StampFigures& stamps,
                                             const std::vector<double>& units) {
  return ChannelAudit(robot, log, stamps, units).Run();
}

}  // namespace armcal

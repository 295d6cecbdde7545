#include "model/plant/motion_reader.h"

#include <algorithm>
#include <boost/math/interpolators/quintic_hermite.hpp>
#include <memory>
#include <vector>

#include "model/input_error.h"
#include "model/log_reader.h"
#include "model/uneven_differences.h"

namespace armcal {

namespace {

using Samples = std::vector<double>;
using Spline = boost::math::interpolators::quintic_hermite<Samples>;

Log ReadAll(const std::string& path, const Robot& robot) {
  LogReaderOptions options;
  options.joint_names = robot.JointNames();
  options.need_torque = false;
  options.want_velocity = true;
  options.want_acceleration = true;
  return ReadWholeLog(path, options);
}

void CheckTimes(const std::string& path, const Log& log) {
  if (log.size() < 4) {
    throw InputError(path, "", std::to_string(log.size()) + " rows",
                     "expected at least 4 to follow");
  }
  for (int k = 1; k < log.size(); ++k) {
    if (log.t[k] > log.t[k - 1]) continue;
    throw InputError(path, "row " + std::to_string(log.first_row + k), "",
                     "its time is that of the row before; expected a motion "
                     "whose times rise");
  }
}

Samples ToSamples(const Eigen::VectorXd& v) {
  return Samples(v.data(), v.data() + v.size());
}

Spline MakeSpline(const Log& log, int joint) {
  const auto rate = [&log](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return DifferentiateUneven(log.t, x, 3);
  };
  const Eigen::VectorXd q = log.q.col(joint);
  const Eigen::VectorXd qd = log.qd.size() ? log.qd.col(joint) : rate(q);
  const Eigen::VectorXd qdd = log.qdd.size() ? log.qdd.col(joint) : rate(qd);
  return Spline(ToSamples(log.t), ToSamples(q), ToSamples(qd), ToSamples(qdd));
}

}  // namespace

ReferenceMotion MotionThrough(const std::string& path, const Log& log) {
  CheckTimes(path, log);
  const int n = static_cast<int>(log.q.cols());
  auto splines = std::make_shared<std::vector<Spline>>();
  for (int j = 0; j < n; ++j) splines->push_back(MakeSpline(log, j));
  const double end = log.t[log.size() - 1];
  const auto at = [splines, n, end](double time) {
    // Control periods seldom divide a motion: the last may pass its end.
    const double t = std::clamp(time, 0.0, end);
    ReferencePoint point{Eigen::VectorXd(n), Eigen::VectorXd(n),
                         Eigen::VectorXd(n)};
    for (int j = 0; j < n; ++j) {
      const Spline& spline = (*splines)[j];
      point.q[j] = spline(t);
      point.qd[j] = spline.prime(t);
      point.qdd[j] = spline.double_prime(t);
    }
    return point;
  };
  return {end, at};
}

ReferenceMotion ReadReferenceMotion(const std::string& path,
                                    const Robot& robot) {
  return MotionThrough(path, ReadAll(path, robot));
}

}  // namespace armcal

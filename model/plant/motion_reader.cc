#include "model/plant/motion_reader.h"

#include <algorithm>
#include <memory>

#include "model/log_files/log_reader.h"
#include "model/signals/uneven_differences.h"
#include "model/text/input_error.h"

namespace armcal {

namespace {

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

// Through positions, velocities and accelerations of all joints at once: the
// polynomial of fifth order in between two rows.
class QuinticSplines {
 public:
  explicit QuinticSplines(const Log& log)
      : t_(log.t), q_(log.q), qd_(log.qd), qdd_(log.qdd) {
    if (qd_.size() == 0) qd_ = Rate(q_);
    if (qdd_.size() == 0) qdd_ = Rate(qd_);
  }

  double duration() const { return t_[t_.size() - 1]; }
  ReferencePoint At(double t) const;

 private:
  Eigen::MatrixXd Rate(const Eigen::MatrixXd& x) const {
    Eigen::MatrixXd rate(x.rows(), x.cols());
    for (int j = 0; j < x.cols(); ++j) {
      rate.col(j) = DifferentiateUneven(t_, x.col(j), 3);
    }
    return rate;
  }
  // The row that t follows.
  long RowBefore(double t) const;

  Eigen::VectorXd t_;
  // Row by row: all joints' are asked for together.
  using Rows =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Rows q_, qd_, qdd_;
};

// Most logs have equal steps, of which the first guess is right.
long QuinticSplines::RowBefore(double t) const {
  const long last = t_.size() - 2;
  const auto guess = std::clamp(
      static_cast<long>(t / duration() * static_cast<double>(last + 1)), 0L,
      last);
  for (const long row : {guess, guess - 1, guess + 1}) {
    if (row < 0 || row > last) continue;
    if (t_[row] <= t && t < t_[row + 1]) return row;
  }
  const auto after = std::upper_bound(t_.begin(), t_.end(), t);
  return std::clamp(static_cast<long>(after - t_.begin()) - 1, 0L, last);
}

// Hermite's basis and its derivatives by s, the share of the step.
ReferencePoint QuinticSplines::At(double t) const {
  const long k = RowBefore(t);
  const double h = t_[k + 1] - t_[k], s = (t - t_[k]) / h;
  const double s2 = s * s, s3 = s2 * s, s4 = s3 * s, s5 = s4 * s;
  Eigen::Matrix<double, 6, 3> basis;  // of values, rates and second ones
  basis << 1 - 10 * s3 + 15 * s4 - 6 * s5, -30 * s2 + 60 * s3 - 30 * s4,
      -60 * s + 180 * s2 - 120 * s3,                                      //
      s - 6 * s3 + 8 * s4 - 3 * s5, 1 - 18 * s2 + 32 * s3 - 15 * s4,      //
      -36 * s + 96 * s2 - 60 * s3,                                        //
      (s2 - 3 * s3 + 3 * s4 - s5) / 2, s - 4.5 * s2 + 6 * s3 - 2.5 * s4,  //
      1 - 9 * s + 18 * s2 - 10 * s3,                                      //
      10 * s3 - 15 * s4 + 6 * s5, 30 * s2 - 60 * s3 + 30 * s4,            //
      60 * s - 180 * s2 + 120 * s3,                                       //
      -4 * s3 + 7 * s4 - 3 * s5, -12 * s2 + 28 * s3 - 15 * s4,            //
      -24 * s + 84 * s2 - 60 * s3,                                        //
      (s3 - 2 * s4 + s5) / 2, 1.5 * s2 - 4 * s3 + 2.5 * s4,               //
      3 * s - 12 * s2 + 10 * s3;
  for (const int row : {1, 4}) basis.row(row) *= h;
  for (const int row : {2, 5}) basis.row(row) *= h * h;
  basis.col(1) /= h;
  basis.col(2) /= h * h;
  const auto point = [&](int order) -> Eigen::VectorXd {
    const auto b = basis.col(order);
    return (b[0] * q_.row(k) + b[1] * qd_.row(k) + b[2] * qdd_.row(k) +
            b[3] * q_.row(k + 1) + b[4] * qd_.row(k + 1) +
            b[5] * qdd_.row(k + 1))
        .transpose();
  };
  return {point(0), point(1), point(2)};
}

}  // namespace

ReferenceMotion MotionThrough(const std::string& path, const Log& log) {
  CheckTimes(path, log);
  const auto splines = std::make_shared<const QuinticSplines>(log);
  const double end = splines->duration();
  // Control periods seldom divide a motion: the last may pass its end.
  const auto at = [splines, end](double time) {
    return splines->At(std::clamp(time, 0.0, end));
  };
  return {end, at};
}

ReferenceMotion ReadReferenceMotion(const std::string& path,
                                    const Robot& robot) {
  return MotionThrough(path, ReadAll(path, robot));
}

}  // namespace armcal

#include "calib/refine/trajectory_correction.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::trajectory_correction_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// (3.14)-(3.16): the paper's SCARA, columns X11 X21 X22 X23 X31 X41.
MatrixXd PaperRows(const VectorXd& q, const VectorXd& v, const VectorXd& a) {
  const double s = std::sin(q[1]), c = std::cos(q[1]);
  const double p = 2 * a[0] + a[1], u = 2 * v[0] * v[1] + v[1] * v[1];
  MatrixXd U(4, 6);
  U << a[0], a[1], p * c - u * s, -p * s - u * c, 0, a[3],  //
      0, a[0] + a[1], a[0] * c + v[0] * v[0] * s, v[0] * v[0] * c - a[0] * s, 0,
      a[3],                       //
      0, 0, 0, 0, a[2] - 9.8, 0,  //
      0, 0, 0, 0, 0, a[0] + a[1] + a[3];
  return U;
}

// B-spline of `degree` on the knots h k, k whole, that begins at knot `begin`;
// its derivative `order` (de Boor, from the definition).
double BSpline(int degree, int begin, int order, double h, double t) {
  const double left = begin * h;
  if (order > 0) {
    return (BSpline(degree - 1, begin, order - 1, h, t) -
            BSpline(degree - 1, begin + 1, order - 1, h, t)) /
           h;
  }
  if (degree == 0) return t >= left && t < left + h;
  return ((t - left) * BSpline(degree - 1, begin, 0, h, t) +
          (left + (degree + 1) * h - t) *
              BSpline(degree - 1, begin + 1, 0, h, t)) /
         (degree * h);
}

// 0.45 s of the paper's SCARA, and all its unknowns in dense matrices.
class Scara : public testing::Test {
 protected:
  static constexpr int kSamples = 46, kIntervals = 5;
  static constexpr int kPoints = kIntervals + 5;

  Scara() : x_(PaperScaraTruth()) {
    Robot robot = SampleRobot("SCARA RRPR");
    for (const int i : {0, 2, 3}) robot.links[i].zero_inertials = {"hx", "hy"};
    ModelParameters::Options options;
    options.geometry = GeometryKnowledge::kNonzeroLengths;
    model_.emplace_back(robot, options);
    log_ = RecordMotion(ScaraMultisine(), .45, .01);
    SetPaperScaraTorque(&log_);
    noise_.encoder.resize(4);
    noise_.torque.resize(4);
    noise_.encoder << 2e-4, 1e-4, 3e-4, 5e-4;
    noise_.torque << .5, .2, .1, .02;
    for (int order = 0; order < 3; ++order) {
      MatrixXd B(kSamples, kPoints);
      for (int k = 0; k < kSamples; ++k) {
        const double t = std::min(k * .01, .45 - 1e-12);
        for (int a = 0; a < kPoints; ++a) {
          B(k, a) = BSpline(5, a - 5, order, .09, t);
        }
      }
      B_.push_back(B);
    }
  }
  void AddSensorNoise() {
    std::mt19937_64 random(4);
    AddNoise(&random, noise_.encoder, &log_.q);
    AddNoise(&random, noise_.torque, &log_.tau);
  }
  // All predictions in units of noise: positions, then torques.
  VectorXd Predict(const MatrixXd& points, const VectorXd& x) const {
    const MatrixXd q = B_[0] * points, v = B_[1] * points, a = B_[2] * points;
    VectorXd y(8 * kSamples);
    for (int k = 0; k < kSamples; ++k) {
      y.segment(4 * k, 4) = q.row(k).transpose().array() / noise_.encoder;
      const VectorXd tau = PaperRows(q.row(k), v.row(k), a.row(k)) * x;
      y.segment(4 * (kSamples + k), 4) = tau.array() / noise_.torque;
    }
    return y;
  }
  MatrixXd Jacobian(const MatrixXd& points) const {
    MatrixXd J(8 * kSamples, 4 * kPoints + 6);
    for (int c = 0; c < 4 * kPoints; ++c) {
      MatrixXd plus = points, minus = points;
      plus(c / 4, c % 4) += 1e-5;
      minus(c / 4, c % 4) -= 1e-5;
      J.col(c) = (Predict(plus, x_) - Predict(minus, x_)) / 2e-5;
    }
    for (int c = 0; c < 6; ++c) {
      const VectorXd unit = VectorXd::Unit(6, c);
      J.col(4 * kPoints + c) = Predict(points, x_ + unit) - Predict(points, x_);
    }
    return J;
  }
  MatrixXd BestPoints() const {
    return (B_[0].transpose() * B_[0]).ldlt().solve(B_[0].transpose() * log_.q);
  }

  VectorXd x_;
  std::vector<ModelParameters> model_;
  Log log_;
  TrajectoryNoise noise_;
  std::vector<MatrixXd> B_;
};

// The information about x with all else unknown is the inverse of x's block of
// the inverse of all information.
TEST_F(Scara, InformationIsThatOfDenseAlgebra) {
  const Trajectory exact = MakeTrajectory(log_);
  TrajectoryCorrection correction(model_[0], .09);
  ASSERT_TRUE(correction.Enter(exact));
  ASSERT_TRUE(correction.Fit(x_, noise_, TorqueWeighting::kSquared, 1));
  MatrixXd information = MatrixXd::Zero(6, 6);
  VectorXd gradient = VectorXd::Zero(6);
  NoiseSums encoder(4), torque(4);
  ASSERT_TRUE(correction.Eliminate(&information, &gradient, &encoder, &torque));

  const MatrixXd J = Jacobian(BestPoints());
  const MatrixXd all = (J.transpose() * J).inverse();
  const MatrixXd expected = all.bottomRightCorner(6, 6);
  const MatrixXd covariance = information.inverse();
  EXPECT_LT((covariance - expected).norm(), 1e-4 * expected.norm());
  for (int k = 0; k < 6; ++k) {
    EXPECT_NEAR(covariance(k, k) / expected(k, k), 1, 1e-4);
  }
  // The trace of a projection is the dimension of its range.
  EXPECT_NEAR(encoder.fitted.sum() + torque.fitted.sum(), 4 * kPoints, 1e-6);
}

// Dense Gauss-Newton over splines and parameters finds the same step, and the
// same spline.
TEST_F(Scara, StepIsThatOfDenseGaussNewton) {
  AddSensorNoise();
  VectorXd y(8 * kSamples);
  for (int k = 0; k < kSamples; ++k) {
    y.segment(4 * k, 4) = log_.q.row(k).transpose().array() / noise_.encoder;
    y.segment(4 * (kSamples + k), 4) =
        log_.tau.row(k).transpose().array() / noise_.torque;
  }
  MatrixXd points = BestPoints();
  for (int step = 0; step < 5; ++step) {  // of the spline, at x
    const MatrixXd J = Jacobian(points).leftCols(4 * kPoints);
    const VectorXd change = J.householderQr().solve(y - Predict(points, x_));
    points += change.reshaped<Eigen::RowMajor>(kPoints, 4);
  }
  const VectorXd step =
      Jacobian(points).householderQr().solve(y - Predict(points, x_));

  TrajectoryCorrection correction(model_[0], .09);
  const Trajectory noisy = MakeTrajectory(log_);
  ASSERT_TRUE(correction.Enter(noisy));
  ASSERT_TRUE(correction.Fit(x_, noise_, TorqueWeighting::kSquared, 4));
  EXPECT_LT((correction.motion().q - B_[0] * points).norm(), 1e-6);
  MatrixXd information = MatrixXd::Zero(6, 6);
  VectorXd gradient = VectorXd::Zero(6);
  NoiseSums encoder(4), torque(4);
  ASSERT_TRUE(correction.Eliminate(&information, &gradient, &encoder, &torque));
  const VectorXd found = information.ldlt().solve(gradient);
  EXPECT_LT((found - step.tail(6)).norm(), 1e-3 * step.tail(6).norm());

  VectorXd scores = VectorXd::Zero(6);
  correction.ForEachScore([&](const VectorXd& score) { scores += score; });
  EXPECT_LT((scores - gradient).norm(), 1e-6 * gradient.norm());
}

TEST_F(Scara, StretchesThatAreTooShortAreLeftOut) {
  TrajectoryCorrection correction(model_[0], .09);
  Trajectory motion = MakeTrajectory(log_);
  motion.core_end = TrajectorySpline::kLeastSamples - 1;
  EXPECT_FALSE(correction.Enter(motion));
}

}  // namespace armcal::trajectory_correction_test

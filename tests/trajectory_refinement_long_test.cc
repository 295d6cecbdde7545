#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "calib/calibration_model.h"
#include "calib/trajectory_correction.h"
#include "calib/trajectory_refinement.h"
#include "tests/sample_motion.h"
#include "tests/sample_robots.h"
#include "tests/temp_file.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

double Median(VectorXd x) {
  std::sort(x.begin(), x.end());
  return x[x.size() / 2];
}
int Runs(int committed) {
  const char* runs = std::getenv("ARMCAL_RUNS");
  return runs ? std::atoi(runs) : committed;
}

struct Setting {
  std::string robot;
  GeometryKnowledge geometry;
  bool terms;
  double encoder;
  double dt;
  int runs;
};

struct Tally {
  explicit Tally(int size)
      : squares(VectorXd::Zero(size)), covered(squares), claimed(squares) {}
  void Add(const VectorXd& error, const VectorXd& stddev) {
    squares += error.cwiseAbs2();
    sum = runs ? VectorXd(sum + error) : error;
    claimed += stddev;
    for (int k = 0; k < error.size(); ++k)
      covered[k] += std::abs(error[k]) < 1.96 * stddev[k];
    ++runs;
  }
  void Print(const char* what, const VectorXd& bound) const {
    const VectorXd rmse = (squares / runs).cwiseSqrt();
    std::printf("%s: coverage mean %.1f min %.1f", what,
                100 * covered.mean() / runs, 100 * covered.minCoeff() / runs);
    {
      const VectorXd bias = sum / runs;
      std::printf("; bias/rmse median %.2f max %.2f",
                  Median(bias.cwiseAbs().cwiseQuotient(rmse)),
                  bias.cwiseAbs().cwiseQuotient(rmse).maxCoeff());
    }
    std::printf("; claimed/rmse median %.3f",
                Median((claimed / runs).cwiseQuotient(rmse)));
    if (bound.size() == rmse.size())
      std::printf("; rmse/bound median %.3f max %.3f",
                  Median(rmse.cwiseQuotient(bound)),
                  rmse.cwiseQuotient(bound).maxCoeff());
    std::printf("\n");
    std::fflush(stdout);
  }
  VectorXd squares, covered, claimed, sum;
  int runs = 0;
};

class Accuracy : public testing::TestWithParam<Setting> {};

TEST_P(Accuracy, Report) {
  const Setting& s = GetParam();
  std::mt19937_64 random(5);
  Robot robot = SampleRobot(s.robot);
  SetRandomInertials(&random, &robot);
  const int n = robot.num_joints();
  LinearCalibrationOptions options;
  options.geometry = s.geometry;
  options.joint_terms = {};
  const CoulombTransition transition{CoulombTransition::Law::kVelocity, .05};
  if (s.terms) {
    options.joint_terms = {JointTerm::kViscous, JointTerm::kCoulomb,
                           JointTerm::kOffset, JointTerm::kArmature};
    for (Link& link : robot.links) {
      link.joint.viscous = Uniform(&random, .5, 2);
      link.joint.coulomb = Uniform(&random, .5, 2);
      link.joint.armature = Uniform(&random, .1, .5);
      link.joint.offset = Uniform(&random, -.5, .5);
    }
  }
  if (s.terms && std::getenv("TRANS")) options.transition = transition;
  if (const char* bw = std::getenv("BW")) options.bandwidth_hz = std::atof(bw);
  if (const char* w = std::getenv("WIN")) options.window_s = std::atof(w);
  if (const char* l = std::getenv("SQ")) {
    (void)l;
    options.loss = Loss::kSquared;
  }
  Log exact = RecordMotion(RandomMultisine(&random, n), 10, s.dt);
  AddTorque(robot, &exact);
  if (s.terms)
    for (int j = 0; j < n; ++j) {
      AddCoulomb(j, robot.links[j].joint.coulomb, transition, &exact);
      exact.tau.col(j).array() += robot.links[j].joint.offset;
    }
  const VectorXd sigma = .01 * ColumnRms(exact.tau);
  Transitions transitions;
  if (s.terms) transitions.assign(n, {transition});
  const ModelParameters parameters =
      MakeParameters(robot, options, transitions);
  const VectorXd X = parameters.Values(robot);
  LogReaderOptions reader;
  reader.joint_names = robot.JointNames();

  VectorXd bound, length_truth;
  Tally weak(X.size()), refined(X.size());
  std::vector<Tally> lengths;
  double knots = 0, time_weak = 0, time_ml = 0, passes = 0, white = 0;
  VectorXd sq = VectorXd::Zero(n), st = VectorXd::Zero(n);
  std::vector<TrajectoryRefinement> first;
  for (int run = 0; run < Runs(s.runs); ++run) {
    Log log = exact;
    AddNoise(&random, VectorXd::Constant(n, s.encoder), &log.q);
    AddNoise(&random, sigma, &log.tau);
    LogSet set({WriteFile(LogCsv(log), s.robot + std::to_string(::getpid()))},
               reader, {});
    std::clock_t t0 = std::clock();
    const LinearCalibration linear =
        CalibrateLinear(robot, options, &set, nullptr);
    time_weak += double(std::clock() - t0) / CLOCKS_PER_SEC;
    t0 = std::clock();
    const TrajectoryRefinement ml =
        std::getenv("WEAK") && run
            ? first[0]
            : RefineTrajectories(robot, options, linear, &set, nullptr);
    if (!run) first.push_back(ml);
    time_ml += double(std::clock() - t0) / CLOCKS_PER_SEC;
    ASSERT_TRUE(ml.refined) << ml.reason;
    passes += (ml.calibration.passes - linear.passes);
    white += ml.calibration.covariance_method[0] == 'i';
    sq += ml.calibration.encoder_noise;
    st += ml.calibration.noise.cwiseQuotient(sigma);
    if (run == 0) {
      knots = ml.knot_s;
      TrajectoryCorrection truth(parameters, knots);
      TrajectoryNoise noise;
      noise.encoder.setConstant(n, s.encoder);
      noise.torque = sigma;
      const Trajectory t = MakeTrajectory(exact);
      truth.Enter(t);
      truth.Fit(X, noise, TorqueWeighting::kSquared, 1);
      MatrixXd info = MatrixXd::Zero(truth.border(), truth.border());
      VectorXd g = VectorXd::Zero(truth.border());
      NoiseSums a(n), b(n);
      truth.Eliminate(&info, &g, &a, &b);
      const VectorXd d = info.diagonal().cwiseSqrt().cwiseInverse();
      const MatrixXd inv =
          (d.asDiagonal() * info * d.asDiagonal())
              .ldlt()
              .solve(MatrixXd::Identity(info.rows(), info.rows()));
      bound = (d.asDiagonal() * inv * d.asDiagonal())
                  .diagonal()
                  .head(X.size())
                  .cwiseSqrt();
      int count = 0;
      for (const auto& l : linear.lengths) count += l.identifiable;
      lengths.assign(2, Tally(count));
    }
    weak.Add(linear.x - X, linear.stddev);
    refined.Add(ml.calibration.x - X, ml.calibration.stddev);
    for (int which = 0; which < 2; ++which) {
      VectorXd e(lengths[which].squares.size()), sd(e.size());
      int k = 0;
      for (const auto& l : (which ? ml.calibration : linear).lengths) {
        if (!l.identifiable) continue;
        e[k] = l.value - l.nominal;
        sd[k++] = l.stddev;
        if (run == 0)
          std::printf(" %s %.3g mm", l.symbol.c_str(), 1e3 * l.stddev);
      }
      lengths[which].Add(e, sd);
      if (run == 0) std::printf("\n");
    }
    if (run % 50 == 49 || run + 1 == Runs(s.runs)) {
      std::printf(
          "%s geometry %d terms %d encoder %g, knots %.0f ms, %d parameters, "
          "run %d, weak %.2f s, ml %.2f s, passes %.1f white %.2f\n",
          s.robot.c_str(), (int)s.geometry, s.terms, s.encoder, 1e3 * knots,
          (int)X.size(), run + 1, time_weak / (run + 1), time_ml / (run + 1),
          passes / (run + 1), white / (run + 1));
      weak.Print("  weak", bound);
      if (std::getenv("EACH"))
        for (int k = 0; k < X.size(); ++k)
          std::printf(
              "    %-28s X %9.4f bound %8.5f weak %.3f claimed %.3f corrected "
              "%.3f\n",
              parameters.parameters()[k].name.c_str(), X[k], bound[k],
              std::sqrt(weak.squares[k] / weak.runs) / bound[k],
              weak.claimed[k] / weak.runs / bound[k],
              std::sqrt(refined.squares[k] / weak.runs) / bound[k]);
      refined.Print("  corrected", bound);
      if (lengths[0].squares.size()) {
        lengths[0].Print("  weak lengths", {});
        lengths[1].Print("  corrected lengths", {});
        std::printf("   rmse mm:");
        for (double v : lengths[0].squares)
          std::printf(" %.3f", 1e3 * std::sqrt(v / (run + 1)));
        std::printf(" |");
        for (double v : lengths[1].squares)
          std::printf(" %.3f", 1e3 * std::sqrt(v / (run + 1)));
        std::printf("\n");
      }
      std::printf("   encoder noise / true:");
      for (double v : sq) std::printf(" %.3f", v / (run + 1) / s.encoder);
      std::printf("; torque:");
      for (double v : st) std::printf(" %.3f", v / (run + 1));
      std::printf("\n");
      std::fflush(stdout);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Robots, Accuracy,
    testing::Values(
        Setting{"SCARA RRPR", GeometryKnowledge::kNonzeroLengths, false, 1e-4,
                .004, 5},
        Setting{"SCARA RRPR", GeometryKnowledge::kKnown, true, 1e-4, .004, 5},
        Setting{"PUMA560 6R", GeometryKnowledge::kNonzeroLengths, false, 1e-4,
                .004, 5},
        Setting{"UR5 6R", GeometryKnowledge::kKnown, true, 1e-4, .004, 5},
        Setting{"Panda 7R", GeometryKnowledge::kNonzeroLengths, false, 1e-4,
                .004, 5},
        Setting{"Panda 7R", GeometryKnowledge::kKnown, true, 1e-4, .004, 5},
        Setting{"PUMA560 6R", GeometryKnowledge::kNonzeroLengths, false, 1e-5,
                .002, 5}));

}  // namespace
}  // namespace armcal

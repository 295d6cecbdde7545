// Whether 95 % intervals of physical parameters hold the truth, which is drawn
// from the prior in every run: new links, friction and motion. ARMCAL_RUNS sets
// the number of runs (default 30).

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <map>

#include "calib/linear/calibrate_linear.h"
#include "tests/fixtures/nonlinear_runs.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::physical_intervals_long_test {

constexpr double kTrust = .2;

int NumRuns() {
  const char* runs = std::getenv("ARMCAL_RUNS");
  return runs != nullptr ? std::atoi(runs) : 30;
}

// 20 s at 250 Hz, encoders of 2e-5 rad, torque noise of 1 %, friction that
// changes sign over a width that is fitted.
Log Record(const Robot& truth, std::mt19937_64* random) {
  const CoulombTransition width = {CoulombTransition::Law::kVelocity, .03};
  Log log =
      RecordMotion(RandomMultisine(random, truth.num_joints(), 1.2), 20, .004);
  AddTorque(truth, &log);
  for (int j = 0; j < truth.num_joints(); ++j) {
    AddCoulomb(j, truth.links[j].joint.coulomb, width, &log);
    log.tau.col(j).array() += truth.links[j].joint.offset;
  }
  AddNoise(random, .01 * ColumnRms(log.tau), &log.tau);
  AddNoise(random, Eigen::VectorXd::Constant(log.q.cols(), 2e-5), &log.q);
  return log;
}

struct Coverage {
  void Add(const std::string& name, double error, double stddev) {
    auto& [inside, all] = by_name[name];
    inside += std::abs(error) < 1.96 * stddev;
    ++all;
  }
  // Of parameters that at least half of the runs tell.
  void Expect(const char* what, int runs) const {
    double mean = 0, least = 1;
    int count = 0;
    for (const auto& [name, c] : by_name) {
      if (2 * c.second < runs) continue;
      const double share = double(c.first) / c.second;
      mean += share;
      least = std::min(least, share);
      ++count;
    }
    mean /= count;
    std::printf("%s: %d parameters, %.2f %% of the truths inside, least %.1f\n",
                what, count, 100 * mean, 100 * least);
    // A share of .95 in few runs scatters, parameters not independently.
    const double slack = runs >= 200 ? 0 : 3 * std::sqrt(.05 * .95 / runs);
    EXPECT_GT(mean, .93 - .4 * slack) << what;
    EXPECT_LT(mean, .97 + .4 * slack) << what;
    EXPECT_GE(least, .88 - slack) << what;
  }
  std::map<std::string, std::pair<int, int>> by_name;
};

class PhysicalIntervals : public testing::TestWithParam<const char*> {};

TEST_P(PhysicalIntervals, HoldTheTruth) {
  Coverage model, identifiable, all;
  for (int run = 0; run < NumRuns(); ++run) {
    std::mt19937_64 random(20000 + run);
    const SimulatedArm arm = MakeArm(GetParam(), kTrust, &random);
    LogReaderOptions reader;
    reader.joint_names = arm.file.JointNames();
    LogSet log({WriteFile(LogCsv(Record(arm.truth, &random)))}, reader, {});
    NonlinearCalibrationOptions options;
    options.trust.inertia = kTrust;
    const auto linear = CalibrateLinear(arm.file, {}, log, nullptr);
    const auto result =
        CalibrateNonlinear(arm.file, linear, options, log, nullptr);
    ASSERT_TRUE(result.converged()) << result.reason;
    const Eigen::VectorXd x = linear.parameters.Values(arm.truth);
    for (int k = 0; k < x.size(); ++k) {
      if (!linear.identifiable[k]) continue;
      model.Add(linear.parameters.parameters()[k].name, linear.x[k] - x[k],
                linear.stddev[k]);
    }
    for (size_t k = 0; k < result.parameters.size(); ++k) {
      const PhysicalParameter& p = result.parameters[k];
      if (p.held) continue;
      const double error = p.value - ValueIn(arm.truth, p.name);
      all.Add(p.name, error, std::sqrt(result.covariance(k, k)));
      if (p.identifiable) identifiable.Add(p.name, error, p.stddev);
    }
  }
  model.Expect("model parameters", NumRuns());
  identifiable.Expect("physical parameters that the logs tell", NumRuns());
  all.Expect("all physical parameters, the prior included", NumRuns());
}

INSTANTIATE_TEST_SUITE_P(, PhysicalIntervals,
                         testing::Values("SCARA RRPR", "PUMA560 6R",
                                         "Panda 7R"));

}  // namespace armcal::physical_intervals_long_test

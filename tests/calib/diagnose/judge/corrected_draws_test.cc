#include "calib/diagnose/judge/corrected_draws.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "calib/diagnose/data/motion_scale.h"
#include "calib/diagnose/data/segments.h"
#include "calib/diagnose/select/missing_terms.h"
#include "model/dynamics/inverse_dynamics.h"
#include "model/effects/effects.h"
#include "model/robot_files/robot_reader.h"
#include "model/text/format.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::corrected_draws_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kRobots = 64;
constexpr int kEvery = 20;  // samples

// Torques of a robot in a motion, joint by joint, as whoever simulates it has
// them: links and motors, and laws without states of their own.
MatrixXd Torques(const SimulatedRobot& plant, const Motion& motion) {
  const int n = plant.robot.num_joints();
  MatrixXd torques(motion.size() / kEvery, n);
  for (Eigen::Index k = 0; k < torques.rows(); ++k) {
    const Eigen::Index at = kEvery * k;
    ArmInstant instant;
    instant.position = instant.link_position = motion.q.row(at);
    instant.velocity = instant.link_velocity = motion.qd.row(at);
    instant.load = InverseDynamics(plant.robot, motion.q.row(at),
                                   motion.qd.row(at), motion.qdd.row(at));
    instant.temperature = VectorXd::Zero(n);
    torques.row(k) = instant.load;
    for (int j = 0; j < n; ++j) {
      torques(k, j) += plant.robot.links[j].joint.armature * motion.qdd(at, j);
    }
    for (const JointLaw& law : plant.joint_laws) {
      if (law.initial_state.size() > 0) continue;
      torques(k, law.joint) -= law.torque(instant, nullptr, nullptr);
    }
  }
  return torques;
}

struct Spread {
  VectorXd drawn, predicted;  // per joint, mean squares, N m
  VectorXd off;               // of the mean, per joint, mean squares
  double Whole() const {
    return std::sqrt(drawn.cwiseQuotient(predicted).mean());
  }
};

// What is drawn, and what the covariance makes of the torque's slopes.
Spread SpreadOf(const GapFit& fit, const CorrectedPosterior& posterior,
                const CorrectedDraws& draws, const Motion& motion) {
  const auto at = [&](const VectorXd& values) {
    return Torques(MakeCorrectedRobot(fit.baseline(), posterior.ModelAt(values),
                                      posterior.EffectsAt(values), fit.scale())
                       .plant,
                   motion);
  };
  const MatrixXd mean = at(posterior.mean);
  MatrixXd Y(mean.size(), posterior.mean.size());
  for (Eigen::Index k = 0; k < Y.cols(); ++k) {
    const double step = .1 * std::sqrt(posterior.covariance(k, k));
    VectorXd values = posterior.mean;
    values[k] += step;
    Y.col(k) = (at(values) - mean).reshaped() / step;
  }
  const VectorXd variance =
      (Y * posterior.covariance).cwiseProduct(Y).rowwise().sum();
  MatrixXd squares = MatrixXd::Zero(mean.rows(), mean.cols());
  MatrixXd sum = MatrixXd::Zero(mean.rows(), mean.cols());
  for (const CorrectedRobot& robot : draws.robots) {
    const MatrixXd differs = Torques(robot.plant, motion) - mean;
    squares += differs.cwiseAbs2() / kRobots;
    sum += differs / kRobots;
  }
  Spread spread;
  spread.predicted =
      variance.reshaped(mean.rows(), mean.cols()).colwise().mean();
  spread.drawn = squares.colwise().mean();
  spread.off = sum.cwiseAbs2().colwise().mean();
  return spread;
}

// With --gtest_output=json:FILE: over the arm, and of the joint of least, of
// most, and how many deviations the mean is off where that is most.
void Record(const Spread& spread) {
  const VectorXd ratio = spread.drawn.cwiseQuotient(spread.predicted);
  const auto record = [](const char* key, double value) {
    testing::Test::RecordProperty(key, Format("%.4g", value));
  };
  record("spread", spread.Whole());
  record("least", std::sqrt(ratio.minCoeff()));
  record("most", std::sqrt(ratio.maxCoeff()));
  record("off",
         std::sqrt(spread.off.cwiseQuotient(spread.predicted).maxCoeff()));
}

void ExpectPossible(const CorrectedDraws& draws) {
  ASSERT_EQ(draws.refusal, "");
  ASSERT_EQ(draws.robots.size(), static_cast<size_t>(kRobots));
  for (const CorrectedRobot& robot : draws.robots) {
    for (const Link& link : robot.plant.robot.links) {
      const auto P = PseudoInertia(link.inertial.ToVector());
      EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(P)
                    .eigenvalues()
                    .minCoeff(),
                0);
      EXPECT_GE(link.joint.viscous, 0);
      EXPECT_GE(link.joint.coulomb, 0);
      EXPECT_GE(link.joint.armature, 0);
    }
  }
}

// A simulated arm, whose friction falls with speed on one joint and whose links
// are 2 % heavier than the file's; torques with noise of 2 %.
struct Simulated {
  Simulated()
      : arm("3R elbow", 40, .005), baseline(arm.robot, {}, arm.scale.torque) {
    RecordedTorque recorded(arm.robot, baseline.transitions(), arm.motion);
    for (int j = 0; j < 3; ++j) {
      arm.scale.width[j] = baseline.transitions()[j].width;
    }
    SimulatedRobot heavier;
    heavier.robot = arm.robot;
    for (Link& link : heavier.robot.links) {
      link.inertial =
          InertialParameters::FromVector(1.02 * link.inertial.ToVector());
    }
    truth = recorded.nominal() + recorded.Change(heavier) +
            arm.Change(*FindEffect("stribeck"), 1,
                       Eigen::Vector2d(stribeck, .3 * arm.scale.speed[1]),
                       &recorded);
    MatrixXd tau = truth;
    std::mt19937_64 random(2);
    AddNoise(&random, .02 * arm.scale.torque, &tau);
    GapFitOptions options;
    options.bandwidth_hz = 6;
    for (const Effect& effect : Effects()) {
      if (effect.name != "stribeck") options.without.push_back(effect.name);
    }
    fit = std::make_unique<GapFit>(
        baseline, options,
        std::vector<GapSegment>{MakeSegment(arm.motion, tau)},
        std::vector<GapSegment>());
    fit->Choose();
    posterior = PosteriorOf(*fit);
    draws = DrawCorrected(*fit, posterior, arm.robot, kRobots);
  }

  EffectArm arm;
  GapBaseline baseline;
  const double stribeck = .3 * arm.scale.torque[1];
  MatrixXd truth;  // torque without noise
  std::unique_ptr<GapFit> fit;
  CorrectedPosterior posterior;
  CorrectedDraws draws;
};

const Simulated& Arm() {
  static const Simulated arm;
  return arm;
}

TEST(CorrectedDrawsTest, SpreadAsThePosteriorSays) {
  ASSERT_EQ(Arm().posterior.parameters.size(), 2u);
  ExpectPossible(Arm().draws);
  const Spread spread =
      SpreadOf(*Arm().fit, Arm().posterior, Arm().draws, Arm().arm.motion);
  EXPECT_NEAR(spread.Whole(), 1, .1);
  for (int j = 0; j < 3; ++j) {
    EXPECT_NEAR(std::sqrt(spread.drawn[j] / spread.predicted[j]), 1, .3) << j;
  }
  Record(spread);
}

// Effects are drawn with the model: the log tells friction, all of it, and
// where it is of the law that falls with speed there is less of the others, so
// that the sum is known better than if they did not know of each other.
TEST(CorrectedDrawsTest, EffectsAreDrawnWithTheModel) {
  ASSERT_EQ(Arm().draws.refusal, "");
  const double v = .1 * Arm().arm.scale.speed[1];
  VectorXd law(kRobots), others(kRobots);
  for (int r = 0; r < kRobots; ++r) {
    const CorrectedRobot& robot = Arm().draws.robots[r];
    const VectorXd& p = robot.effects.at(0).found.p;
    law[r] = p[0] * std::exp(-v * v / (p[1] * p[1]));
    others[r] = v * robot.plant.robot.links[1].joint.viscous;
    for (const CoulombPart& part : robot.coulomb[1]) {
      others[r] += part.force * std::tanh(v / part.transition.width);
    }
  }
  const auto variance = [](const VectorXd& x) {
    return (x.array() - x.mean()).square().mean();
  };
  EXPECT_LT(
      std::abs(law.mean() - Arm().stribeck * std::exp(-std::pow(.1 / .3, 2))),
      4 * std::sqrt(variance(law)));
  EXPECT_GT(variance(law), 0);
  EXPECT_LT(variance(law + others), .5 * (variance(law) + variance(others)));
}

// The fitted torque is off the noiseless truth by what the robots spread: by no
// more than twice as much, and no less than a tenth.
TEST(CorrectedDrawsTest, TheTruthIsAsFarAsTheySpread) {
  ASSERT_EQ(Arm().draws.refusal, "");
  const CorrectedPosterior& posterior = Arm().posterior;
  const MatrixXd off =
      Arm().truth(Eigen::seqN(0, Arm().truth.rows() / kEvery, kEvery),
                  Eigen::all) -
      Torques(MakeCorrectedRobot(Arm().fit->baseline(), posterior.model,
                                 posterior.effects, Arm().fit->scale())
                  .plant,
              Arm().arm.motion);
  const Spread spread =
      SpreadOf(*Arm().fit, posterior, Arm().draws, Arm().arm.motion);
  for (int j = 0; j < 3; ++j) {
    const double says = spread.drawn[j];
    EXPECT_LT(off.col(j).cwiseAbs2().mean(), 4 * says) << j;
    EXPECT_GT(off.col(j).cwiseAbs2().mean(), .01 * says) << j;
  }
}

int Place(const GapFit& fit, const std::string& name) {
  const std::vector<GapCandidate>& effects = fit.refined().effects;
  for (size_t k = 0; k < effects.size(); ++k) {
    if (effects[k].effect->name == name) return static_cast<int>(k);
  }
  ADD_FAILURE() << "no " << name;
  return 0;
}

// A real arm by one log, at the motion of another, which nothing was fitted to.
TEST(CorrectedDrawsOfUr10e, SpreadAsThePosteriorSays) {
  const std::string folder = SHARED_DIR "/data/ur10e_free/";
  if (!std::filesystem::exists(folder)) {
    GTEST_SKIP() << "no " << folder;
  }
  constexpr double kBandwidth = 10;
  const Robot file = ReadRobot(folder + "robot.urdf", {});
  LogReaderOptions reader;
  reader.joint_names = file.JointNames();
  reader.torque_constants = {14.87, 13.26, 11.13, 10.62, 11.03, 11.47};
  reader.torque_constants_stddev.reset();
  const auto read = [&](const std::string& name) {
    const LogSet logs(LogFiles({folder + name}), reader, {});
    return ReadSegments(kBandwidth, {}, logs);
  };
  const std::vector<GapSegment> segments = read("id_30s.csv");
  BaselineOptions options;
  const MissingTerms missing =
      FitMissingTerms(file, options, kBandwidth, segments);
  for (const MissingTerm& term : missing.terms) {
    options.missing_terms[term.joint_term] = term.usual;
  }
  GapBaseline baseline(missing.robot, options, UsualTorque(segments));
  {
    const GapRows rows(segments, kBandwidth);
    baseline.AddDiscrepancy(Discrepancy(
        file, ScaleOf(baseline, rows, RecordedTorques(baseline, rows)), 1,
        .05));
  }
  GapFitOptions fit_options;
  fit_options.bandwidth_hz = kBandwidth;
  GapFit fit(baseline, fit_options, segments, {});
  fit.Choose();
  fit.KeepOnly({Place(fit, "delay")});  // what is claimed of it
  const CorrectedPosterior posterior = PosteriorOf(fit);
  const CorrectedDraws draws = DrawCorrected(fit, posterior, file, kRobots);
  ExpectPossible(draws);
  const Spread spread =
      SpreadOf(fit, posterior, draws, read("val_ptp.csv")[0].motion);
  Record(spread);
  EXPECT_NEAR(spread.Whole(), 1, .1);
}

}  // namespace armcal::corrected_draws_test

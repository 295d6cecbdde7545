#include "calib/diagnose/contacts/pulses.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <optional>
#include <random>

namespace armcal::pulses_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStep = .004, kBandwidth = 10;
constexpr int kSize = 5000;  // samples: 20 s

// Two joints that move all the time; what is left of the torque is given
// sample by sample. Their noise is an autoregression; a fit had one column,
// whose value is uncertain.
class Pulses : public testing::Test {
 protected:
  Pulses() {
    GapSegment segment;
    Motion& motion = segment.motion;
    motion.dt = kStep;
    motion.q.setZero(kSize, 2);
    motion.qd.setOnes(kSize, 2);
    segment.tau.setZero(kSize, 2);
    segment.still = motion.qd.array() == 0;
    segments_ = {segment};
    rows_.emplace(segments_, kBandwidth);
    for (Autoregression& joint : noise_) {
      joint.a << .5, .2, 0, 0;
      joint.sigma = .3;
    }
    rows_->SetNoise(noise_, MatrixXd::Zero(size(), 2));
    VectorXd course(size());
    for (int k = 0; k < size(); ++k) course[k] = std::sin(time(k));
    extra_stddev_ = MatrixXd::Zero(size(), 2);
    columns_ = {{{0}, course}, {{1}, course}};
  }
  int size() const { return rows_->num_thin(); }
  double time(int k) const { return rows_->thin_time(0, k); }
  int SampleAt(double t) const {
    int k = 0;
    while (time(k) < t) ++k;
    return k;
  }
  // Noise, and the columns at values of the given standard deviation.
  MatrixXd Draw(double stddev) {
    std::normal_distribution<double> normal;
    MatrixXd residual(size(), 2);
    for (int j = 0; j < 2; ++j) {
      VectorXd x = VectorXd::Zero(size() + 100);
      for (int k = 4; k < x.size(); ++k) {
        x[k] = .3 * normal(random_);
        for (int i = 0; i < 4; ++i) x[k] += noise_[j].a[i] * x[k - 1 - i];
      }
      residual.col(j) =
          x.tail(size()) + stddev * normal(random_) * columns_[j].values.col(0);
    }
    return residual;
  }
  void Push(int joint, double torque, double at, double width,
            MatrixXd* residual) const {
    for (int k = 0; k < size(); ++k) {
      (*residual)(k, joint) -=
          torque * std::exp(-std::pow((time(k) - at) / width, 2));
    }
  }
  PulseScan Scan(const MatrixXd& residual, double stddev) const {
    return PulseScan(
        *rows_, {columns_, stddev * stddev * MatrixXd::Identity(2, 2), noise_},
        residual, extra_stddev_);
  }
  PulseResponses Short(const MatrixXd& residual, double stddev) const {
    return Scan(residual, stddev).Responses(PulseScan::Banks().front());
  }

  std::vector<GapSegment> segments_;
  std::optional<GapRows> rows_;
  std::vector<Autoregression> noise_ = std::vector<Autoregression>(2);
  std::vector<BaselineColumns> columns_;
  MatrixXd extra_stddev_;
  std::mt19937_64 random_{1};
};

// Thinned samples within .75 s of a time.
std::vector<int> WindowAbout(const GapRows& rows, double t) {
  std::vector<int> window;
  for (int k = 0; k < rows.num_thin(); ++k) {
    if (std::abs(rows.thin_time(0, k) - t) <= .75) window.push_back(k);
  }
  return window;
}

// Of what the model says itself, whatever the value of the fit's column.
TEST_F(Pulses, DeviationsAreThoseOfNoiseAndFit) {
  constexpr int kDraws = 400;
  for (const double stddev : {0., 3.}) {
    double squares = 0;
    for (int draw = 0; draw < kDraws; ++draw) {
      const PulseScan scan = Scan(Draw(stddev), stddev);
      squares += std::pow(scan.At(0, SampleAt(7.8), .3).deviations, 2);
    }
    // chi^2 of 400 degrees over 400: 1 +- .071.
    EXPECT_NEAR(squares / kDraws, 1, 4 * .071) << stddev;
  }
}

TEST_F(Pulses, TellsAPushOnOneJoint) {
  MatrixXd residual = Draw(.2);
  Push(1, -2.5, 11, .3, &residual);
  const PulseScan scan = Scan(residual, .2);
  const PulseResponses responses = Short(residual, .2);
  int sample, joint;
  responses.deviations.cwiseAbs().maxCoeff(&sample, &joint);
  EXPECT_EQ(joint, 1);
  EXPECT_NEAR(time(sample), 11, .15);
  EXPECT_LT(responses.deviations(sample, joint), -5);
  const Pulse pulse = scan.At(1, SampleAt(11), .3);
  EXPECT_NEAR(pulse.torque, -2.5, 4 * pulse.stddev);
  EXPECT_LT(pulse.stddev, .5);
  EXPECT_LT(std::abs(scan.At(0, SampleAt(11), .3).deviations), 4);
}

// Of a width that no scan looks for.
TEST_F(Pulses, AreFittedInTimeAndWidth) {
  MatrixXd residual = Draw(.2);
  Push(1, -4, 11, .7, &residual);
  const PulseScan scan = Scan(residual, .2);
  const Pulse pulse = scan.Fitted(1, WindowAbout(*rows_, 11), 1.5);
  EXPECT_NEAR(time(pulse.sample), 11, .15);
  EXPECT_NEAR(pulse.width, .7, .15);
  EXPECT_NEAR(pulse.torque, -4, 4 * std::sqrt(1.5) * pulse.stddev);
  EXPECT_LT(pulse.stddev, .4);
}

// A pulse that looks like what the fit may have wrong is not told from it.
TEST_F(Pulses, ThatAnErrorOfTheFitExplainsDoNotStandOut) {
  MatrixXd residual = Draw(0);
  Push(0, 2.5, M_PI / 2, .6, &residual);
  const int sample = SampleAt(M_PI / 2);
  EXPECT_GT(Scan(residual, 0).At(0, sample, .6).deviations, 5);
  EXPECT_LT(Scan(residual, 10).At(0, sample, .6).deviations, 1);
}

// What is masked has no pulse, whatever the samples beside the mask have.
TEST_F(Pulses, AreNotToldFromTheirTails) {
  MatrixXd residual = Draw(0);
  Push(0, 30, 11, .6, &residual);
  const int sample = SampleAt(11);
  const double width = PulseScan::Banks()[0][0];
  EXPECT_GT(std::abs(Short(residual, 0).deviations(sample, 0)), 30);
  for (int k = 0; k < size(); ++k) {
    if (std::abs(time(k) - 11) <= 2.5 * width) {
      extra_stddev_(k, 0) = 1e6 * noise_[0].stddev();
    }
  }
  EXPECT_EQ(Short(residual, 0).deviations(sample, 0), 0);
}

// An extra variance lets a pulse stand out less, as far as its samples have it.
// With a thousand times the deviation they say as little as that, and with one
// without bound they are not seen.
TEST_F(Pulses, StandOutLessWhereSamplesHaveExtraVariance) {
  MatrixXd residual = Draw(0);
  Push(0, 4, 11, .3, &residual);
  const double clear = Scan(residual, 0).At(0, SampleAt(11), .3).deviations;
  extra_stddev_.col(0)
      .segment(SampleAt(10), 50)
      .setConstant(noise_[0].stddev() / 3);
  const double with_extra =
      Scan(residual, 0).At(0, SampleAt(11), .3).deviations;
  EXPECT_GT(clear, 5);
  EXPECT_NEAR(with_extra, clear / std::sqrt(1 + 1. / 9), .15 * clear);
  EXPECT_LT(with_extra, clear);
  extra_stddev_.col(0).setConstant(1e3 * noise_[0].stddev());
  EXPECT_LT(std::abs(Scan(residual, 0).At(0, SampleAt(11), .3).deviations),
            .05);
  extra_stddev_.col(0).setConstant(std::numeric_limits<double>::infinity());
  const PulseScan scan = Scan(residual, 0);
  const Pulse pulse = scan.At(0, SampleAt(11), .3);
  EXPECT_EQ(pulse.torque, 0);
  EXPECT_TRUE(std::isinf(pulse.stddev));
  const PulseResponses responses = Short(residual, 0);
  EXPECT_EQ(responses.deviations.col(0).norm(), 0);
  EXPECT_GT(responses.deviations.col(1).norm(), 0);
}

// One of noise that the log has by itself, wherever it is looked for: no more
// than 5 % of logs have one less probable than that. A push has, and another
// one does not hide it.
TEST_F(Pulses, AreAskedOfTheLogsOwnPeaks) {
  constexpr int kDraws = 200;
  int improbable = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const MatrixXd residual = Draw(0);
    const PulseResponses responses = Short(residual, 0);
    int sample;
    responses.Largest().maxCoeff(&sample);
    const auto window = WindowAbout(*rows_, time(sample));
    improbable +=
        PulsesBeside(*rows_, responses, {window}).chances.minCoeff() < .05;
  }
  // 10 of 200 at most, and 3 deviations of that.
  EXPECT_LE(improbable, 10 + 9);
  MatrixXd residual = Draw(0);
  Push(1, 4, 5, .3, &residual);
  Push(1, -4, 14, .3, &residual);
  const OwnPulses own =
      PulsesBeside(*rows_, Short(residual, 0),
                   {WindowAbout(*rows_, 5), WindowAbout(*rows_, 14),
                    WindowAbout(*rows_, 9)});
  EXPECT_LT(own.chances(0, 1), 1e-3);
  EXPECT_LT(own.chances(1, 1), 1e-3);
  EXPECT_GT(own.chances.col(0).minCoeff(), .05);
  EXPECT_GT(own.chances(2, 1), .05);
}

// In white noise a matched filter that is r times too short or too long sees
// sqrt(2 r / (1 + r^2)) of a pulse: .89 of one of .6 s is left to the nearest
// of the short bank, and .69 of one of .15 s to the long one.
TEST_F(Pulses, EachBankSeesPushesOfItsOwnLength) {
  for (Autoregression& white : noise_) white.a.setZero();
  const auto standing_out = [&](double width, size_t bank) {
    MatrixXd residual = MatrixXd::Zero(size(), 2);
    Push(1, -3, 11, width, &residual);
    return Scan(residual, 0)
        .Responses(PulseScan::Banks()[bank])
        .Largest()
        .maxCoeff();
  };
  EXPECT_NEAR(standing_out(.6, 0) / standing_out(.6, 1), .894, .03);
  EXPECT_NEAR(standing_out(.15, 1) / standing_out(.15, 0), .686, .05);
}

// The largest of a log that is as the reference is: 5 % of them are as
// improbable as that, or fewer. Where a joint has large ones that is usual.
TEST_F(Pulses, AReferenceTellsHowLargeTheyAreWithoutAContact) {
  constexpr int kDraws = 200;
  int improbable = 0;
  const auto chance = [](const std::vector<UsualMaximum>& usual,
                         const PulseResponses& responses) {
    double least = 1;
    for (size_t j = 0; j < usual.size(); ++j) {
      const double largest = responses.deviations.col(j).cwiseAbs2().maxCoeff();
      least = std::min(least, usual[j].Chance(largest));
    }
    return least;
  };
  for (int draw = 0; draw < kDraws; ++draw) {
    const PulseResponses log = Short(Draw(0), 0), reference = Short(Draw(0), 0);
    improbable += chance(UsualPeaks(*rows_, log, *rows_, reference), log) < .05;
  }
  // 10 of 200, and 3 deviations of that.
  EXPECT_LE(improbable, 10 + 9);
  MatrixXd before = Draw(0), after = Draw(0);
  before.col(0) *= 6;
  const PulseResponses log = Short(after, 0);
  EXPECT_LT(UsualPeaks(*rows_, log, *rows_, log)[0].Chance(100), .05);
  EXPECT_GT(UsualPeaks(*rows_, log, *rows_, Short(before, 0))[0].Chance(100),
            .05);
}

// Errors of three times what the model says of itself; not less than it says.
TEST_F(Pulses, OwnPeaksTellHowWellTheModelKnowsItsErrors) {
  const MatrixXd residual = Draw(0);
  const auto scale = [&](double times) {
    MatrixXd other = residual;
    other.col(0) *= times;
    return PulsesBeside(*rows_, Short(other, 0), {}).scale;
  };
  // Rayleigh's law holds for a narrow band; that of a pulse is not.
  EXPECT_NEAR(scale(3)[0] / scale(1)[0], 3, .75);
  EXPECT_EQ(scale(.2)[0], 1);
  EXPECT_EQ(scale(3)[1], scale(1)[1]);
}

}  // namespace armcal::pulses_test

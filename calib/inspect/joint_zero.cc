#include "calib/inspect/joint_zero.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <string>

#include "calib/numerics/autoregression.h"
#include "model/dynamics/inverse_dynamics.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTurnsOver = .03;   // rad/s or m/s
constexpr double kMovingOfRms = .2;  // of a joint's rms speed, as TorqueFit
constexpr int kLeastRows = 40;       // of a joint, of some hundred
// Nats that the other hypotheses of an arm, some fifty, have to be beaten by:
// e^-15 is one in 60000 logs, were the noise all there is.
constexpr double kLeastNats = 15;
// Of squares of the joint's own torque: what is told explains more than it
// leaves, as of all readings (held_out_fit.h).
constexpr double kMostOfSquares = .5;
// Times what the file's links need, as which a torque is still told to be these
// links': a reversed elbow of a ViperX-300 has .6 to 1.1 under what would mend
// it; the links of ../shared/data/dvrk_psm, whose counterweight its file lacks,
// .18 to .25 under what fits them better than the file.
constexpr double kMostMultiple = 2;
// Of the torque's squares, in which no model is better (held_out_fit.h).
constexpr double kBestModel = 1e-4;

// How joint `joint` of the arm is, beside the file's: q = sign q_file + zero.
struct Hypothesis {
  int joint = 0;
  double sign = 1;
  int quarters = 0;  // of a turn
};

MatrixXd NeededTorques(const Robot& robot, const Motion& motion,
                       const Hypothesis& h) {
  Motion turned = motion;
  turned.q.col(h.joint) =
      (h.sign * motion.q.col(h.joint)).array() + h.quarters * M_PI / 2;
  turned.qd.col(h.joint) *= h.sign;
  turned.qdd.col(h.joint) *= h.sign;
  MatrixXd needed(motion.size(), robot.num_joints());
  for (int s = 0; s < motion.size(); ++s) {
    needed.row(s) = InverseDynamics(robot, turned.q.row(s), turned.qd.row(s),
                                    turned.qdd.row(s));
  }
  needed.col(h.joint) *= h.sign;
  return needed;
}

// One joint's torque where it moves, freed of what it holds beside the links':
// friction, an offset and armature.
class FreedTorque {
 public:
  FreedTorque(const WiringSamples& samples, int j) {
    const VectorXd qd = samples.motion.qd.col(j);
    const double least = kMovingOfRms * qd.norm() / std::sqrt(qd.size());
    for (Eigen::Index k = 0; k < qd.size(); ++k) {
      if (std::abs(qd[k]) > least) rows_.push_back(static_cast<int>(k));
    }
    if (!asked()) return;
    MatrixXd terms(qd.size(), 4);
    terms << qd, (qd.array() / kTurnsOver).tanh().matrix(),
        VectorXd::Ones(qd.size()), samples.motion.qdd.col(j);
    terms_.compute(terms(rows_, Eigen::all));
    const VectorXd tau = samples.tau.col(j);
    least_ = kBestModel * tau(rows_).squaredNorm();
    recorded_ = Freed(tau);
  }
  bool asked() const { return rows_.size() >= kLeastRows; }
  double least() const { return least_; }

  // What is left beside a multiple of `needed`, which is not negative: links
  // that weigh less than nothing are none.
  VectorXd Left(const VectorXd& needed, double* multiple = nullptr) const {
    const VectorXd x = Freed(needed);
    const double square = x.squaredNorm();
    const double slope =
        square > 0 ? std::max(0., x.dot(recorded_) / square) : 0;
    if (multiple != nullptr) *multiple = slope;
    return recorded_ - slope * x;
  }

 private:
  VectorXd Freed(const VectorXd& all) const {
    const VectorXd x = all(rows_);
    MatrixXd columns = MatrixXd::Zero(x.size(), 1);
    columns.col(0) = x;
    columns.applyOnTheLeft(terms_.householderQ().transpose());
    columns.topRows(terms_.rank()).setZero();
    columns.applyOnTheLeft(terms_.householderQ());
    return columns.col(0);
  }

  std::vector<int> rows_;
  Eigen::ColPivHouseholderQR<MatrixXd> terms_;
  VectorXd recorded_;
  double least_ = 0;
};

class ZeroComparison {
 public:
  ZeroComparison(const Robot& robot, const WiringSamples& samples)
      : robot_(robot), samples_(samples) {
    const MatrixXd needed = NeededTorques(robot, samples.motion, {});
    for (int j = 0; j < robot.num_joints(); ++j) {
      torques_.emplace_back(samples, j);
      as_is_.push_back(torques_[j].asked() ? torques_[j].Left(needed.col(j))
                                           : VectorXd());
    }
  }

  struct Result {
    double gain = 0;  // nats, of all joints
    double own = 1;   // squares left of the joint's torque over those as it is
    double multiple = 1;  // of what the file's links need of it
  };
  Result Of(const Hypothesis& h) const {
    const MatrixXd needed = NeededTorques(robot_, samples_.motion, h);
    Result result;
    for (int j = 0; j < robot_.num_joints(); ++j) {
      if (!torques_[j].asked()) continue;
      double multiple = 0;
      const VectorXd left = torques_[j].Left(needed.col(j), &multiple);
      const double ratio = (left.squaredNorm() + torques_[j].least()) /
                           (as_is_[j].squaredNorm() + torques_[j].least());
      // What a wrong hypothesis leaves is as slow as the motion; noise is what
      // the better one leaves.
      const double m = IndependentSamples(ratio < 1 ? left : as_is_[j]);
      result.gain -= .5 * m * std::log(ratio);
      if (j != h.joint) continue;
      result.own = ratio;
      result.multiple = multiple;
    }
    return result;
  }

 private:
  const Robot& robot_;
  const WiringSamples& samples_;
  std::vector<FreedTorque> torques_;
  std::vector<VectorXd> as_is_;
};

// A hypothesis that is clearly better than the file as it is.
struct Better {
  Hypothesis hypothesis;
  ZeroComparison::Result result;
};

bool IsBelievable(const ZeroComparison::Result& result) {
  return result.gain > kLeastNats && result.own < kMostOfSquares &&
         result.multiple < kMostMultiple && result.multiple * kMostMultiple > 1;
}

// The best first.
std::vector<Better> FindBetter(const Robot& robot,
                               const WiringSamples& samples) {
  const ZeroComparison comparison(robot, samples);
  std::vector<Better> all;
  for (int j = 0; j < robot.num_joints(); ++j) {
    const bool turns = IsRotational(robot.links[j].joint.type);
    for (const double sign : {1., -1.}) {
      for (int quarters = turns ? -1 : 0; quarters <= (turns ? 2 : 0);
           ++quarters) {
        const Hypothesis h{j, sign, quarters};
        const ZeroComparison::Result result = comparison.Of(h);
        if (IsBelievable(result)) all.push_back({h, result});
      }
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Better& a, const Better& b) {
                     return a.result.gain > b.result.gain;
                   });
  return all;
}

std::string Phrase(const Hypothesis& h) {
  std::string text;
  if (h.sign < 0) text = "turns the other way";
  if (h.quarters != 0) {
    text += text.empty() ? "" : " and ";
    text += Format("has its zero %d degrees away", 90 * h.quarters);
  }
  return text;
}

}  // namespace

std::vector<InspectionFinding> DoubtJointZeros(const Robot& robot,
                                               const WiringSamples& samples) {
  constexpr size_t kTold = 3;
  const std::vector<Better> all = FindBetter(robot, samples);
  if (all.empty()) return {};
  std::string sentence = "the robot file may be wrong in a joint: ";
  for (size_t k = 0; k < std::min(kTold, all.size()); ++k) {
    const Hypothesis& h = all[k].hypothesis;
    sentence += (k > 0 ? ", or " : "") + robot.links[h.joint].joint.name + " " +
                Phrase(h);
  }
  const ZeroComparison::Result& best = all[0].result;
  return {{"joint_zero", sentence,
           Format("the file's own links, beside friction and an offset, leave "
                  "%.3g times as much of its torque so (%.0f nats in all "
                  "torques)",
                  std::sqrt(best.own), best.gain),
           "compare the file's axis, origin and zero of the joint, and the "
           "centres of mass beyond it, with the arm",
           all[0].hypothesis.joint}};
}

}  // namespace armcal

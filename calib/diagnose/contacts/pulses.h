#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/data/baseline_columns.h"
#include "calib/diagnose/data/rows.h"
#include "calib/numerics/maxima.h"

namespace armcal {

// A torque on one joint that comes and goes,
//   A exp(-((t - time) / width)^2).
struct Pulse {
  int sample = 0;     // thinned, of its time
  double width = 0;   // s
  double torque = 0;  // A, as the environment acts on the joint, N m or N
  double stddev = 0;
  double deviations = 0;  // torque / stddev
  double chi2 = 0;        // that it explains, of the noise's
};

// Of every thinned sample and joint (thinned samples x n) the width of the
// pulse that stands out most, its torque, and by how many standard deviations
// of either sign it does; 0 where less than half of any is seen.
struct PulseResponses {
  Eigen::MatrixXd widths, torques, deviations;

  // The largest of all joints, per thinned sample, without its sign.
  Eigen::VectorXd Largest() const {
    return deviations.cwiseAbs().rowwise().maxCoeff();
  }
};

// A matched filter for pulses in what a fitted model leaves of the torque
// (Turin 1960): with the whitened residual e and the whitened course g of a
// pulse,
//   A = -g'e / g'g,   var A = (1 + |h|^2 / g'g) / g'g,   h = C^(1/2) X'g,
// where X are the whitened columns of the fit and C is the covariance of its
// values. Their errors add to those of the noise as in a prediction, though
// the samples were fitted as well: what looks like one of the columns is
// hardly told from an error of it, and what a fit has taken up is not given
// back.
class PulseScan {
 public:
  // Widths of the pulses that are looked for, s. Each bank is asked by itself:
  // what a model lacks has larger pulses the longer they are.
  static std::vector<std::vector<double>> Banks();

  struct Model {
    std::vector<BaselineColumns> columns;  // per joint, of thinned samples
    Eigen::MatrixXd covariance;            // of all columns' values
    std::vector<Autoregression> noise;     // per joint, of what it leaves
  };
  // `residual`: recorded torque less the model's, thinned samples x n, N m or
  // N; `extra_stddev`: standard deviation of what else a sample of it may be
  // off by, infinite where it is not seen.
  PulseScan(const GapRows& rows, const Model& model,
            const Eigen::MatrixXd& residual,
            const Eigen::MatrixXd& extra_stddev);

  PulseResponses Responses(const std::vector<double>& widths) const;
  // On a joint; of no torque and an infinite deviation where it is not seen.
  Pulse At(int joint, int sample, double width) const;
  // The one that fits a joint best: of the times of these samples and of widths
  // from the shortest that is looked for to `longest`, s.
  Pulse Fitted(int joint, const std::vector<int>& samples,
               double longest) const;

 private:
  // Whitened, as many rows as thinned samples; weight 0 where one is not seen.
  struct Joint {
    Autoregression noise;
    Eigen::VectorXd residual, weight;
    Eigen::MatrixXd half;  // X C^(1/2)
  };
  // Whitened, without weights: from `reach` samples before its time on.
  struct Course {
    int reach = 0;
    Eigen::VectorXd white;
  };

  void Whiten(int segment, const Eigen::VectorXd& residual,
              const Eigen::MatrixXd& half, const Eigen::VectorXd& extra_stddev,
              Joint* joint) const;
  void Scan(int joint, double width, PulseResponses* responses) const;
  Course CourseOf(int joint, double step, double width) const;
  Pulse Fit(int joint, int segment, int sample, const Course& course) const;

  const GapRows& rows_;
  std::vector<Joint> joints_;
};

// How large squared deviations get on each joint of `rows` without a contact,
// as the responses of a reference (`before`) say.
std::vector<UsualMaximum> UsualPeaks(const GapRows& rows,
                                     const PulseResponses& responses,
                                     const GapRows& reference,
                                     const PulseResponses& before);

// What the peaks of a log's own pulses say, where there is no event.
struct OwnPulses {
  // How probable it is that one as large as each event's on a joint is there by
  // itself, on any joint: events x joints.
  Eigen::MatrixXd chances;
  // Per joint: what deviations are off by, over what the model knows of it; 1
  // where it is less.
  Eigen::VectorXd scale;
};

// `windows`: thinned samples of each event.
OwnPulses PulsesBeside(const GapRows& rows, const PulseResponses& responses,
                       const std::vector<std::vector<int>>& windows);

}  // namespace armcal

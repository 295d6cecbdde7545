#pragma once

#include <Eigen/Core>

#include "model/signals/motion.h"

namespace armcal {

// q_j(t) = constant_j + sum_k sine_kj sin(k w t) + cosine_kj cos(k w t), with
// w = 2 pi / period: harmonics in rows, joints in columns, rad or m.
struct FourierCoefficients {
  Eigen::VectorXd constant;
  Eigen::MatrixXd sine, cosine;
};

// Motions that repeat (Swevers et al. 1997): sums of a constant and of the
// sines and cosines of the first harmonics of 1 / period that are at rest, with
// no acceleration, where a period begins. Two numbers of a joint are spent on
// that; the constant and 2 harmonics - 2 more are free.
class HarmonicBasis {
 public:
  // period > 0 (s), harmonics >= 2.
  HarmonicBasis(double period, int harmonics);

  double period() const { return period_; }
  int harmonics() const { return harmonics_; }
  int size() const { return 2 * harmonics_ - 1; }  // numbers per joint

  // What a unit of each number does at `samples` instants every dt s from 0:
  // samples x size(). The first is the constant; of the others a unit is a
  // velocity of about 1, whatever the harmonic.
  Motion Units(int samples, double dt) const;
  FourierCoefficients Fourier(const Eigen::MatrixXd& numbers) const;

 private:
  double period_;
  int harmonics_;
  Eigen::MatrixXd free_;  // of all sines, then all cosines: 2 K x 2 K - 2
};

// The motion of `numbers` (size() x joints) of these units.
Motion Combine(const Motion& units, const Eigen::MatrixXd& numbers);

}  // namespace armcal

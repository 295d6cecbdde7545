#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// About where the spectrum of a motion lies: rms velocity over rms position of
// the joint that changes fastest, over 2 pi. Rows are seen once, in order, and
// those that follow within 20 ms of one are passed over, which keeps encoder
// noise out of the velocity.
class MotionFrequency {
 public:
  // Row `row` of `positions` (rad or m), of time t (s).
  void Add(double t, const Eigen::MatrixXd& positions, int row);
  double Hz() const;  // 0 if nothing moves

 private:
  // A row at which a joint is elsewhere than before and after it, or than after
  // a first row, and what it adds to the sums. Whether it is one of the
  // motion's own turns or no measurement is known when the whole motion is.
  struct Excursion {
    double speed;      // of the slower one of the steps to it and from it
    double rate;       // its part of `rate_`
    double x, square;  // its parts of `sum_` and `square_`
  };
  void FindExcursions(const Eigen::RowVectorXd& q, double t);

  long count_ = 0;
  double last_t_ = 0, step_ = 0, time_ = 0;
  Eigen::RowVectorXd first_, before_, last_;
  Eigen::ArrayXd sum_, square_, rate_;
  std::vector<std::vector<Excursion>> excursions_;  // of each joint
};

}  // namespace armcal

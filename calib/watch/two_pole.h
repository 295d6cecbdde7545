#pragma once

#include <Eigen/Core>
#include <cmath>

namespace armcal {

// Two equal poles one behind the other, a causal low pass of unit gain:
//   x1' = K (u - x1),  x2' = K (x1 - x2),  so that x2 = K^2 / (s + K)^2 u.
// Its output has a derivative that needs none of u: x2' = K (x1 - x2). That is
// how momenta are differentiated here, as the momentum observer of De Luca and
// Mattone (ICRA 2005) does with one pole; the second one keeps the noise of
// positions out. Between samples u is taken for a straight line, over which the
// steps below are exact, whatever the distance of samples.
class TwoPole {
 public:
  explicit TwoPole(double poles_rad_s) : K_(poles_rad_s) {}

  // As if u had been this for ever.
  void Start(const Eigen::MatrixXd& u) { x1_ = x2_ = u_ = u; }
  bool started() const { return u_.size() > 0; }

  // u at the end of a step of h seconds.
  void Step(double h, const Eigen::MatrixXd& u) {
    if (h != h_) Prepare(h);
    x2_ = e_ * x2_ + pass_ * x1_ + g0_ * u_ + g1_ * u;
    x1_ = e_ * x1_ + b0_ * u_ + b1_ * u;
    u_ = u;
  }

  const Eigen::MatrixXd& value() const { return x2_; }
  auto rate() const { return K_ * (x1_ - x2_); }
  // By how much a slow signal comes late, s: 2 / K.
  double delay() const { return 2 / K_; }
  double poles() const { return K_; }

 private:
  // The responses to the step and the ramp of u, at the end of h.
  void Prepare(double h) {
    h_ = h;
    const double Kh = K_ * h;
    e_ = std::exp(-Kh);
    pass_ = Kh * e_;
    b1_ = 1 - (1 - e_) / Kh;
    b0_ = (1 - e_) - b1_;
    g1_ = 1 - 2 / Kh + e_ * (1 + 2 / Kh);
    g0_ = 1 - e_ * (1 + Kh) - g1_;
  }

  double K_;
  double h_ = -1, e_ = 0, pass_ = 0, b0_ = 0, b1_ = 0, g0_ = 0, g1_ = 0;
  Eigen::MatrixXd x1_, x2_, u_;
};

}  // namespace armcal

#pragma once

#include <Eigen/Core>

#include "calib/watch/model.h"
#include "calib/watch/two_pole.h"
#include "model/dynamics/regressor.h"

namespace armcal {

// The torque equations of a running log, without accelerations and without
// anything of the future: with F a causal low pass (two_pole.h) of the rigid
// arm's tau = (d/dt P - D) x,
//   F tau = (d/dt F P - F D) x,
// where F P has a derivative that needs none of P. For known x the difference
// of both sides is the residual of the momentum observer (De Luca and Mattone
// 2005; Haddadin, De Luca, Albu-Schaeffer 2017): the low-passed torque of
// contacts. As equations for x they are the weak form's, whose test function is
// F's impulse response.
//
// P and D are of positions and velocities that come of the recorded positions
// by two faster such filters, through which the torque goes, too; friction is a
// law of the velocity between them. Recorded velocities are not used: what
// filtered them nobody knows.
class CausalRows {
 public:
  // `model` must stay. `bandwidth_hz`: F's poles, over 2 pi.
  CausalRows(const WatchModel& model, double bandwidth_hz);

  // The next sample; times rise. False while the filters forget their start.
  bool Add(double t, const Eigen::VectorXd& q, const Eigen::VectorXd& tau);
  // After a hole: the filters start anew at the next sample.
  void Restart();

  // U x = y, an equation per joint, N m or N.
  const Eigen::MatrixXd& U() const { return U_; }
  Eigen::VectorXd y() const { return torque_.value(); }
  // Each joint's torques by which friction at low speed may differ, per unit of
  // their size: n x kSlowLaws, c exp(-|v| / v_s), Stribeck's law in the form of
  // Tustin (1947; with other exponents Bo and Pavelescu 1982), v_s being 4 and
  // 20 times the width over which Coulomb friction changes its sign.
  const Eigen::MatrixXd& slow() const { return slow_.value(); }
  // How much of each equation lies where friction changes its sign, 0 to 1, and
  // whether the joint has been standing for a while, 0 to 1.
  Eigen::VectorXd crossing() const { return crossing_.value(); }
  Eigen::VectorXd standing() const { return standing_.value(); }
  // Of the positions, as the equations see them.
  Eigen::VectorXd q() const { return position_.value(); }
  Eigen::VectorXd qd() const { return position_.rate(); }
  // By how much the equations are late, s, and after how long they have
  // forgotten: two poles to (1 + 12) exp(-12) = 8e-5.
  double delay() const {
    return fast_position_.delay() + position_.delay() + torque_.delay();
  }
  double memory() const { return 12 * delay() / 2; }

 private:
  void Start(const Eigen::VectorXd& q, const Eigen::VectorXd& tau);
  void Follow(double h, const Eigen::VectorXd& q, const Eigen::VectorXd& tau);
  void SetFriction(double h);

  Regressor regressor_;
  // Of the columns of Coulomb friction: joint and law, in their order.
  std::vector<JointTermColumn> coulomb_;
  Eigen::VectorXd states_, c_, last_velocity_;
  Eigen::VectorXd open_;  // per joint, 0 to 1: how open the sign of friction is
  TwoPole fast_position_, position_, fast_torque_, raw_torque_, raw_c_,
      raw_slow_;
  TwoPole P_, D_, torque_, crossing_, standing_, slow_;
  Eigen::MatrixXd P_now_, D_now_, U_, slow_now_;
  double last_ = 0, begin_ = 0;
  bool started_ = false;
};

// What a constant wrench on the last link (force and moment about its origin,
// in the world's axes, N and N m) takes off each joint's torque: -J^T, n x 6.
Eigen::MatrixXd WrenchColumns(const Robot& robot, const Eigen::VectorXd& q);

}  // namespace armcal

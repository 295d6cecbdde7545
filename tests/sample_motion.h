#pragma once

#include <random>
#include <string>

#include "model/joint_term.h"
#include "model/log.h"
#include "model/robot.h"
#include "model/trajectory.h"

namespace armcal {

// A sum of sines per joint, with exact derivatives.
struct Multisine {
  Eigen::VectorXd offset;     // n, rad or m
  Eigen::MatrixXd amplitude;  // n x tones, rad or m
  Eigen::MatrixXd omega;      // rad/s
  Eigen::MatrixXd phase;      // rad
};

// Three tones of 0.1 to 0.6 Hz per joint, of `size` rad or m together.
Multisine RandomMultisine(std::mt19937_64* random, int n, double size = .8);
// The motion of reference/d2_eiv.py, with its phases for seed 0.
Multisine ScaraMultisine();

// Samples every dt s from 0 to `duration`, without torque.
Log RecordMotion(const Multisine& motion, double duration, double dt);

// Adds the rigid arm's torque (recursive Newton-Euler) and its joints' viscous
// friction and armature to log->tau, which is created where absent.
void AddTorque(const Robot& robot, Log* log);
// Adds Coulomb friction of joint j, followed sample by sample.
void AddCoulomb(int j, double size, const CoulombTransition& transition,
                Log* log);
// (3.14)-(3.16) for the parameters X11 X21 X22 X23 X31 X41 of Table 2, g = 9.8.
void SetPaperScaraTorque(Log* log);
Eigen::VectorXd PaperScaraTruth();

double Normal(std::mt19937_64* random);
// Adds sigma[j] times a standard normal to each entry of column j.
void AddNoise(std::mt19937_64* random, const Eigen::VectorXd& sigma,
              Eigen::MatrixXd* x);
Eigen::VectorXd ColumnRms(const Eigen::MatrixXd& x);

// The whole log as one stretch; qd and qdd as in the log.
Trajectory MakeTrajectory(const Log& log);
// A CSV of t, q and tau; of qd and qdd where asked for. 17 digits.
std::string LogCsv(const Log& log, bool with_rates = false);

}  // namespace armcal

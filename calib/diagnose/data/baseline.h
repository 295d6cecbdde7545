#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "calib/diagnose/data/baseline_column.h"
#include "calib/diagnose/data/baseline_columns.h"
#include "calib/diagnose/data/column_prior.h"
#include "calib/diagnose/data/discrepancy.h"
#include "calib/diagnose/data/known_effects.h"
#include "calib/diagnose/data/rows.h"
#include "calib/logs/joint_term_laws.h"
#include "calib/refine/parameter_posterior.h"
#include "model/dynamics/joint_term.h"
#include "model/dynamics/recorded_torque.h"
#include "model/effects/effect.h"
#include "model/robot/robot.h"

namespace armcal {

// The model that a gap is judged against: the robot, and how far each of its
// parameters may be from it. `trust` is the relative standard deviation of the
// file's inertial parameters, armature and friction.
struct BaselineOptions {
  double trust = 0.05;
  // Whose masses and sizes the trust is relative to, where the robot's are
  // fitted ones, which need not be possible; null: its own.
  const Robot* file = nullptr;
  // Joint terms that the file gives no joint, and that the robot has from a fit
  // to a log: n standard deviations each, SI units of the term. The file does
  // not say anything about them, so that these are as wide as a term can be.
  std::map<JointTerm, Eigen::VectorXd> missing_terms;
  double timing_s = 5e-4;  // standard deviation, torque against position
  // The same of friction's change of sign against that of the velocity, whose
  // low pass takes a stop for a turn; 0: none.
  double reversal_s = 0;
  // What a calibration knows of the robot, which is the calibrated one, and how
  // its joints' Coulomb friction changes sign. Null: the robot is its file's.
  std::shared_ptr<const ParameterPosterior> posterior;
  std::vector<CoulombTransition> transitions;
  // How many of its standard deviations another log's values are off by.
  double posterior_deviations = 1;
  // Whether the logs to be fitted are of another day than the calibration's.
  bool of_another_day = false;
};

class GapBaseline {
 public:
  GapBaseline(const Robot& robot, const BaselineOptions& options,
              const Eigen::VectorXd& usual_torque);

  // The same freedom around values x: they are the new zero.
  GapBaseline MovedTo(const Eigen::VectorXd& x) const;
  // From now on friction may differ between a reference and the diagnosed logs
  // by as much as that of gears does from day to day, and torques' zeros by as
  // much as friction is.
  void FreeDays();
  // From now on the linear parameters of these are columns, too. Once.
  void AddKnown(const KnownEffects& known);
  // From now on what models lack as a rule has columns, too; after all others.
  // Once.
  void AddDiscrepancy(const Discrepancy& discrepancy);
  const Discrepancy& discrepancy() const { return discrepancy_; }
  GapBaseline WithoutDiscrepancy() const;
  // The columns before those.
  int num_model_columns() const;

  const Robot& robot() const { return robot_; }
  int size() const { return static_cast<int>(columns_.size()); }
  const std::vector<BaselineColumn>& columns() const { return columns_; }
  const ColumnPrior& prior() const { return prior_; }
  const std::vector<CoulombTransition>& transitions() const {
    return transitions_;
  }
  // Torque of all columns at unit value, low-passed and thinned, per joint.
  std::vector<BaselineColumns> ThinColumns(
      const GapRows& rows, const std::vector<RecordedTorque>& torques) const;
  // The robot with these values of the columns; nuisances have no place in it.
  Robot With(const Eigen::VectorXd& x) const;
  // Coulomb friction of joint j at x: the joint's own, as far as it changes
  // sign as transitions() say, and what the nuisances give to other widths.
  std::vector<CoulombPart> CoulombAt(int j, const Eigen::VectorXd& x) const;
  // The known effects at x.
  std::vector<KnownEffect> KnownAt(const Eigen::VectorXd& x) const;
  const KnownEffects& known() const { return known_; }
  // The first of their columns.
  int known_begin() const { return known_begin_; }
  // What Coulomb friction of unit size on joint j adds, to first order, where
  // it changes sign 1 s later than the recorded velocity does.
  Eigen::VectorXd LateReversals(int j, const RecordedTorque& torque) const;
  // What joints' terms at x, mixtures of how friction changes sign and known
  // effects give beyond the nominal torque along a motion, samples x n: all but
  // what links give, which is slow.
  Eigen::MatrixXd FrictionBeyond(const Eigen::VectorXd& x,
                                 const RecordedTorque& torque) const;
  // By how much recorded torque is later than the motion, s.
  double DelayAt(const Eigen::VectorXd& x) const;

 private:
  void AddLink(int link, const BaselineOptions& options);
  double WidthOf(const BaselineColumn& column) const;  // of kZeroVelocity
  void AddTerms(int joint, const BaselineOptions& options, double usual_torque);
  void AddReversal(int joint, double timing);
  double ShareOfDay(const BaselineColumn& column) const;
  double OwnSpread(const BaselineColumn& column) const;
  Eigen::VectorXd LawsOfDay(const BaselineColumn& column) const;
  Eigen::VectorXd FineColumn(const BaselineColumn& column, int j,
                             const Eigen::MatrixXd& inertial,
                             const RecordedTorque& torque) const;

  BaselineColumns FineColumns(int j, const GapSegment& segment,
                              const Eigen::MatrixXd& inertial,
                              const std::vector<Eigen::MatrixXd>& known,
                              const RecordedTorque& torque) const;

  Robot robot_;
  Eigen::VectorXd usual_torque_;
  std::vector<BaselineColumn> columns_;
  ColumnPrior prior_;
  KnownEffects known_;
  int known_begin_ = 0;
  Discrepancy discrepancy_;
  std::vector<CoulombTransition> transitions_;
};

// A RecordedTorque per segment.
std::vector<RecordedTorque> RecordedTorques(const GapBaseline& baseline,
                                            const GapRows& rows);

}  // namespace armcal

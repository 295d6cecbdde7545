#include "calib/watch/watcher.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Kind = WatchEvent::Kind;

constexpr double kBlockSeconds = .25;  // s, of the rows of a block
constexpr double kStands = .5;         // of WatchRow::standing, of all joints
// A hole of more than three steps and of more than a tenth of a second.
constexpr double kHoleSteps = 3, kHole = .1;
// The rows of a bandwidth f are 1 / (5 f) apart: what lies between is known.
constexpr double kRowsPerPeriod = 5;
// A contact is over when all residuals were below half of their limits so long.
constexpr double kQuiet = .3;
// Standard deviations that no variance learned from motion leads to.
constexpr double kNeverMoved = 1000;

}  // namespace

Watcher::Watcher(WatchModel model, const WatcherOptions& options, Events events)
    : model_(std::move(model)),
      options_(options),
      events_(std::move(events)),
      rows_(model_, options.bandwidth_hz),
      hypotheses_(MakeWatchHypotheses(model_)),
      null_options_{options.bandwidth_hz,
                    1 / (kRowsPerPeriod * options.bandwidth_hz),
                    options.false_alarms_per_hour},
      block_(model_.columns() + 6),
      whole_log_(model_.size()) {
  belief_ = {VectorXd::Zero(model_.columns()), CovarianceWithSlowLaws(model_)};
  residual_ = VectorXd::Zero(model_.num_joints());
}

void Watcher::Add(double t, const VectorXd& q, const VectorXd& tau) {
  if (last_ < 0) {
    first_ = t;
  } else if (t <= last_) {
    return;  // the same instant again
  } else if (step_ > 0 && t - last_ > std::max(kHoleSteps * step_, kHole)) {
    events_({Kind::kHole,
             t,
             last_,
             {},
             {},
             0,
             false,
             Format("%.3f s without rows", t - last_)});
    rows_.Restart();
    if (contact_) EndContact(t);
    block_ = RowInformation(model_.columns() + 6);
  } else {
    step_ = step_ > 0 ? .99 * step_ + .01 * (t - last_) : t - last_;
  }
  last_ = t;
  if (!rows_.Add(t, q, tau)) return;
  residual_ = rows_.y() -
              rows_.U() * (model_.x + belief_.mean.head(model_.size())) -
              SlowTorque();
  if (null_) CheckResidual(t);
  const double step = null_options_.row_step_s;
  if (last_row_ >= 0 && t - last_row_ < step - 1e-9) return;
  last_row_ =
      last_row_ >= 0 && t - last_row_ < 1.5 * step ? last_row_ + step : t;
  Keep(MakeRow(t));
}

// What friction at low speed is believed to be beside the model's.
VectorXd Watcher::SlowTorque() const {
  const Eigen::Map<const MatrixXd> sizes(belief_.mean.data() + model_.size(),
                                         model_.num_joints(),
                                         WatchModel::kSlowLaws);
  return rows_.slow().cwiseProduct(sizes).rowwise().sum();
}

WatchRow Watcher::MakeRow(double t) const {
  WatchRow row;
  row.t = t;
  const int n = model_.num_joints();
  row.A = MatrixXd::Zero(n, model_.columns() + 6);
  row.A.leftCols(model_.size()) = rows_.U();
  for (int k = 0; k < WatchModel::kSlowLaws; ++k) {
    row.A.middleCols(model_.size() + k * n, n).diagonal() = rows_.slow().col(k);
  }
  row.A.rightCols(6) = WrenchColumns(model_.robot, rows_.q());
  row.r = rows_.y() - rows_.U() * model_.x;
  row.crossing = rows_.crossing();
  row.standing = rows_.standing();
  return row;
}

void Watcher::Keep(const WatchRow& row) {
  if (!contact_) {
    const VectorXd weight = model_.residual_rms.cwiseInverse();
    for (Eigen::Index j = 0; j < row.r.size(); ++j) {
      whole_log_.Add(row.A.row(j).head(model_.size()), row.r[j], weight[j]);
    }
    if (sink)
      sink(weight.asDiagonal() * row.A.leftCols(model_.size()),
           weight.cwiseProduct(row.r));
  }
  if (!null_) return Learn(row);
  parameter_variance_ =
      (row.A.leftCols(model_.columns()) * root_).rowwise().squaredNorm();
  if (row.t < settled_) return;
  if (block_.rows == 0) block_.begin = row.t;
  block_.Add(row.A, row.r, null_->Weight(row));
  block_.end = row.t;
  if (row.t - block_.begin >= kBlockSeconds - 1.5 * null_options_.row_step_s)
    EndBlock(row.t);
}

// From motion alone: what a standing arm's friction holds is anything.
void Watcher::Learn(const WatchRow& row) {
  if (row.standing.minCoeff() > kStands) return;
  learning_rows_.push_back(row);
  learned_s_ += null_options_.row_step_s;
  if (learned_s_ >= options_.learn_s) EndLearning(row.t);
}

void Watcher::SetBelief(const ParameterBelief& belief) {
  belief_ = belief;
  root_ = CovarianceRoot(belief.covariance + null_->wander);
}

void Watcher::EndLearning(double t) {
  ParameterBelief learned = belief_;
  null_ =
      LearnNull(learning_rows_, model_, hypotheses_, null_options_, &learned);
  RowInformation all(model_.columns() + 6);
  for (const WatchRow& row : learning_rows_) {
    all.Add(row.A, row.r, null_->Weight(row));
  }
  WatchEvent event{Kind::kLearned, t, learning_rows_.front().t, {}, {}, 0,
                   false,          ""};
  for (int j = 0; j < model_.num_joints(); ++j) {
    const Joint& joint = model_.robot.links[j].joint;
    event.text += j == 0 ? "a contact has more than " : ", ";
    event.text +=
        null_->threshold[j] > kNeverMoved
            ? joint.name + " anything, as it hardly moved"
            : Format("%s %.3g %s", joint.name.c_str(),
                     null_->threshold[j] * std::sqrt(null_->sigma2[j]),
                     EffortUnit(joint.type));
  }
  events_(event);
  CompareWithCalibration(all, t);
  SetBelief(learned);
  learning_rows_ = {};
}

double Watcher::PeakRatio() const {
  return limit_.size() == 0
             ? 0
             : residual_.cwiseAbs().cwiseQuotient(limit_).maxCoeff();
}

void Watcher::CheckResidual(double t) {
  if (parameter_variance_.size() == 0) return;  // no row yet
  // Friction changes its sign within less than the step of rows.
  const VectorXd crossing = rows_.crossing();
  stddev_ = (null_->Variance(crossing, rows_.standing()) + parameter_variance_)
                .cwiseSqrt();
  limit_ = null_->Limit(crossing, stddev_);
  const double ratio = PeakRatio();
  if (!contact_ || slow_contact_) {
    if (ratio > 1) BeginContact(t);
    return;
  }
  Eigen::Index joint = 0;
  const double most =
      residual_.cwiseAbs().cwiseQuotient(limit_).maxCoeff(&joint);
  if (most > peak_) {
    peak_ = most;
    peak_joint_ = static_cast<int>(joint);
    peak_torque_ = residual_[joint];
  }
  if (ratio > .5) quiet_since_ = t;
  if (t - quiet_since_ > kQuiet) EndContact(t);
}

void Watcher::BeginContact(double t) {
  WatchEvent event{Kind::kContact, t, t - rows_.delay(), {}, {}, 0, false, ""};
  for (int j = 0; j < model_.num_joints(); ++j) {
    if (std::abs(residual_[j]) < limit_[j]) continue;
    const Joint& joint = model_.robot.links[j].joint;
    event.joints.push_back(joint.name);
    event.values.push_back(
        {"torque", EffortUnit(joint.type), residual_[j], stddev_[j]});
  }
  events_(event);
  // What came before it is of the robot as it was.
  Fold(blocks_.size());
  block_ = RowInformation(model_.columns() + 6);
  contact_ = true;
  slow_contact_ = undecided_told_ = false;
  contact_onset_ = unclear_since_ = event.onset;
  quiet_since_ = t;
  peak_ = 0;
  // Rows until then are in part of the robot as it was: no hypothesis's.
  settled_ = t + rows_.memory();
}

void Watcher::EndContact(double t) {
  contact_ = slow_contact_ = undecided_told_ = false;
  unclear_since_ = -1;
  WatchEvent event{
      Kind::kContactEnded, t, contact_onset_, {}, {}, 0, false, ""};
  if (peak_ > 0) {
    const Joint& joint = model_.robot.links[peak_joint_].joint;
    event.joints = {joint.name};
    event.values = {
        {"peak", EffortUnit(joint.type), peak_torque_,
         std::abs(peak_torque_) / peak_ / null_->threshold[peak_joint_]}};
  }
  events_(event);
  blocks_.clear();
  block_ = RowInformation(model_.columns() + 6);
}

}  // namespace armcal

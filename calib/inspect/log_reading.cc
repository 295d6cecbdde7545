#include "calib/inspect/log_reading.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "calib/inspect/held_out_fit.h"
#include "calib/inspect/reading_candidates.h"
#include "calib/inspect/torque_delay.h"
#include "calib/inspect/torque_scale.h"
#include "calib/inspect/turned_gravity.h"
#include "model/robot/axis_rotation.h"

namespace armcal {
namespace {

using Eigen::Vector3d;

// Of 7 joints or fewer; the work grows with the joints' fifth power.
constexpr int kSamplesOfReading = 250;
constexpr double kLeastGain = 15;      // nats
constexpr double kLeastDelay = .0125;  // s; filters and drives have less
constexpr double kLeastTilt = 5;       // degrees
constexpr int kMostChanges = 4;
constexpr int kHeldOutSamples = 500;
constexpr int kMostAsked = 2;  // of a kind, that are tried on held-out data
constexpr double kAskedSpeed = .02;  // rad/s or m/s
constexpr double kLeastAsked = 1;    // s, of a joint whose sign is asked for

using Kind = ReadingChange::Kind;

class Reader {
 public:
  Reader(const Robot& robot, const UniformSeries& series,
         const ReadingHints& hints)
      : robot_(robot),
        series_(series),
        hints_(hints),
        samples_(kSamplesOfReading * 7 / std::max(7, robot.num_joints())),
        best_(robot) {
    const Eigen::VectorXd moving =
        (series.motion().qd.array().abs() > kAskedSpeed)
            .cast<double>()
            .colwise()
            .sum();
    for (int j = 0; j < robot.num_joints(); ++j) {
      moves_.push_back(moving[j] * series.dt() > kLeastAsked);
      num_moving_ += moves_.back();
      tells_.push_back(hints.tells.empty() || hints.tells[j]);
    }
  }

  ReadingFinding Run() {
    held_out_ = HeldOut(best_);
    ReadingFinding finding{best_, {}, 0, 0};
    least_ = Misfit(best_, &finding.residual_percent_as_is);
    TakeHintedUnits();
    while (static_cast<int>(changes_.size()) < kMostChanges && Improve()) {
    }
    TurnGravity();
    RefineGravity();
    finding.reading = best_;
    finding.changes = changes_;
    Misfit(best_, &finding.residual_percent);
    return finding;
  }

 private:
  Robot RobotOf(const LogReading& reading) const {
    Robot robot = robot_;
    robot.gravity = reading.gravity;
    return robot;
  }
  TorqueFit FitOf(const LogReading& reading) const {
    return {RobotOf(reading), SamplesOf(reading).motion};
  }
  HeldOutFit HeldOut(const LogReading& reading) const {
    return FitHeldOut(RobotOf(reading),
                      SamplesAs(reading, robot_, series_, kHeldOutSamples));
  }
  WiringSamples SamplesOf(const LogReading& reading) const {
    return SamplesAs(reading, robot_, series_, samples_);
  }
  double Misfit(const LogReading& reading, double* percent = nullptr) const {
    const WiringSamples samples = SamplesOf(reading);
    return MisfitAsLogged(FitOf(reading), reading, samples.tau, percent);
  }

  TorqueScales ScalesOf(LogReading reading) const {
    reading.torque_unit = 1;
    return TorqueScale(RobotOf(reading), SamplesOf(reading));
  }

  // Of which joints signs and order are asked.
  std::vector<bool> Asked() const {
    std::vector<bool> asked;
    for (int j = 0; j < robot_.num_joints(); ++j) {
      asked.push_back(moves_[best_.wiring.position_column[j]] &&
                      tells_[best_.wiring.torque_column[j]]);
    }
    return asked;
  }

  std::vector<Candidate> Candidates() {
    std::vector<Candidate> all = WiringCandidates(best_, Asked());
    if (FoundGravity() != changes_.end() && best_.gravity.norm() > 0) {
      AddTurnedGravity(&all);
    }
    const double magnitude =
        robot_.gravity.norm() > 0 ? robot_.gravity.norm() : 9.81;
    for (const Candidate& candidate : GravityCandidates(best_, magnitude)) {
      if (AsksGravity() && candidate.reading.gravity != best_.gravity) {
        all.push_back(candidate);
      }
    }
    AddTorqueUnit(best_, ScalesOf(best_), Asked(), &all);
    for (Candidate& candidate : UnitCandidates(best_, robot_)) {
      all.push_back(std::move(candidate));
    }
    all.push_back(BestDelay());
    return all;
  }

  // What a unit that has a hint leaves has to be less; no more is asked, as the
  // inertias of links that move a thousand times as far are free enough to
  // explain much of it: all of it where joints only slide. Then torques cannot
  // choose, and where the joints can be does, if torques do not object.
  void TakeHintedUnits() {
    const std::pair<Kind, PositionUnitHint> hinted[] = {
        {Kind::kDegrees, hints_.units.degrees},
        {Kind::kMillimetres, hints_.units.millimetres}};
    for (const auto& [kind, hint] : hinted) {
      if (hint.evidence.empty()) continue;
      Candidate candidate = InOtherUnit(best_, kind);
      candidate.change.hint = hint.evidence;
      const HeldOutFit held_out = HeldOut(candidate.reading);
      const bool objects =
          hint.out_of_reach
              ? IsClearlyBetter(held_out, held_out_, {})
              : held_out.residual_percent >= held_out_.residual_percent;
      if (!objects) Accept(candidate, Misfit(candidate.reading), 1, held_out);
    }
  }

  // A fit's regressors are most of the work, and of the motion alone.
  std::vector<double> Misfits(const std::vector<Candidate>& all) const {
    std::vector<double> misfits;
    std::optional<TorqueFit> fit;
    for (size_t k = 0; k < all.size(); ++k) {
      const LogReading& reading = all[k].reading;
      const WiringSamples samples = SamplesOf(reading);
      if (k == 0 || !MoveAlike(reading, all[k - 1].reading))
        fit.emplace(RobotOf(reading), samples.motion);
      misfits.push_back(MisfitAsLogged(*fit, reading, samples.tau));
    }
    return misfits;
  }

  // One discrete change, the best that held-out torques confirm; false where
  // there is none.
  bool Improve() {
    std::vector<Candidate> all = Candidates();
    const std::vector<double> misfits = Misfits(all);
    std::vector<size_t> order(all.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](size_t a, size_t b) { return misfits[a] < misfits[b]; });
    std::map<Kind, int> asked;
    std::optional<std::pair<size_t, HeldOutFit>> gravity;
    for (const size_t k : order) {
      if (!(misfits[k] < least_ - kLeastGain)) break;
      const Kind kind = all[k].change.kind;
      if (asked[kind]++ >= kMostAsked) continue;
      const HeldOutFit held_out = HeldOut(all[k].reading);
      if (!Confirms(all[k], held_out)) continue;
      if (!IsBesideUnit(k, held_out, misfits, all)) continue;
      // Gravity turned gives joints that carry nothing a load to be fitted to:
      // where what concerns one joint explains as much, it is that.
      if (kind == Kind::kGravity) {
        if (!gravity) gravity = {k, held_out};
        continue;
      }
      if (gravity && IsClearlyBetter(held_out, gravity->second, {})) break;
      Take(k, held_out, misfits, &all);
      return true;
    }
    if (gravity) Take(gravity->first, gravity->second, misfits, &all);
    return gravity.has_value();
  }

  // What comes with another unit of torques explains more than that alone.
  bool IsBesideUnit(size_t k, const HeldOutFit& held_out,
                    const std::vector<double>& misfits,
                    const std::vector<Candidate>& all) {
    const bool is_both = all[k].change.kind != Kind::kTorqueUnit &&
                         all[k].reading.torque_unit != best_.torque_unit;
    for (size_t i = 0; is_both && i < all.size(); ++i) {
      if (all[i].change.kind != Kind::kTorqueUnit) continue;
      if (!(misfits[k] < misfits[i] - kLeastGain)) return false;
      const HeldOutFit as_is = held_out_;
      held_out_ = HeldOut(all[i].reading);
      const bool confirmed = Confirms(all[k], held_out);
      held_out_ = as_is;
      return confirmed;
    }
    return true;
  }

  void Take(size_t k, const HeldOutFit& held_out,
            const std::vector<double>& misfits, std::vector<Candidate>* all) {
    (*all)[k].change.alternatives = Alternatives(k, held_out, misfits, *all);
    double sum = 0;
    for (const double misfit : misfits) sum += std::exp(misfits[k] - misfit);
    Accept((*all)[k], misfits[k], std::min(1., 1 / sum), held_out);
  }

  // The offsets and first moments of one of several joints that moves alone say
  // the same as gravity's direction.
  bool AsksGravity() const {
    return hints_.asks_gravity &&
           num_moving_ >= std::min(2, robot_.num_joints());
  }

  bool Confirms(const Candidate& candidate, const HeldOutFit& held_out) const {
    const ReadingChange& change = candidate.change;
    const bool all_fit_better = IsBetterForAll(
        OfColumns(held_out_, best_.wiring.torque_column),
        OfColumns(held_out, candidate.reading.wiring.torque_column));
    if (change.kind == Kind::kDelay) {
      return all_fit_better ||
             (joints_agree_ &&
              held_out.residual_percent < held_out_.residual_percent);
    }
    // One of the two is right, and the fit, whose friction and armature take
    // power and whose inertias are near the file's, tells which: of 98 logs of
    // ../shared/data with all torques negated it is likelier so in 97, by 107
    // to 5000 nats, and in the 98th, where it is not, this confirms neither.
    if (IsAllSigns(change.kind) && all_fit_better) return true;
    // Free inertias take half of a wrong sign's misfit in slow motion; the
    // file's own, which are opposite to all torques then, do not.
    if (change.kind == Kind::kAllTorqueSigns && ScalesOf(best_).AreOpposite() &&
        held_out.residual_percent < held_out_.residual_percent) {
      return true;
    }
    // Columns of single joints stand in the motion of all: what is wrong with
    // them shows in the torques of others, too. That of a joint which hardly
    // works may fit better by chance, and a direction of gravity or a unit is
    // so free that it fits what is not its own.
    if (!JointsOf(change).empty() && all_fit_better &&
        IsBetterInTotal(held_out_, held_out)) {
      return true;
    }
    return IsClearlyBetter(held_out_, held_out, JointsOf(change)) ||
           (IsOneSign(change.kind) &&
            IsFirstToExplain(held_out_, held_out, change.joint));
  }

  // What would do as well as the k-th, or nearly so: then what the model misses
  // may decide between them.
  std::vector<ReadingChange> Alternatives(
      size_t k, const HeldOutFit& held_out, const std::vector<double>& misfits,
      const std::vector<Candidate>& all) const {
    const ReadingChange& change = all[k].change;
    std::vector<ReadingChange> alternatives;
    for (size_t i = 0; i < all.size(); ++i) {
      const ReadingChange& other = all[i].change;
      if (!MayBeEither(other, change) ||
          all[i].reading.gravity != all[k].reading.gravity) {
        continue;
      }
      bool does_as_well = misfits[i] < misfits[k] + kLeastGain;
      if (!does_as_well && misfits[i] < least_ - kLeastGain) {
        const HeldOutFit fit = HeldOut(all[i].reading);
        does_as_well = Confirms(all[i], fit) &&
                       !IsClearlyBetter(fit, held_out, JointsOf(change));
      }
      if (does_as_well) alternatives.push_back(other);
    }
    return alternatives;
  }

  void Accept(Candidate candidate, double misfit, double probability,
              const HeldOutFit& held_out) {
    candidate.change.gain = least_ - misfit;
    candidate.change.probability = probability;
    candidate.change.held_out_before = held_out_.residual_percent;
    candidate.change.held_out_after = held_out.residual_percent;
    changes_.push_back(candidate.change);
    best_ = candidate.reading;
    least_ = misfit;
    held_out_ = held_out;
    ForgetGravityOfFile();
  }

  // A change of gravity is none where another has put it back.
  void ForgetGravityOfFile() {
    const auto gravity = FoundGravity();
    if (gravity != changes_.end() && best_.gravity.isApprox(robot_.gravity)) {
      changes_.erase(gravity);
    }
  }

  std::vector<ReadingChange>::iterator FoundGravity() {
    return std::find_if(
        changes_.begin(), changes_.end(),
        [](const ReadingChange& c) { return c.kind == Kind::kGravity; });
  }

  // Gravity the other way round, where the file's own bodies say so.
  void TurnGravity() {
    if (best_.gravity.norm() == 0 || !AsksGravity() || moves_.size() == 1) {
      return;
    }
    const LogReading turned = WithTurnedGravity(best_);
    const double misfit = Misfit(turned);
    if (!(misfit < least_ - kLeastGain)) return;
    const Eigen::MatrixXd tau = SamplesOf(best_).tau;
    const BodiesOfFile as_is(FitOf(best_), tau), so(FitOf(turned), tau);
    if (!AreOfTurnedGravity(as_is, so)) return;
    const HeldOutFit held_out = HeldOut(turned);
    const auto before = FoundGravity();
    if (before == changes_.end()) {
      Accept({turned, {Kind::kGravity}}, misfit, 1, held_out);
      changes_.back().hint = EvidenceOf(as_is, so);
      return;
    }
    before->held_out_after = held_out.residual_percent;
    before->gain += least_ - misfit;
    best_ = turned;
    least_ = misfit;
    held_out_ = held_out;
    ForgetGravityOfFile();
  }

  // A tilt about the world's horizontal axes, by ever smaller steps.
  void RefineGravity() {
    if (best_.gravity.norm() == 0 || !AsksGravity()) return;
    LogReading at = best_;
    double misfit = least_;
    const Vector3d down = best_.gravity.normalized();
    const Vector3d across = down.unitOrthogonal();
    const Vector3d axes[] = {across, down.cross(across)};
    for (double step = 16; step >= 1; step /= 2) {
      for (bool moved = true; moved;) {
        moved = false;
        for (const Vector3d& axis : axes) {
          for (const double sign : {-1., 1.}) {
            LogReading next = at;
            next.gravity =
                Eigen::AngleAxisd(sign * step * kDegree, axis) * at.gravity;
            const double value = Misfit(next);
            if (value >= misfit) continue;
            misfit = value;
            at = next;
            moved = true;
          }
        }
      }
    }
    const double tilt =
        std::acos(std::min(1., at.gravity.normalized().dot(down))) / kDegree;
    if (tilt < kLeastTilt || misfit > least_ - kLeastGain) return;
    const HeldOutFit held_out = HeldOut(at);
    // One change of gravity, not two.
    const auto before = FoundGravity();
    if (before == changes_.end()) {
      if (!Confirms({at, {Kind::kGravity}}, held_out)) return;
      Accept({at, {Kind::kGravity}}, misfit, 1, held_out);
    } else if (held_out.residual_percent < held_out_.residual_percent) {
      before->held_out_after = held_out.residual_percent;
      before->gain += least_ - misfit;
      best_ = at;
      least_ = misfit;
    }
  }

  // What the joints agree on, else what is best for all of them together.
  Candidate BestDelay() {
    Candidate best{best_, {Kind::kDelay}};
    const TorqueDelay found = FindTorqueDelay(
        FitOf(best_),
        [&](double delay) {
          LogReading at = best_;
          at.delay = delay;
          return SamplesOf(at).tau;
        },
        Asked());
    joints_agree_ = found.IsBeyond(kLeastDelay);
    const double delay = joints_agree_ ? found.mean : found.best;
    if (joints_agree_ || (found.inside && std::abs(delay) > kLeastDelay)) {
      best.reading.delay = delay;
    }
    return best;
  }

  const Robot& robot_;
  const UniformSeries& series_;
  const ReadingHints& hints_;
  const int samples_;
  LogReading best_;
  double least_ = 0;
  HeldOutFit held_out_;              // of best_
  std::vector<bool> moves_, tells_;  // of columns as logged
  int num_moving_ = 0;
  bool joints_agree_ = false;  // on the delay of the latest candidates
  std::vector<ReadingChange> changes_;
};

}  // namespace

ReadingFinding FindReading(const Robot& robot, const UniformSeries& series,
                           const ReadingHints& hints) {
  return Reader(robot, series, hints).Run();
}

}  // namespace armcal

#include "calib/inspect/log_reading.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "calib/inspect/gravity_reading.h"
#include "calib/inspect/held_out_fit.h"
#include "calib/inspect/reading_candidates.h"
#include "calib/inspect/reading_confirmation.h"
#include "calib/inspect/reading_state.h"
#include "calib/inspect/torque_delay.h"

namespace armcal {
namespace {

constexpr double kLeastDelay = .0125;  // s; filters and drives have less
constexpr int kMostChanges = 4;
constexpr int kMostAsked = 2;  // of a kind, that are tried on held-out data
constexpr double kAskedSpeed = .02;  // rad/s or m/s
constexpr double kLeastAsked = 1;    // s, of a joint whose sign is asked for

using Kind = ReadingChange::Kind;

class Reader {
 public:
  Reader(const Robot& robot, const UniformSeries& series,
         const ReadingHints& hints)
      : hints_(hints), state_(robot, series) {
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
    ReadingFinding finding{state_.best, {}, 0, 0};
    state_.Misfit(state_.best, &finding.residual_percent_as_is);
    TakeHintedUnits();
    while (static_cast<int>(state_.changes.size()) < kMostChanges &&
           Improve()) {
    }
    if (state_.best.gravity.norm() > 0 && AsksGravity()) {
      if (moves_.size() > 1) TurnGravity(&state_);
      RefineGravity(&state_);
    }
    finding.reading = state_.best;
    finding.changes = state_.changes;
    state_.Misfit(state_.best, &finding.residual_percent);
    return finding;
  }

 private:
  // Of which joints signs and order are asked.
  std::vector<bool> Asked() const {
    std::vector<bool> asked;
    for (int j = 0; j < state_.robot.num_joints(); ++j) {
      asked.push_back(moves_[state_.best.wiring.position_column[j]] &&
                      tells_[state_.best.wiring.torque_column[j]]);
    }
    return asked;
  }

  std::vector<Candidate> Candidates() {
    std::vector<Candidate> all = WiringCandidates(state_.best, Asked());
    if (state_.FoundGravity() != state_.changes.end() &&
        state_.best.gravity.norm() > 0) {
      AddTurnedGravity(&all);
    }
    const double magnitude =
        state_.robot.gravity.norm() > 0 ? state_.robot.gravity.norm() : 9.81;
    for (const Candidate& candidate :
         GravityCandidates(state_.best, magnitude)) {
      if (AsksGravity() && candidate.reading.gravity != state_.best.gravity) {
        all.push_back(candidate);
      }
    }
    AddTorqueUnit(state_.best, state_.ScalesOf(state_.best), Asked(), &all);
    for (Candidate& candidate :
         UnitCandidates(state_.best, state_.robot, Asked())) {
      all.push_back(std::move(candidate));
    }
    all.push_back(BestDelay());
    return all;
  }

  // What has the hint may be one column alone that is beyond its limits, if
  // torques say so clearly.
  Candidate AllOrOne(Kind kind) const {
    Candidate best = InOtherUnit(state_.best, kind);
    double least = state_.Misfit(best.reading) - kLeastReadingGain;
    for (const Candidate& one :
         OneInOtherUnit(state_.best, kind, state_.robot, Asked())) {
      if (!BringsInReach(state_, one)) continue;
      const double misfit = state_.Misfit(one.reading);
      if (misfit >= least) continue;
      least = misfit;
      best = one;
    }
    return best;
  }

  // What a unit that has a hint leaves has to be less; held-out torques are not
  // asked for more, as the inertias of links that move a thousand times as far
  // are free enough to explain much of it: all of it where joints only slide.
  // Then torques cannot choose, and where the joints can be does, if torques do
  // not object. Limits are the file's, though, and may be placeholders: without
  // recorded velocities and the gain that any other reading needs it is a
  // doubt, and a limit of speed alone tells nothing.
  void TakeHintedUnits() {
    const std::pair<Kind, PositionUnitHint> hinted[] = {
        {Kind::kDegrees, hints_.units.degrees},
        {Kind::kMillimetres, hints_.units.millimetres}};
    for (const auto& [kind, hint] : hinted) {
      if (hint.evidence.empty()) continue;
      Candidate candidate = AllOrOne(kind);
      candidate.change.hint = hint.evidence;
      const HeldOutFit held_out = state_.HeldOut(candidate.reading);
      const bool objects =
          hint.out_of_reach
              ? IsClearlyBetter(held_out, state_.held_out, {})
              : held_out.residual_percent >= state_.held_out.residual_percent;
      const double misfit = state_.Misfit(candidate.reading);
      const bool is_sure =
          hint.by_velocities || misfit < state_.misfit - kLeastReadingGain;
      candidate.change.is_doubt = !is_sure;
      if (!objects && (is_sure || hint.out_of_reach))
        state_.Accept(candidate, misfit, 1, held_out);
    }
  }

  // A fit's regressors are most of the work, and of the motion alone.
  std::vector<double> Misfits(const std::vector<Candidate>& all) const {
    std::vector<double> misfits;
    std::optional<TorqueFit> fit;
    for (size_t k = 0; k < all.size(); ++k) {
      const LogReading& reading = all[k].reading;
      const WiringSamples samples = state_.SamplesOf(reading);
      if (k == 0 || !MoveAlike(reading, all[k - 1].reading))
        fit.emplace(state_.RobotOf(reading), samples.motion);
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
      if (!(misfits[k] < state_.misfit - kLeastReadingGain)) break;
      const Kind kind = all[k].change.kind;
      if (asked[kind]++ >= kMostAsked) continue;
      const HeldOutFit held_out = state_.HeldOut(all[k].reading);
      if (!IsConfirmed(state_, all[k], state_.held_out, held_out)) continue;
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
                    const std::vector<Candidate>& all) const {
    const bool is_both = all[k].change.kind != Kind::kTorqueUnit &&
                         all[k].reading.torque_unit != state_.best.torque_unit;
    for (size_t i = 0; is_both && i < all.size(); ++i) {
      if (all[i].change.kind != Kind::kTorqueUnit) continue;
      if (!(misfits[k] < misfits[i] - kLeastReadingGain)) return false;
      return IsConfirmed(state_, all[k], state_.HeldOut(all[i].reading),
                         held_out);
    }
    return true;
  }

  void Take(size_t k, const HeldOutFit& held_out,
            const std::vector<double>& misfits, std::vector<Candidate>* all) {
    (*all)[k].change.alternatives =
        AlternativesTo(k, held_out, misfits, *all, state_);
    if (BringsInReach(state_, (*all)[k])) {
      (*all)[k].change.hint = "as logged they are beyond the file's limits";
    }
    double sum = 0;
    for (const double misfit : misfits) sum += std::exp(misfits[k] - misfit);
    state_.Accept((*all)[k], misfits[k], std::min(1., 1 / sum), held_out);
  }

  // The offsets and first moments of one of several joints that moves alone say
  // the same as gravity's direction.
  bool AsksGravity() const {
    return hints_.asks_gravity &&
           num_moving_ >= std::min(2, state_.robot.num_joints());
  }

  // What the joints agree on. One clock stamps all torques, while what a model
  // lacks looks late in one joint and early in another: where they do not
  // agree, a shift that fits all of them together is no delay. One joint alone
  // has none to agree with.
  Candidate BestDelay() {
    Candidate best{state_.best, {Kind::kDelay}};
    const std::vector<bool> asked = Asked();
    const TorqueDelay found = FindTorqueDelay(
        state_.FitOf(state_.best),
        [&](double delay) {
          LogReading at = state_.best;
          at.delay = delay;
          return state_.SamplesOf(at).tau;
        },
        asked);
    state_.joints_of_delay = found.is_alone ? 1 : found.joints;
    if (found.IsBeyond(kLeastDelay)) best.reading.delay = found.mean;
    return best;
  }

  const ReadingHints& hints_;
  ReadingState state_;
  std::vector<bool> moves_, tells_;  // of columns as logged
  int num_moving_ = 0;
};

}  // namespace

ReadingFinding FindReading(const Robot& robot, const UniformSeries& series,
                           const ReadingHints& hints) {
  return Reader(robot, series, hints).Run();
}

}  // namespace armcal

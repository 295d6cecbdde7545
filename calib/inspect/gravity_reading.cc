#include "calib/inspect/gravity_reading.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "calib/inspect/reading_confirmation.h"
#include "calib/inspect/turned_gravity.h"
#include "model/robot/axis_rotation.h"

namespace armcal {
namespace {

using Eigen::Vector3d;

constexpr double kLeastTilt = 5;  // degrees

// What fits best of readings whose gravity is tilted from the best one's, with
// its misfit.
LogReading BestTilted(const ReadingState& state, double* misfit) {
  LogReading at = state.best;
  const Vector3d down = at.gravity.normalized();
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
          const double value = state.Misfit(next);
          if (value >= *misfit) continue;
          *misfit = value;
          at = next;
          moved = true;
        }
      }
    }
  }
  return at;
}

}  // namespace

void TurnGravity(ReadingState* state) {
  const LogReading turned = WithTurnedGravity(state->best);
  const double misfit = state->Misfit(turned);
  if (!(misfit < state->misfit - kLeastReadingGain)) return;
  const Eigen::MatrixXd tau = state->SamplesOf(state->best).tau;
  const BodiesOfFile as_is(state->FitOf(state->best), tau);
  const BodiesOfFile so(state->FitOf(turned), tau);
  if (!AreOfTurnedGravity(as_is, so)) return;
  const HeldOutFit held_out = state->HeldOut(turned);
  const auto before = state->FoundGravity();
  if (before == state->changes.end()) {
    state->Accept({turned, {ReadingChange::Kind::kGravity}}, misfit, 1,
                  held_out);
    state->changes.back().hint = EvidenceOf(as_is, so);
    return;
  }
  before->held_out_after = held_out.residual_percent;
  before->gain += state->misfit - misfit;
  state->best = turned;
  state->misfit = misfit;
  state->held_out = held_out;
  state->ForgetGravityOfFile();
}

void RefineGravity(ReadingState* state) {
  double misfit = state->misfit;
  const LogReading at = BestTilted(*state, &misfit);
  const double cosine =
      at.gravity.normalized().dot(state->best.gravity.normalized());
  const double tilt = std::acos(std::min(1., cosine)) / kDegree;
  if (tilt < kLeastTilt || misfit > state->misfit - kLeastReadingGain) return;
  const HeldOutFit held_out = state->HeldOut(at);
  // One change of gravity, not two.
  const auto before = state->FoundGravity();
  if (before == state->changes.end()) {
    const Candidate tilted{at, {ReadingChange::Kind::kGravity}};
    if (!IsConfirmed(*state, tilted, state->held_out, held_out)) return;
    state->Accept(tilted, misfit, 1, held_out);
  } else if (held_out.residual_percent < state->held_out.residual_percent) {
    before->held_out_after = held_out.residual_percent;
    before->gain += state->misfit - misfit;
    state->best = at;
    state->misfit = misfit;
  }
}

}  // namespace armcal

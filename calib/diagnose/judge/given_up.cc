#include "calib/diagnose/judge/given_up.h"

#include <algorithm>
#include <cmath>

#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/judge/claims.h"

namespace armcal {
namespace {

// Whether held-out data have no less of a gap with it, and would have.
bool LeavesNoLess(const FoundEffect& found, const GapFigures& torque) {
  return !std::isnan(torque.removed_percent) && !found.fitted.empty() &&
         found.gain.IsNone();
}

// At most as likely as not.
void Lower(FoundEffect* found) {
  for (double* p : {&found->probability, &found->any_probability}) {
    *p = std::min(*p, Limits().untold);
  }
}

// What held-out data show as well is something, which has another name.
void GiveUp(std::vector<FoundEffect>::iterator found, GapFindings* findings) {
  findings->without_name |= IsSeenAgain(*found);
  findings->unnamed.insert(findings->unnamed.begin(), *found);
  findings->effects.erase(found);
}

// Gives up the one that removes least of the fitted effects that `may_go`.
// Whether there was one.
template <typename MayGo>
bool GiveUpLeast(const MayGo& may_go, GapFindings* findings) {
  std::vector<FoundEffect>& effects = findings->effects;
  auto worst = effects.end();
  for (auto found = effects.begin(); found != effects.end(); ++found) {
    if (found->fitted.empty() || !may_go(*found)) continue;
    if (worst == effects.end() ||
        found->removed_percent < worst->removed_percent) {
      worst = found;
    }
  }
  if (worst == effects.end()) return false;
  GiveUp(worst, findings);
  return true;
}

}  // namespace

bool GiveUpWorst(const GapFigures& torque, bool since_reference,
                 GapFindings* findings) {
  const double most = since_reference ? 100 * Limits().explains : 0;
  if (!(torque.ci95[1] < most)) return false;
  const bool nothing = torque.ci95[0] <= 0;
  const auto of = [&](bool seen) {
    return [nothing, seen](const FoundEffect& found) {
      return IsSeenAgain(found) == seen &&
             (nothing || found.probability < Limits().likely_unseen);
    };
  };
  return GiveUpLeast(of(false), findings) ||
         (since_reference && GiveUpLeast(of(true), findings));
}

// An effect is fitted beside others first, which may leave the fit again; what
// it is then is known only now. That no real arm has it, or that its numbers
// may be 0, says nothing against there being something.
bool GiveUpImpossible(GapFindings* findings) {
  std::vector<FoundEffect>& effects = findings->effects;
  const auto found =
      std::find_if(effects.begin(), effects.end(), [](const FoundEffect& one) {
        return !one.fitted.empty() && (!one.is_possible || !HasANumber(one));
      });
  if (found == effects.end()) return false;
  GiveUp(found, findings);
  Lower(&findings->unnamed.front());
  return true;
}

// An effect that removes nothing of the held-out gap, or makes it larger, where
// it says that it would remove some, is not seen there: it may be what chance
// gave in the fitted data. Its probability is at most indifference
// (Limits().untold).
void LowerWhatDoesNotHelp(const GapFigures& torque,
                          std::vector<FoundEffect>* effects) {
  for (FoundEffect& found : *effects) {
    if (LeavesNoLess(found, torque)) Lower(&found);
  }
}

// Where the interval ends below one half, most of the gap has another cause for
// certain. Friction of another day stays: that there is some, many joints say
// together.
bool GiveUpWhatDoesNotHelp(const GapFigures& torque, GapFindings* findings) {
  if (!(torque.ci95[1] < 100 * Limits().explains)) return false;
  const auto does_not_help = [&](const FoundEffect& found) {
    return !found.of_another_day && LeavesNoLess(found, torque);
  };
  if (!GiveUpLeast(does_not_help, findings)) return false;
  Lower(&findings->unnamed.front());
  return true;
}

}  // namespace armcal

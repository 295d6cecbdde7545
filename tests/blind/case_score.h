#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/blind/blind_label.h"
#include "tests/blind/equivalents.h"

namespace armcal {

// From this probability on a name is a confident one.
inline constexpr double kConfident = .8;

enum class Match { kWrong, kEquivalent, kRight };

// One answer judged by its label. A name is right with its class and joint, and
// as good as right where it is a declared equivalent of the truth.
class CaseScore {
 public:
  // Refers to none of its arguments afterwards.
  CaseScore(const BlindLabel& label, const BlindAnswer& answer,
            const Equivalents& equivalents);

  const BlindLabel& label() const { return label_; }
  const BlindAnswer& answer() const { return answer_; }

  bool answered() const { return !answer_.verdict.empty(); }
  bool claims() const { return !answer_.effects.empty(); }
  // Claims an effect or says that there is something it does not know.
  bool detects() const;
  // Of a case without effect: detects, or says `explained`.
  bool alarms() const;

  // Each claimed effect against the effects of the case.
  const std::vector<Match>& matches() const { return matches_; }
  Match top() const { return claims() ? matches_[0] : Match::kWrong; }
  // The strongest is right, or says itself that it may as well be the truth.
  bool top_allows_truth() const;
  bool top_joint() const;            // the strongest is on the truth's joint
  bool FindsEffect(size_t k) const;  // effect k of the label is claimed
  bool finds_all() const;
  bool exact() const;  // and nothing else
  // A name with a probability of 0.8 that is neither right nor equivalent.
  bool names_wrongly() const;
  // The 95 % set holds the first effect of the label.
  bool candidates_hold() const { return candidates_hold_; }

  // |estimate / truth - 1| of the size of effect k where it was named rightly
  // and with an estimate of that name and unit.
  std::optional<double> SizeError(size_t k) const;

  // What is wrong with the answer; empty: nothing.
  std::string Fault() const;

 private:
  BlindLabel label_;
  BlindAnswer answer_;
  std::vector<Match> matches_;
  // Claimed effect i against effect k of the label.
  std::vector<std::vector<Match>> pairs_;
  bool candidates_hold_ = false;
};

}  // namespace armcal

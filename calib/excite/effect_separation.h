#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/excite/design_target.h"
#include "calib/excite/excitation.h"
#include "calib/excite/separation_question.h"
#include "model/dynamics/model_parameters.h"
#include "model/robot/robot.h"

namespace armcal {

// A size of an effect that a motion is to tell apart from others'.
struct SeparatedSize {
  std::string effect;
  int joint = -1;  // from 0; -1: the whole robot
  std::string parameter, unit;
  double size = 0;    // one that would matter
  double stddev = 0;  // predicted, with all the other sizes unknown too
  double alone = 0;   // the same with the others known
};

// A motion chosen to tell effects apart, on every joint that can show them.
struct EffectSeparation {
  Excitation motion;  // criterion: log of the largest stddev over size
  std::vector<SeparatedSize> sizes;
};

// The motion within the limits that makes the least certain of the sizes of
// `question` as certain as possible, model parameters being unknown but for
// `known` (m x m): random motions, the best of them improved by random steps
// that are kept where they help (the effects' laws have no slopes to follow).
// Not converged and without numbers where no motion tells them apart.
EffectSeparation SeparateEffects(const Robot& robot,
                                 const ModelParameters& model,
                                 const SeparationQuestion& question,
                                 const Eigen::MatrixXd& known,
                                 const ExcitationOptions& options);

// The sizes as what a motion was designed for.
NamedQuantities SeparatedQuantities(const Robot& robot,
                                    const EffectSeparation& separation);

}  // namespace armcal

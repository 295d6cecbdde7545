#pragma once

#include <random>
#include <string>
#include <vector>

#include "model/plant/hidden/hidden_effect.h"

namespace armcal {

// Every kind there is: those of model/effects, then those outside the
// catalogue.
const std::vector<HiddenEffect>& HiddenEffects();
// nullptr where there is none of that name.
const HiddenEffect* FindHiddenEffect(const std::string& name);

// Empty, or why this effect cannot be applied here with these parameters: what
// a caller that reads them from a file or a flag asks first.
std::string WhyNotApplicable(const HiddenEffect& effect,
                             const SimulatedRobot& robot, int joint,
                             const Eigen::VectorXd& parameters,
                             const EffectContext& context);

// Fills slots of the robot. joint: of the driven ones, from 0; -1 for an effect
// of the whole robot. CHECKs WhyNotApplicable. Several effects may be applied
// one after the other, those with changes_robot first.
std::vector<EffectValue> ApplyHiddenEffect(const HiddenEffect& effect,
                                           SimulatedRobot* robot, int joint,
                                           const Eigen::VectorXd& parameters,
                                           const EffectContext& context);

Eigen::VectorXd UsualParameters(const HiddenEffect& effect);
Eigen::VectorXd DrawParameters(const HiddenEffect& effect,
                               std::mt19937_64* random);

}  // namespace armcal

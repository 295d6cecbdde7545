#pragma once

#include <nlohmann/json.hpp>

#include "calib/diagnose/candidates/corrected_robot.h"

namespace armcal {

// effects.json: all that was found, for simulators with laws of their own, SI
// units: delay_s, delay_in[]; joints[] {name, viscous, offset, offset_in[],
// armature, coulomb[] {force, width, law}, effect_width}; effects[] {effect,
// joint, joint_index, law, in_urdf, in[] (names of formats), parameters[]
// {name, unit, value}, numbers {name: value}, share {viscous, coulomb, width,
// offset}}.
// Coulomb friction is the sum of force * tanh(qd / width); `effect_width` is
// that of effects' sign(v). `numbers` are all that the law has, of the site as
// well, where modules hold it; `share` is the friction that robot files have in
// its stead, where they do.
nlohmann::json EffectsJson(const CorrectedRobot& corrected);

}  // namespace armcal

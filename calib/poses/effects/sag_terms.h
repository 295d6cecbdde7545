#pragma once

#include <vector>

#include "calib/poses/effects/effect.h"

namespace armcal {

// Whether weight on the tool turns the joint by a lever that changes from pose
// to pose; one that stays is the joint's zero.
bool FeelsWeight(const PoseCampaign& campaign, int joint);

// The joint turns in proportion to the moment about it of a weight at the tool,
// with `parts` 2 also of one that is spread over the links: amounts in rad per
// metre of lever. Of an arm that was weighed, to the moment of its weight, with
// 1 part alone: rad per N m, the joint's compliance. A joint gives way with its
// load and never against it: none of the amounts is below 0.
std::vector<PoseTerm> SagTerms(const PoseCampaign& campaign, int joint,
                               int parts);

}  // namespace armcal

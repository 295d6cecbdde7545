#include "calib/poses/effects/sag_terms.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

// m, rms about the mean: a lever that changes less turns no joint noticeably.
constexpr double kLeastChange = 1e-2;

// Two moments whose changes are alike to this share are one.
constexpr double kLeastDifference = .05;

double SpreadOf(const Eigen::VectorXd& x) {
  return std::sqrt((x.array() - x.mean()).square().mean());
}

// The spread of y that is not in proportion to that of x, over y's own.
double OwnShare(const Eigen::VectorXd& y, const Eigen::VectorXd& x) {
  const Eigen::VectorXd a = x.array() - x.mean(), b = y.array() - y.mean();
  const double alike = a.dot(b) / (a.norm() * b.norm());
  return std::sqrt(std::max(0.0, 1 - alike * alike));
}

}  // namespace

bool FeelsWeight(const PoseCampaign& campaign, int joint) {
  return SpreadOf(campaign.tool_moment.col(joint)) > kLeastChange;
}

std::vector<PoseTerm> SagTerms(const PoseCampaign& campaign, int joint,
                               int parts) {
  std::vector<PoseTerm> terms;
  const auto add = [&](PostureSignal::Of moment, const char* by,
                       const char* unit) {
    terms.push_back(
        PostureTerm(campaign, PoseTerm::Acts::kJoint, joint, {moment, joint},
                    campaign.robot().links[joint].joint.name + by, unit));
    terms.back().least = 0;
  };
  if (campaign.arm.weighed) {
    add(PostureSignal::Of::kWeightMoment, "", "rad/(N m)");
    if (!campaign.arm.compliance.empty()) {
      terms[0].told = campaign.arm.compliance[joint];
    }
    return terms;
  }
  add(PostureSignal::Of::kToolMoment, "", "rad/m");
  const Eigen::VectorXd own = campaign.link_moment.col(joint);
  if (parts < 2 || SpreadOf(own) < kLeastChange) return terms;
  if (OwnShare(own, campaign.tool_moment.col(joint)) < kLeastDifference) {
    return terms;
  }
  add(PostureSignal::Of::kLinkMoment, " by its own links", "rad/m");
  return terms;
}

}  // namespace armcal

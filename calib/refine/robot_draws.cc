#include "calib/refine/robot_draws.h"

#include <array>
#include <map>

#include "calib/numerics/convex_draws.h"
#include "calib/refine/possible_range.h"
#include "calib/refine/robot_parameters.h"
#include "model/robot/inertial_parameters.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

// Values of parameters at which a robot can exist.
class PossibleRobots {
 public:
  // `drawn`: which of `all` change. Of each link it is noted which of these its
  // ten parameters are; the others are held at the estimate.
  PossibleRobots(const Robot& robot, const std::vector<PhysicalParameter>& all,
                 const std::vector<int>& drawn) {
    std::map<std::string, int> places;
    for (size_t k = 0; k < drawn.size(); ++k) {
      const std::string& name = all[drawn[k]].name;
      places[name] = static_cast<int>(k);
      if (IsNeverNegative(name)) positive_.push_back(static_cast<int>(k));
    }
    std::map<std::string, double> values;
    for (const PhysicalParameter& p : all) values[p.name] = p.value;
    for (const Link& link : robot.links) {
      LinkPlaces& places_of = links_.emplace_back();
      for (int k = 0; k < 10; ++k) {
        const std::string name = link.name + "." + InertialName(k);
        places_of.held[k] = values.at(name);
        const auto place = places.find(name);
        places_of.at[k] = place == places.end() ? -1 : place->second;
      }
    }
  }

  // The part of a line on which a robot can exist.
  LineRange OnLine(const VectorXd& at, const VectorXd& along) const {
    PossibleRange range;
    for (const int k : positive_) range.KeepPositive(at[k], along[k]);
    for (const LinkPlaces& link : links_) {
      range.KeepPossible(link.Of(at, link.held),
                         link.Of(along, Vector10d::Zero()));
    }
    return range.range();
  }

 private:
  struct LinkPlaces {
    std::array<int, 10> at;  // -1: held
    Vector10d held;
    Vector10d Of(const VectorXd& drawn, const Vector10d& others) const {
      Vector10d V = others;
      for (int k = 0; k < 10; ++k) {
        if (at[k] >= 0) V[k] = drawn[at[k]];
      }
      return V;
    }
  };

  std::vector<LinkPlaces> links_;
  std::vector<int> positive_;
};

}  // namespace

// Hit-and-run (Smith 1984; Belisle, Romeijn & Smith 1993) by DrawWithin.
// Rejection, drawing Gaussians and dropping impossible ones, would hardly ever
// hit where a link that only the file tells is thin.
RobotDraws DrawRobots(const NonlinearCalibration& calibrated, int count) {
  constexpr uint64_t kSeed = 1;
  const std::vector<PhysicalParameter>& all = calibrated.parameters;
  std::vector<int> drawn;
  VectorXd estimate(all.size());
  for (size_t k = 0; k < all.size(); ++k) {
    estimate[static_cast<Eigen::Index>(k)] = all[k].value;
    if (calibrated.covariance(k, k) > 0) drawn.push_back(static_cast<int>(k));
  }
  const PossibleRobots possible(calibrated.nominal, all, drawn);
  const Eigen::MatrixXd draws = DrawWithin(
      estimate(drawn), calibrated.covariance(drawn, drawn),
      [&possible](const VectorXd& at, const VectorXd& along) {
        return possible.OnLine(at, along);
      },
      count, kSeed);
  RobotDraws result;
  for (const PhysicalParameter& p : all) result.names.push_back(p.name);
  result.values = estimate.replicate(1, count);
  result.values(drawn, Eigen::all) = draws;
  for (int r = 0; r < count; ++r) {
    RobotParameters robot(calibrated.nominal);
    for (size_t k = 0; k < all.size(); ++k) {
      if (robot.Has(all[k].name)) {
        robot.Set(all[k].name, result.values(static_cast<Eigen::Index>(k), r));
      }
    }
    result.robots.push_back(robot.Apply());
  }
  return result;
}

std::string RobotDrawsCsv(const RobotDraws& draws) {
  std::string text;
  for (const std::string& name : draws.names) {
    text += (text.empty() ? "\"" : ",\"") + name + "\"";
  }
  text += "\n";
  for (const VectorXd& values : draws.values.colwise()) {
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      text += Format(k > 0 ? ",%.17g" : "%.17g", values[k]);
    }
    text += "\n";
  }
  return text;
}

}  // namespace armcal

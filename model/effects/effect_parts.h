#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "model/effects/effect.h"

namespace armcal {
inline namespace effects {

// What effects are made of.

// Scales of the site's joint, never 0.
double TorqueScale(const EffectSite& site);        // N m or N
double SpeedScale(const EffectSite& site);         // rad/s or m/s
double AccelerationScale(const EffectSite& site);  // rad/s^2 or m/s^2
// The displacement that counts as one radian: 0.3 m of a prismatic joint, about
// the lever by which revolute ones move things.
double Radian(const EffectSite& site);
// kg m^2 or kg, that the joint turns or pushes in the middle of its range with
// the other joints in the middle of theirs, all held.
double CarriedInertia(const EffectSite& site);
double MovingMass(const Robot& robot);
// Whether an arm can carry it, or have lost it: no arm carries three times what
// moves of it (industrial arms carry a third to a fifth of that), and none
// loses more than moves of it. Of a robot without masses any, and any that data
// do not tell (NaN).
bool IsOfAnArm(const Robot& robot, double mass);  // kg, of all links
// Whether what hangs on the last link is told as a payload: any joint moves the
// origin of the tool's frame, in which a mass shows then, or there is one joint
// alone. On a head that pans and tilts about one point none does.
bool CarriesPayload(const Robot& robot);
// Of a point mass with first moments h about the origin, kg m^2 about it:
//   (|h|^2 1 - h h') / mass,
// its lever at most a metre, beyond which no load is: a search passes masses
// that are small for their moments. A mass taken off is negative.
Eigen::Matrix3d PointInertia(double mass, const Eigen::Vector3d& h);
// The log's length, s, never 0.
double Duration(const EffectSite& site);

using SiteSize = std::function<double(const EffectSite&)>;
using SiteGrid = std::function<std::vector<double>(const EffectSite&)>;
SiteSize ShareOfTorque(double share);
SiteSize ShareOfDrag(double share);  // of torque per speed
// `count` values in equal ratios.
std::vector<double> GeometricGrid(double low, double high, int count);

EffectParameter Linear(
    const std::string& name, const std::string& unit, SiteSize size,
    EffectParameter::Sign sign = EffectParameter::Sign::kFree);
// Its usual value is the one in the middle of the grid.
EffectParameter Gridded(const std::string& name, const std::string& unit,
                        SiteGrid grid);
// Tried at the values between the first and the last of `grid`, which are its
// range; the first that is tried is usual.
EffectParameter Refined(const std::string& name, const std::string& unit,
                        std::vector<double> grid);
EffectParameter Searched(const std::string& name, const std::string& unit,
                         EffectParameter::Search search, SiteSize size);

// The joints next to the site's, those of its own type if there are any.
std::vector<int> Neighbours(const EffectSite& site);
// Their numbers, from 1: a parameter of effects between two joints.
EffectParameter NeighbourParameter();
std::string WhyNoNeighbour(const EffectSite& site);
// Of what a motor makes of its command: why not here, or empty. A passive
// joint, and one whose torque was not recorded, have zeros throughout.
std::string WhyNotRecorded(const EffectSite& site);
// Of what is felt by its swinging and lifting: why not here, or empty.
std::string WhyNotCarried(const EffectSite& site);

// A law of the site's joint without states.
using InstantTorque = std::function<double(const ArmInstant& instant)>;
void AddFriction(const EffectSite& site, const InstantTorque& torque,
                 SimulatedRobot* robot);
void AddTorque(const EffectSite& site, const InstantTorque& torque,
               SimulatedRobot* robot);
// What the site's motor gives of a command, without states, and its inverse
// (MotorMap).
void AddActuator(const EffectSite& site,
                 const std::function<double(double commanded)>& given,
                 const std::function<double(double given)>& commanded,
                 SimulatedRobot* robot);
// A motor that gives commanded / (1 + gain).
void AddGain(const EffectSite& site, double gain, SimulatedRobot* robot);
// Whether the first estimate can be such a gain of a motor's constant.
bool IsOfAMotorConstant(const EffectSite&,
                        const std::vector<EffectEstimate>& estimates);

// a sin(x) + b cos(x) = amplitude sin(x + phase).
double Amplitude(double a, double b);
double Phase(double a, double b);  // rad
// ln(1 + e^x): a ramp with a rounded corner at 0.
double SoftPlus(double x);
// A unit of the site's joint, as of ParameterUnit.
std::string UnitAt(const EffectSite& site, const std::string& unit);

}  // namespace effects
}  // namespace armcal

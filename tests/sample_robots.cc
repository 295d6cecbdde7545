#include "tests/sample_robots.h"

#include <cmath>
#include <map>

#include "model/uniform_draw.h"

namespace armcal {
namespace {

constexpr double kPi = 3.14159265358979323846;

struct Row {
  double a, d, alpha;
  JointType type = JointType::kRevolute;
};
struct Table {
  std::vector<Row> rows;
  Eigen::Vector3d gravity;
};

const std::map<std::string, Table>& Tables() {
  static const std::map<std::string, Table> kTables = {
      {"2R planar (vertical plane)", {{{.5, 0, 0}, {.4, 0, 0}}, {0, -9.81, 0}}},
      {"2R planar (horizontal)", {{{.5, 0, 0}, {.4, 0, 0}}, {0, 0, -9.81}}},
      {"3R elbow", {{{0, .6, kPi / 2}, {.5, 0, 0}, {.4, 0, 0}}, {0, 0, -9.81}}},
      {"SCARA RRPR",
       {{{.4, 0, 0}, {.3, 0, 0}, {0, 0, 0, JointType::kPrismatic}, {0, 0, 0}},
        {0, 0, 9.8}}},
      {"PUMA560 6R",
       {{{0, 0, kPi / 2},
         {.4318, 0, 0},
         {.0203, .15005, -kPi / 2},
         {0, .4318, kPi / 2},
         {0, 0, -kPi / 2},
         {0, 0, 0}},
        {0, 0, -9.81}}},
      {"UR5 6R",
       {{{0, .089159, kPi / 2},
         {-.425, 0, 0},
         {-.39225, 0, 0},
         {0, .10915, kPi / 2},
         {0, .09465, -kPi / 2},
         {0, .0823, 0}},
        {0, 0, -9.81}}},
      {"Panda 7R",
       {{{0, .333, -kPi / 2},
         {0, 0, kPi / 2},
         {.0825, .316, kPi / 2},
         {-.0825, 0, -kPi / 2},
         {0, .384, kPi / 2},
         {.088, 0, kPi / 2},
         {0, .107, 0}},
        {0, 0, -9.81}}},
      {"KUKA iiwa/LBR 7R",
       {{{0, .34, -kPi / 2},
         {0, 0, kPi / 2},
         {0, .4, kPi / 2},
         {0, 0, -kPi / 2},
         {0, .4, -kPi / 2},
         {0, 0, kPi / 2},
         {0, .126, 0}},
        {0, 0, -9.81}}}};
  return kTables;
}

Link MakeLink(int index, const DhParameters& dh, JointType type) {
  Link link;
  link.name = "link" + std::to_string(index + 1);
  link.joint.name = "joint" + std::to_string(index + 1);
  link.joint.type = type;
  SetDhPose(dh, DhConvention::kStandard, &link);
  return link;
}

double Pick(std::mt19937_64* random, const std::vector<double>& values) {
  return values[static_cast<size_t>(
      Uniform(random, 0, static_cast<double>(values.size()) - 1e-9))];
}

}  // namespace

double Uniform(std::mt19937_64* random, double low, double high) {
  const double u = UniformDraw(random);
  return low + (high - low) * u;
}

Eigen::VectorXd UniformVector(std::mt19937_64* random, int n, double low,
                              double high) {
  Eigen::VectorXd v(n);
  for (double& x : v) x = Uniform(random, low, high);
  return v;
}

Robot SampleRobot(const std::string& name) {
  const Table& table = Tables().at(name);
  Robot robot;
  robot.name = name;
  robot.gravity = table.gravity;
  robot.dh_convention = DhConvention::kStandard;
  for (const Row& row : table.rows) {
    robot.links.push_back(MakeLink(static_cast<int>(robot.links.size()),
                                   {row.a, row.d, row.alpha, 0}, row.type));
  }
  return robot;
}

std::vector<std::string> SampleRobotNames() {
  std::vector<std::string> names;
  for (const auto& entry : Tables()) names.push_back(entry.first);
  return names;
}

void SetRandomInertials(std::mt19937_64* random, Robot* robot) {
  for (Link& link : robot->links) {
    const double mass = Uniform(random, .5, 5);
    Eigen::Matrix3d A;
    for (double& x : A.reshaped()) x = Uniform(random, -.1, .1);
    const Eigen::Matrix3d second =  // positive definite density-weighted
        mass * (A * A.transpose() + 1e-3 * Eigen::Matrix3d::Identity());
    link.inertial = InertialParameters::FromCenterOfMass(
        mass, UniformVector(random, 3, -.15, .15),
        second.trace() * Eigen::Matrix3d::Identity() - second);
    link.has_inertial = true;
  }
}

Robot RandomArm(int n, std::mt19937_64* random) {
  static const Eigen::Vector3d kGravities[] = {
      {0, 0, -9.81}, {0, 0, 9.8}, {0, -9.81, 0}, {3, -4, 8}};
  Robot robot;
  robot.name = "random";
  robot.dh_convention = DhConvention::kStandard;
  robot.gravity = kGravities[static_cast<int>(Pick(random, {0, 1, 2, 3}))];
  for (int k = 0; k < n; ++k) {
    const bool prismatic = Uniform(random, 0, 1) < .3;
    DhParameters dh;
    dh.alpha =
        Pick(random, {0, kPi / 2, -kPi / 2, kPi, Uniform(random, -3, 3)});
    dh.a = Pick(random, {0, Uniform(random, -.6, .6)});
    dh.d = Pick(random, {0, Uniform(random, -.6, .6)});
    dh.theta = Uniform(random, -2, 2);
    robot.links.push_back(MakeLink(
        k, dh, prismatic ? JointType::kPrismatic : JointType::kRevolute));
  }
  return robot;
}

}  // namespace armcal

#include "tools/python/robot_binding.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>

#include "model/dynamics/forward_dynamics.h"
#include "model/dynamics/inverse_dynamics.h"
#include "model/dynamics/model_parameters.h"
#include "model/robot/kinematics.h"
#include "model/robot_files/urdf_update.h"
#include "model/robot_files/urdf_writer.h"
#include "model/text/decimal_point.h"
#include "model/text/input_text.h"
#include "tools/python/loaded_robot.h"
#include "tools/python/robot_reading.h"
#include "tools/python/samples.h"

namespace armcal {
namespace {

namespace py = pybind11;

using Array = py::array_t<double>;
using RowMajor =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::vector<std::string> LinkNames(const LoadedRobot& file) {
  std::vector<std::string> names;
  for (const Link& link : file.robot.links) names.push_back(link.name);
  return names;
}

// A property of all joints.
template <class T>
auto JointProperty(T Joint::*member) {
  return [member](const LoadedRobot& file) {
    Eigen::VectorXd values(file.robot.num_joints());
    for (int j = 0; j < values.size(); ++j) {
      values[j] = file.robot.links[j].joint.*member;
    }
    return values;
  };
}

std::vector<std::string> JointTexts(const LoadedRobot& file,
                                    const char* (*text)(JointType)) {
  std::vector<std::string> texts;
  for (const Link& link : file.robot.links) {
    texts.push_back(text(link.joint.type));
  }
  return texts;
}

RowMajor InertialRows(const LoadedRobot& file) {
  RowMajor rows(file.robot.num_joints(), 10);
  for (int j = 0; j < rows.rows(); ++j) {
    rows.row(j) = file.robot.links[j].inertial.ToVector().transpose();
  }
  return rows;
}

void SetInertial(const py::object& given, Robot* robot) {
  const int n = robot->num_joints();
  const Samples rows = ReadSamples("inertial_parameters", given, 10);
  if (rows.single || rows.size() != n) {
    throw py::value_error("inertial_parameters: found " +
                          std::to_string(rows.size()) + " rows, expected " +
                          std::to_string(n) + " of 10, one per link");
  }
  if (!rows.values.allFinite()) {
    throw py::value_error("inertial_parameters: expected finite numbers");
  }
  for (int j = 0; j < n; ++j) {
    robot->links[j].inertial = InertialParameters::FromVector(rows.at(j));
    robot->links[j].has_inertial = true;
  }
}

void SetJoints(const char* name, const py::object& given, double Joint::*member,
               Robot* robot) {
  if (given.is_none()) return;
  const Eigen::VectorXd values = ReadVector(name, given, robot->num_joints());
  for (int j = 0; j < values.size(); ++j) {
    if (values[j] < 0 && member != &Joint::offset) {
      throw py::value_error(std::string(name) + "[" + std::to_string(j) +
                            "]: found " + NumberText(values[j]) +
                            ", expected a number of at least 0");
    }
    robot->links[j].joint.*member = values[j];
  }
}

LoadedRobot Replace(const LoadedRobot& from, const py::object& inertial,
                    const py::object& gravity, const py::object& viscous,
                    const py::object& coulomb, const py::object& armature,
                    const py::object& offset) {
  LoadedRobot file = from;
  Robot* const robot = &file.robot;
  if (!inertial.is_none()) SetInertial(inertial, robot);
  if (!gravity.is_none()) {
    robot->gravity = ReadVector("gravity", gravity, 3);
  }
  SetJoints("viscous", viscous, &Joint::viscous, robot);
  SetJoints("coulomb", coulomb, &Joint::coulomb, robot);
  SetJoints("armature", armature, &Joint::armature, robot);
  SetJoints("offset", offset, &Joint::offset, robot);
  return file;
}

Array InverseDynamicsOf(const LoadedRobot& file, const py::object& q_given,
                        const py::object& qd_given,
                        const py::object& qdd_given) {
  const int n = file.robot.num_joints();
  const Samples q = ReadSamples("q", q_given, n);
  const Samples qd = ReadSamples("qd", qd_given, n, q);
  const Samples qdd = ReadSamples("qdd", qdd_given, n, q);
  return ForSamples(q, {n}, [&](long k, double* tau) {
    Eigen::Map<Eigen::VectorXd>(tau, n) =
        InverseDynamics(file.robot, q.at(k), qd.at(k), qdd.at(k));
  });
}

// Torques are linear in the inertial parameters: a column is the torque of a
// robot that has one of them, 1, and nothing else.
Array RegressorOf(const LoadedRobot& file, const py::object& q_given,
                  const py::object& qd_given, const py::object& qdd_given) {
  const int n = file.robot.num_joints();
  const Samples q = ReadSamples("q", q_given, n);
  const Samples qd = ReadSamples("qd", qd_given, n, q);
  const Samples qdd = ReadSamples("qdd", qdd_given, n, q);
  Robot unit = file.robot;
  for (Link& link : unit.links) link.inertial = InertialParameters();
  return ForSamples(q, {n, 10 * n}, [&](long k, double* values) {
    Eigen::Map<RowMajor> Y(values, n, 10 * n);
    for (int c = 0; c < 10 * n; ++c) {
      InertialParameters* const inertial = &unit.links[c / 10].inertial;
      *inertial = InertialParameters::FromVector(Vector10d::Unit(c % 10));
      Y.col(c) = InverseDynamics(unit, q.at(k), qd.at(k), qdd.at(k));
      *inertial = InertialParameters();
    }
  });
}

Array ForwardDynamicsOf(const LoadedRobot& file, const py::object& q_given,
                        const py::object& qd_given,
                        const py::object& tau_given) {
  const int n = file.robot.num_joints();
  const Samples q = ReadSamples("q", q_given, n);
  const Samples qd = ReadSamples("qd", qd_given, n, q);
  const Samples tau = ReadSamples("tau", tau_given, n, q);
  return ForSamples(q, {n}, [&](long k, double* qdd) {
    Eigen::Map<Eigen::VectorXd>(qdd, n) =
        ForwardDynamics(file.robot, q.at(k), qd.at(k), tau.at(k));
  });
}

Array MassMatrixOf(const LoadedRobot& file, const py::object& q_given) {
  const int n = file.robot.num_joints();
  const Samples q = ReadSamples("q", q_given, n);
  return ForSamples(q, {n, n}, [&](long k, double* M) {
    Eigen::Map<RowMajor>(M, n, n) = MassMatrix(file.robot, q.at(k));
  });
}

Array GravityTorqueOf(const LoadedRobot& file, const py::object& q_given) {
  const int n = file.robot.num_joints();
  const Samples q = ReadSamples("q", q_given, n);
  return ForSamples(q, {n}, [&](long k, double* tau) {
    Eigen::Map<Eigen::VectorXd>(tau, n) = GravityTorque(file.robot, q.at(k));
  });
}

void StorePose(const Eigen::Isometry3d& X, double* values) {
  Eigen::Map<RowMajor>(values, 4, 4) = X.matrix();
}

Array ToolPoseOf(const LoadedRobot& file, const py::object& q_given) {
  const Samples q = ReadSamples("q", q_given, file.robot.num_joints());
  return ForSamples(q, {4, 4}, [&](long k, double* values) {
    StorePose(ToolPose(file.robot, q.at(k)), values);
  });
}

Array LinkPosesOf(const LoadedRobot& file, const py::object& q_given) {
  const int n = file.robot.num_joints();
  const Samples q = ReadSamples("q", q_given, n);
  return ForSamples(q, {n, 4, 4}, [&](long k, double* values) {
    for (const Eigen::Isometry3d& X : LinkPoses(file.robot, q.at(k))) {
      StorePose(X, values);
      values += 16;
    }
  });
}

std::string Describe(const LoadedRobot& file) {
  return "<armcal.Robot '" + file.robot.name + "', " +
         std::to_string(file.robot.num_joints()) + " joints>";
}

std::string UpdatedUrdf(const LoadedRobot& file,
                        const std::filesystem::path& path, bool geometry) {
  return UpdateUrdf(path.empty() ? file.file : path.string(), file.robot,
                    geometry, file.base);
}

std::vector<int> Parents(const Robot& robot) {
  std::vector<int> parents;
  for (int i = 0; i < robot.num_joints(); ++i) {
    parents.push_back(robot.parent(i));
  }
  return parents;
}

std::vector<std::string> ModelParameterNames(const LoadedRobot& file) {
  const ModelParameters model(file.robot, {});
  std::vector<std::string> names;
  for (const ModelParameter& p : model.parameters()) names.push_back(p.name);
  return names;
}

void AddProperties(py::class_<LoadedRobot>* robot) {
  const auto add = [robot](const char* name, auto get, const char* doc) {
    robot->def_property_readonly(name, get, doc);
  };
  add(
      "name", [](const LoadedRobot& f) { return f.robot.name; },
      "Of the file.");
  add(
      "num_joints", [](const LoadedRobot& f) { return f.robot.num_joints(); },
      "n.");
  add(
      "joint_names", [](const LoadedRobot& f) { return f.robot.JointNames(); },
      "n names, base to tips.");
  add("link_names", &LinkNames, "n names, base to tips.");
  add(
      "joint_types",
      [](const LoadedRobot& f) { return JointTexts(f, &JointTypeName); },
      "revolute, continuous or prismatic.");
  add(
      "position_units",
      [](const LoadedRobot& f) { return JointTexts(f, &PositionUnit); },
      "rad or m.");
  add(
      "effort_units",
      [](const LoadedRobot& f) { return JointTexts(f, &EffortUnit); },
      "N m or N.");
  add(
      "gravity", [](const LoadedRobot& f) { return f.robot.gravity; },
      "(3,), in the base's frame, m/s^2.");
  add(
      "notes", [](const LoadedRobot& f) { return f.robot.notes; },
      "What the reader changed or dropped, a sentence each.");
  add(
      "parents", [](const LoadedRobot& f) { return Parents(f.robot); },
      "n numbers: the link, from 0, that each joint sits on, -1 for the base.");
  add(
      "held", [](const LoadedRobot& f) { return f.robot.held; },
      "{joint: position}: where joints beside the robot's own are held.");
  add("model_parameters", &ModelParameterNames,
      "Names of the combinations of inertial parameters that torques of the "
      "links depend on (Ha, Ko and Kwon 1989), geometry known.");
  add("inertial_parameters", &InertialRows,
      "(n, 10): m, hx, hy, hz, Ixx, Ixy, Iyy, Ixz, Iyz, Izz of every link "
      "about "
      "the origin of its frame; kg, kg m, kg m^2.");
  add("lower", JointProperty(&Joint::lower), "(n,), rad or m.");
  add("upper", JointProperty(&Joint::upper), "(n,), rad or m.");
  add("velocity_limits", JointProperty(&Joint::velocity),
      "(n,), rad/s or m/s.");
  add("effort_limits", JointProperty(&Joint::effort), "(n,), N m or N.");
  add("viscous", JointProperty(&Joint::viscous), "(n,), N m s/rad or N s/m.");
  add("coulomb", JointProperty(&Joint::coulomb), "(n,), N m or N.");
  add("armature", JointProperty(&Joint::armature), "(n,), kg m^2 or kg.");
  add("offset", JointProperty(&Joint::offset),
      "(n,), a constant torque, N m or N.");
}

void AddDynamics(py::class_<LoadedRobot>* robot) {
  robot
      ->def("inverse_dynamics", &InverseDynamicsOf, py::arg("q"), py::arg("qd"),
            py::arg("qdd"),
            "Torques (N, n), N m or N, of the rigid links at q, qd, qdd "
            "(N, n): no friction, no armature.")
      .def("forward_dynamics", &ForwardDynamicsOf, py::arg("q"), py::arg("qd"),
           py::arg("tau"),
           "Accelerations (N, n), rad/s^2 or m/s^2, that torques (N, n) give "
           "the links with their armature; no friction.")
      .def("mass_matrix", &MassMatrixOf, py::arg("q"),
           "(N, n, n), kg m^2 (kg m, kg), of the links; no armature.")
      .def("gravity_torque", &GravityTorqueOf, py::arg("q"),
           "Torques (N, n), N m or N, that hold the arm at rest.")
      .def("regressor", &RegressorOf, py::arg("q"), py::arg("qd"),
           py::arg("qdd"),
           "Y (N, n, 10 n): inverse_dynamics() is Y @ "
           "inertial_parameters.ravel().")
      .def("tool_pose", &ToolPoseOf, py::arg("q"),
           "(N, 4, 4), the pose of the tool in the base's frame, m.")
      .def("link_poses", &LinkPosesOf, py::arg("q"),
           "(N, n, 4, 4), the poses of the links in the base's frame, m.");
}

}  // namespace

void AddRobot(py::module_* module) {
  py::class_<LoadedRobot> robot(
      *module, "Robot",
      "A serial arm of n joints. Functions take N samples, shape (N, n), or a "
      "single one, shape (n,); then their results have no first axis.");
  AddProperties(&robot);
  AddDynamics(&robot);
  const py::none none;
  robot
      .def("replace", &Replace, py::kw_only(),
           py::arg("inertial_parameters") = none, py::arg("gravity") = none,
           py::arg("viscous") = none, py::arg("coulomb") = none,
           py::arg("armature") = none, py::arg("offset") = none,
           "This robot with other values, shapes as of the properties.")
      .def(
          "to_urdf", [](const LoadedRobot& f) { return MakeUrdf(f.robot); },
          py::call_guard<DecimalPoint>(),
          "A URDF of the chain alone, without meshes.")
      .def("update_urdf", &UpdatedUrdf, py::arg("path") = "",
           py::arg("geometry") = false, py::call_guard<DecimalPoint>(),
           "The URDF file at path (default: the one it is from) with its "
           "numbers changed to this robot's; its origins too with geometry.")
      .def(
          "urdf_losses",
          [](const LoadedRobot& f) { return UrdfLosses(f.robot); },
          py::call_guard<DecimalPoint>(),
          "What a URDF cannot say of this robot, a sentence each.")
      .def("__repr__", &Describe, py::call_guard<DecimalPoint>());
  AddRobotReading(module, &robot);
  py::list names, units;
  for (int k = 0; k < 10; ++k) {
    names.append(InertialName(k));
    units.append(InertialUnit(k));
  }
  module->attr("INERTIAL_NAMES") = py::tuple(names);
  module->attr("INERTIAL_UNITS") = py::tuple(units);
}

}  // namespace armcal

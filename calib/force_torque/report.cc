#include "calib/force_torque/report.h"

#include <Eigen/Geometry>
#include <cmath>

#include "model/text/format.h"

namespace armcal {
namespace {

using nlohmann::json;
using Model = ForceTorqueModel;

template <class Vector>
json ListOf(const Vector& values) {
  json list = json::array();
  for (Eigen::Index k = 0; k < values.size(); ++k) list.push_back(values[k]);
  return list;
}

json StddevsOf(const ForceTorqueSensor& sensor, int first, int count) {
  json list = json::array();
  for (int k = first; k < first + count; ++k) {
    list.push_back(sensor.Stddev(k));
  }
  return list;
}

json RowsOf(const Eigen::Matrix3d& R) {
  json rows = json::array();
  for (int i = 0; i < 3; ++i) rows.push_back(ListOf(R.row(i)));
  return rows;
}

// Entries of which the logs tell nothing are null.
void AddInertia(const ForceTorqueSensor& sensor, json* all) {
  InertialParameters about_center;
  about_center.inertia = sensor.fit.model.inertia;
  constexpr int kFirstInertia = 4;  // of ToVector()
  for (int k = 0; k < 6; ++k) {
    const char* const name = InertialName(kFirstInertia + k);
    json& entry = (*all)["inertia"][name];
    json& stddev = (*all)["inertia_stddev"][name];
    if (!sensor.inertia_told[k]) continue;
    entry = about_center.ToVector()[kFirstInertia + k];
    stddev = sensor.Stddev(Model::kInertia + k);
  }
}

void AddEstimate(const ForceTorqueSensor& sensor, json* all) {
  const Model& model = sensor.fit.model;
  (*all)["mass"] = model.mass;
  (*all)["mass_stddev"] = sensor.Stddev(Model::kMass);
  (*all)["center_of_mass"] = ListOf(model.center);
  (*all)["center_of_mass_stddev"] = StddevsOf(sensor, Model::kCenter, 3);
  AddInertia(sensor, all);
  (*all)["bias"] = ListOf(model.bias);
  (*all)["bias_stddev"] = StddevsOf(sensor, Model::kBias, 6);
  (*all)["rotation"] = RowsOf(model.R_LS);
  (*all)["rotation_stddev"] = StddevsOf(sensor, Model::kRotation, 3);
  (*all)["reports"] =
      model.sign > 0 ? "the force on the load" : "the force of the load";
  (*all)["noise"] = ListOf(sensor.fit.noise);
  (*all)["residual_rms"] = ListOf(sensor.fit.rms);
}

}  // namespace

json ForceTorqueJson(const ForceTorqueSensor& sensor) {
  json all = {{"samples", sensor.samples},
              {"directions", sensor.directions},
              {"solved", sensor.solved},
              {"not_told", sensor.not_told}};
  if (sensor.solved) AddEstimate(sensor, &all);
  return all;
}

std::string ForceTorqueText(const ForceTorqueSensor& sensor) {
  if (sensor.samples == 0) return "";
  std::string text;
  if (sensor.solved) {
    const Model& m = sensor.fit.model;
    const Eigen::AngleAxisd turn(m.R_LS);
    const auto stddev = [&](int k) { return sensor.Stddev(k); };
    text += Format(
        "force-torque sensor  carries %.4g kg (stddev %.2g) with its centre of "
        "mass at (%.4g, %.4g, %.4g) m of the last link's frame (%.2g, %.2g, "
        "%.2g)\n",
        m.mass, stddev(Model::kMass), m.center.x(), m.center.y(), m.center.z(),
        stddev(Model::kCenter), stddev(Model::kCenter + 1),
        stddev(Model::kCenter + 2));
    text += Format(
        "  turned by %.2f deg about (%.2f, %.2f, %.2f) of it, reports %s\n",
        turn.angle() * 180 / M_PI, turn.axis().x(), turn.axis().y(),
        turn.axis().z(),
        m.sign > 0 ? "the force on its load" : "the force of its load");
    text += Format(
        "  bias (%.3g, %.3g, %.3g) N, (%.3g, %.3g, %.3g) N m; left of forces "
        "%.2g N rms, of torques %.2g N m, of %ld samples\n",
        m.bias[0], m.bias[1], m.bias[2], m.bias[3], m.bias[4], m.bias[5],
        std::sqrt(sensor.fit.rms.head<3>().squaredNorm() / 3),
        std::sqrt(sensor.fit.rms.tail<3>().squaredNorm() / 3), sensor.samples);
  }
  for (const std::string& why : sensor.not_told) {
    text += "force-torque sensor  cannot tell " + why + "\n";
  }
  return text;
}

}  // namespace armcal

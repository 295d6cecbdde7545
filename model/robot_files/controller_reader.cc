#include "model/robot_files/controller_reader.h"

#include <vector>

#include "model/text/input_text.h"
#include "model/text/yaml_node.h"

namespace armcal {
namespace {

// Of a delay or a lag, s; what is longer was meant in ms.
constexpr double kLongest = 1;

double ReadPositive(const YamlNode& node, const std::string& key,
                    const std::string& unit, double value) {
  const auto child = node.Child(key);
  if (!child) return value;
  const double read = child->Number(unit);
  if (read <= 0) child->Refuse("expected a number above 0, in " + unit);
  return read;
}

void ExpectShort(const YamlNode& node, double seconds) {
  if (seconds <= kLongest) return;
  node.Refuse("expected at most " + NumberText(kLongest) +
              " s; is it in milliseconds?");
}

void ReadParameter(const YamlNode& node, const DriveParameter& parameter,
                   ControllerOptions* options) {
  const auto child = node.Child(parameter.name);
  if (!child) return;
  if (!HasParameter(options->kind, parameter)) {
    child->Refuse(std::string("expected no such key: law ") +
                  DriveKindName(options->kind) + " has no " + parameter.name);
  }
  const std::string unit =
      std::string(parameter.unit) == parameter.linear_unit
          ? parameter.unit
          : std::string(parameter.unit) + " (" + parameter.linear_unit + ")";
  const Eigen::VectorXd values = child->Vector(unit);
  const int n = options->drives.size();
  if (values.size() != n) {
    child->Refuse("expected " + std::to_string(n) +
                  " numbers, one per joint, in " + unit);
  }
  if (values.minCoeff() < 0) child->Refuse("expected numbers of at least 0");
  if (parameter.value == &DriveLaw::lag) ExpectShort(*child, values.maxCoeff());
  for (int j = 0; j < n; ++j) options->drives[j].*parameter.value = values[j];
}

// The gains that the file gives. An integral gain that it does not is that of
// the gains which the drive then has.
void ReadDrives(const YamlNode& node, double bandwidth_hz,
                ControllerOptions* options) {
  for (const DriveParameter& parameter : DriveParameters()) {
    ReadParameter(node, parameter, options);
  }
  for (DriveLaw& law : options->drives) {
    DriveLaw usual = law;
    SetIntegralGain(options->kind, bandwidth_hz, &usual);
    if (!node.Child("ki")) law.ki = usual.ki;
    if (!node.Child("velocity_ki")) law.velocity_ki = usual.velocity_ki;
  }
}

DriveKind ReadKind(const YamlNode& node) {
  const auto child = node.Child("law");
  if (!child) return DriveKind::kPd;
  const std::string name = child->Choice({"pd", "p", "cascade"});
  return name == "pd"  ? DriveKind::kPd
         : name == "p" ? DriveKind::kP
                       : DriveKind::kCascade;
}

std::vector<std::string> Keys() {
  std::vector<std::string> keys = {"law", "rate", "bandwidth"};
  for (const DriveParameter& parameter : DriveParameters()) {
    keys.push_back(parameter.name);
  }
  keys.insert(keys.end(), {"delay", "velocity_filter", "feedforward"});
  return keys;
}

}  // namespace

ControllerOptions ReadController(const std::string& path, const Robot& robot,
                                 const Eigen::VectorXd& q) {
  const YamlNode node = YamlNode::ReadFile(path);
  node.ExpectKeys(Keys());
  const double bandwidth_hz =
      ReadPositive(node, "bandwidth", "Hz", kUsualBandwidthHz);
  ControllerOptions options =
      DefaultController(robot, q, bandwidth_hz, ReadKind(node));
  options.rate_hz = ReadPositive(node, "rate", "Hz", options.rate_hz);
  if (options.rate_hz < 1 || options.rate_hz > kFastestHz) {
    node.RequiredChild("rate").Refuse("expected a rate from 1 to " +
                                      NumberText(kFastestHz) + " Hz");
  }
  ReadDrives(node, bandwidth_hz, &options);
  if (const auto child = node.Child("delay")) {
    options.delay = child->NonNegative("s");
    ExpectShort(*child, options.delay);
  }
  options.velocity_filter_hz =
      ReadPositive(node, "velocity_filter", "Hz", options.velocity_filter_hz);
  if (const auto child = node.Child("feedforward")) {
    const std::string name =
        child->Choice({"none", "gravity", "inverse_dynamics"});
    options.feedforward = name == "none"      ? Feedforward::kNone
                          : name == "gravity" ? Feedforward::kGravity
                                              : Feedforward::kInverseDynamics;
  }
  return options;
}

}  // namespace armcal

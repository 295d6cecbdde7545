#include "model/ros_bags/joint_messages.h"

#include <limits>
#include <string>

#include "model/ros_bags/cdr_reader.h"
#include "model/ros_bags/message_header.h"

namespace armcal {
namespace {

void CheckCount(const std::vector<double>& values, size_t names,
                const char* what) {
  if (values.empty() || values.size() == names) return;
  throw CdrError("has " + std::to_string(names) + " names and " +
                 std::to_string(values.size()) + " values of " + what);
}

void CheckCounts(const JointState& state) {
  const size_t names = state.names.size();
  CheckCount(state.position, names, "position");
  CheckCount(state.velocity, names, "velocity");
  CheckCount(state.effort, names, "effort");
  CheckCount(state.reference, names, "reference");
}

// The header and the joints' names.
void ReadBegin(CdrReader* cdr, JointState* state) {
  state->stamp = ReadStamp(cdr);
  state->name_bytes = cdr->Texts(&state->names);
  state->reference.clear();
}

// trajectory_msgs/msg/JointTrajectoryPoint.
void ReadPoint(CdrReader* cdr, std::vector<double>* position,
               std::vector<double>* velocity, std::vector<double>* effort) {
  cdr->Doubles(position);
  cdr->Doubles(velocity);
  std::vector<double> acceleration;
  cdr->Doubles(&acceleration);
  cdr->Doubles(effort);
  cdr->Signed();  // the time from the trajectory's start, s and ns
  cdr->Unsigned();
}

// The array that an interface's values belong to; none of others.
std::vector<double>* ArrayOf(std::string_view interface, JointState* state) {
  if (interface == "position") return &state->position;
  if (interface == "velocity") return &state->velocity;
  return interface == "effort" ? &state->effort : nullptr;
}

}  // namespace

bool IsJointState(std::string_view type) {
  return IsMessageType(type, "sensor_msgs", "JointState");
}

bool IsFloat64MultiArray(std::string_view type) {
  return IsMessageType(type, "std_msgs", "Float64MultiArray");
}

bool IsDynamicJointState(std::string_view type) {
  return IsMessageType(type, "control_msgs", "DynamicJointState");
}

bool IsControllerState(std::string_view type) {
  return IsMessageType(type, "control_msgs", "JointTrajectoryControllerState");
}

void ReadJointState(std::string_view message, JointState* state) {
  CdrReader cdr(message);
  ReadBegin(&cdr, state);
  cdr.Doubles(&state->position);
  cdr.Doubles(&state->velocity);
  cdr.Doubles(&state->effort);
  cdr.End();
  CheckCounts(*state);
}

void ReadDynamicJointState(std::string_view message, JointState* state) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  CdrReader cdr(message);
  ReadBegin(&cdr, state);
  const size_t joints = state->names.size();
  for (auto* values : {&state->position, &state->velocity, &state->effort}) {
    values->assign(joints, kNone);
  }
  const std::uint32_t count = cdr.Length(8);  // at least two lengths each
  if (count != joints) {
    throw CdrError("has " + std::to_string(joints) + " names and values of " +
                   std::to_string(count) + " joints");
  }
  std::vector<std::string_view> interfaces;
  std::vector<double> values;
  for (size_t j = 0; j < joints; ++j) {
    cdr.Texts(&interfaces);
    cdr.Doubles(&values);
    CheckCount(values, interfaces.size(), "interfaces");
    for (size_t k = 0; k < values.size(); ++k) {
      std::vector<double>* const to = ArrayOf(interfaces[k], state);
      if (to != nullptr) (*to)[j] = values[k];
    }
  }
  cdr.End();
}

// What follows differs between distributions of ROS.
void ReadControllerState(std::string_view message, JointState* state) {
  CdrReader cdr(message);
  ReadBegin(&cdr, state);
  std::vector<double> unused, unused_effort;
  ReadPoint(&cdr, &state->reference, &unused, &unused_effort);
  ReadPoint(&cdr, &state->position, &state->velocity, &state->effort);
  CheckCounts(*state);
}

void ReadFloat64MultiArray(std::string_view message,
                           std::vector<double>* values) {
  CdrReader cdr(message);
  for (std::uint32_t left = cdr.Unsigned(); left > 0; --left) {
    cdr.Text();  // label, size and stride of a dimension
    cdr.Unsigned();
    cdr.Unsigned();
  }
  const std::uint32_t offset = cdr.Unsigned();
  cdr.Doubles(values);
  cdr.End();
  if (offset > values->size()) {
    throw CdrError("begins after its " + std::to_string(values->size()) +
                   " values");
  }
  values->erase(values->begin(), values->begin() + offset);
}

}  // namespace armcal

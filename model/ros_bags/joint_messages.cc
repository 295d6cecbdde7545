#include "model/ros_bags/joint_messages.h"

#include <string>

#include "model/ros_bags/cdr_reader.h"

namespace armcal {
namespace {

bool IsType(std::string_view type, std::string_view package,
            std::string_view name) {
  const std::string stem(package), end(name);
  return type == stem + "/msg/" + end || type == stem + "/" + end;
}

void CheckCount(const std::vector<double>& values, size_t names,
                const char* what) {
  if (values.empty() || values.size() == names) return;
  throw CdrError("has " + std::to_string(names) + " names and " +
                 std::to_string(values.size()) + " values of " + what);
}

}  // namespace

bool IsJointState(std::string_view type) {
  return IsType(type, "sensor_msgs", "JointState");
}

bool IsFloat64MultiArray(std::string_view type) {
  return IsType(type, "std_msgs", "Float64MultiArray");
}

void ReadJointState(std::string_view message, JointState* state) {
  constexpr std::int64_t kBillion = 1000000000;
  CdrReader cdr(message);
  const std::int64_t seconds = cdr.Signed();
  const std::uint32_t nanoseconds = cdr.Unsigned();
  if (nanoseconds >= kBillion) {
    throw CdrError("has " + std::to_string(nanoseconds) +
                   " ns in its stamp, expected less than a second");
  }
  state->stamp = seconds * kBillion + nanoseconds;
  cdr.Text();  // the frame
  state->name_bytes = cdr.Texts(&state->names);
  cdr.Doubles(&state->position);
  cdr.Doubles(&state->velocity);
  cdr.Doubles(&state->effort);
  cdr.End();
  CheckCount(state->position, state->names.size(), "position");
  CheckCount(state->velocity, state->names.size(), "velocity");
  CheckCount(state->effort, state->names.size(), "effort");
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

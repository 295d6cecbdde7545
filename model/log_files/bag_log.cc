#include "model/log_files/bag_log.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "model/log_files/columns/wrench_columns.h"
#include "model/ros_bags/cdr_reader.h"
#include "model/ros_bags/open_bag.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "model/text/option_name.h"
#include "model/text/unpack.h"

namespace armcal {
namespace {

constexpr size_t kMostValues = size_t{1} << 30;      // 8 GB
constexpr std::uint64_t kMostMessage = 64ull << 20;  // bytes

// Whether its messages are a JointState's.
bool HasJointNames(const std::string& type) {
  return IsJointState(type) || IsDynamicJointState(type) ||
         IsControllerState(type);
}

bool IsRead(const std::string& type) {
  return HasJointNames(type) || IsFloat64MultiArray(type) ||
         IsWrenchStamped(type);
}

std::string Place(const std::string& topic, long message) {
  return "topic " + topic + ", message " + std::to_string(message);
}

}  // namespace

BagLog::BagLog(const std::string& path, const LineOptions& options)
    : path_(path),
      joint_names_(options.joint_names),
      chosen_(options.topics),
      effort_(options.effort) {
  all_states_ =
      std::all_of(chosen_.begin(), chosen_.end(),
                  [](const LogTopic& t) { return t.signal || t.wrench; });
}

std::vector<BagLog::Field> BagLog::FieldsOf(const Role& role,
                                            const Topic& topic) const {
  const bool has_reference = IsControllerState(topic.about.type);
  if (!role.signal) {
    std::vector<Field> fields = {{Signal::kPosition, &JointState::position},
                                 {Signal::kVelocity, &JointState::velocity},
                                 {effort_, &JointState::effort}};
    if (has_reference) {
      fields.push_back({Signal::kReference, &JointState::reference});
    }
    return fields;
  }
  switch (*role.signal) {
    case Signal::kReference:
      return {{*role.signal,
               has_reference ? &JointState::reference : &JointState::position}};
    case Signal::kPosition:
      return {{*role.signal, &JointState::position}};
    case Signal::kVelocity:
      return {{*role.signal, &JointState::velocity}};
    case Signal::kEffort:
    case Signal::kCurrent:
    case Signal::kVoltage:
      return {{*role.signal, &JointState::effort}};
    default:
      return {};
  }
}

bool BagLog::IsWanted(const BagTopic& about) const {
  return std::any_of(chosen_.begin(), chosen_.end(),
                     [&](const LogTopic& t) { return t.name == about.name; }) ||
         (all_states_ && IsJointState(about.type));
}

BagLog::Topic& BagLog::FindTopic(const BagTopic& about) {
  const auto [at, is_new] = topics_.try_emplace({about.name, about.type});
  Topic& topic = at->second;
  if (!is_new) return topic;
  topic.about = about;
  for (const LogTopic& chosen : chosen_) {
    if (chosen.name == about.name)
      topic.roles.push_back({chosen.signal, chosen.wrench, {}, {}});
  }
  if (topic.roles.empty() && IsWanted(about)) topic.roles.push_back({});
  if (!topic.roles.empty()) CheckTopic(topic);
  return topic;
}

void BagLog::CheckTopic(const Topic& topic) const {
  const std::string place = "topic " + OneLine(topic.about.name),
                    type = OneLine(topic.about.type);
  const bool states = HasJointNames(topic.about.type),
             wrench = IsWrenchStamped(topic.about.type);
  if (!IsRead(topic.about.type)) {
    throw InputError(path_, place, type,
                     "expected sensor_msgs/msg/JointState, "
                     "std_msgs/msg/Float64MultiArray, "
                     "control_msgs/msg/DynamicJointState or "
                     "JointTrajectoryControllerState, or "
                     "geometry_msgs/msg/WrenchStamped");
  }
  for (const Role& role : topic.roles) {
    if (role.wrench != wrench) {
      throw InputError(path_, place, type,
                       wrench ? "is a force-torque sensor's: expected " +
                                    OptionName("topics") +
                                    "=wrench:" + OneLine(topic.about.name)
                              : "expected geometry_msgs/msg/WrenchStamped");
    }
    if (wrench) continue;
    if (states && FieldsOf(role, topic).empty()) {
      throw InputError(path_, place, type,
                       "holds position, velocity and effort alone");
    }
    if (!states && !role.signal) {
      throw InputError(path_, place, type,
                       "expected what it holds before its name, as in " +
                           OptionName("topics") +
                           "=effort:" + OneLine(topic.about.name));
    }
  }
  if (topic.about.encoding == "cdr") return;
  throw InputError(path_, place, OneLine(topic.about.encoding),
                   "expected messages encoded as cdr, as in ROS 2");
}

void BagLog::Read(const std::string& file) {
  const auto bag = OpenBagFile(
      file, [this](const BagTopic& about) { return IsWanted(about); });
  BagMessage message;
  while (bag->Next(&message)) {
    Topic& topic = FindTopic(*message.topic);
    ++topic.messages;
    try {
      Add(message, &topic);
    } catch (const CdrError& error) {
      throw InputError(file, Place(topic.about.name, topic.messages), "",
                       std::string(error.what()) + "; expected a message of " +
                           topic.about.type);
    }
  }
  for (const BagTopic& about : bag->Topics()) FindTopic(about);
}

void BagLog::Add(const BagMessage& packed, Topic* topic) {
  BagMessage message = packed;
  // rosbag2's compression_mode MESSAGE; no CDR begins so.
  if (IsZstd(packed.data)) {
    const std::uint64_t size = SizeOfZstd(packed.data);
    if (size > kMostMessage || !UnpackZstd(packed.data, size, &unpacked_)) {
      throw CdrError("is packed by zstd and damaged");
    }
    message.data = unpacked_;
  }
  if (HasJointNames(topic->about.type)) {
    AddState(message, topic);
  } else if (IsWrenchStamped(topic->about.type)) {
    AddWrench(message, topic);
  } else {
    AddArray(message, topic);
  }
}

void BagLog::ReadState(const BagMessage& message, const Topic& topic) {
  if (IsJointState(topic.about.type)) {
    ReadJointState(message.data, &state_);
  } else if (IsControllerState(topic.about.type)) {
    ReadControllerState(message.data, &state_);
  } else {
    ReadDynamicJointState(message.data, &state_);
  }
}

void BagLog::AddState(const BagMessage& message, Topic* topic) {
  ReadState(message, *topic);
  for (Role& role : topic->roles) {
    const Layout& layout = FindLayout(&role, topic);
    if (layout.series < 0) continue;
    JointSeries& series = series_[layout.series];
    series.times.push_back(state_.stamp);
    series.received.push_back(message.received);
    for (const Field& field : FieldsOf(role, *topic)) {
      const std::vector<double>& values = state_.*field.values;
      for (const int place : layout.places) {
        series.values.push_back(values.empty()
                                    ? std::numeric_limits<double>::quiet_NaN()
                                    : values[place]);
      }
    }
    CheckSize(series);
  }
}

const BagLog::Layout& BagLog::FindLayout(Role* role, Topic* topic) {
  const auto [at, is_new] =
      role->layouts.try_emplace(std::string(state_.name_bytes));
  Layout& layout = at->second;
  if (!is_new) return layout;
  for (const std::string_view name : state_.names) {
    topic->names.insert(OneLine(name));
  }
  std::vector<int> joints;
  for (size_t j = 0; j < joint_names_.size(); ++j) {
    const auto& names = state_.names;
    const auto found = std::find(names.begin(), names.end(), joint_names_[j]);
    if (found == names.end()) continue;
    if (std::find(found + 1, names.end(), joint_names_[j]) != names.end()) {
      throw CdrError("names the joint " + joint_names_[j] + " twice");
    }
    joints.push_back(static_cast<int>(j));
    layout.places.push_back(static_cast<int>(found - names.begin()));
  }
  if (joints.empty()) return layout;
  const auto [series, starts] = role->series.try_emplace(joints);
  if (starts) series->second = StartSeries(*topic, *role, joints, true);
  layout.series = series->second;
  return layout;
}

int BagLog::StartSeries(const Topic& topic, const Role& role,
                        const std::vector<int>& joints, bool has_stamps) {
  JointSeries series;
  series.topic = topic.about.name;
  series.chosen = !!role.signal;
  series.has_stamps = has_stamps;
  if (role.wrench) {
    for (int k = 0; k < kWrenchColumns; ++k) {
      series.channels.push_back({std::nullopt, k});
    }
  } else if (has_stamps) {
    for (const Field& field : FieldsOf(role, topic)) {
      for (const int j : joints) series.channels.push_back({field.signal, j});
    }
  } else {
    for (const int j : joints) series.channels.push_back({*role.signal, j});
  }
  series_.push_back(series);
  return static_cast<int>(series_.size()) - 1;
}

void BagLog::CheckSize(const JointSeries& series) const {
  if (series.values.size() <= kMostValues) return;
  throw InputError(path_, "topic " + OneLine(series.topic), "",
                   "has more than 8 GB of numbers");
}

void BagLog::AddNumbers(const std::vector<int>& joints, std::int64_t stamp,
                        std::int64_t received,
                        const std::vector<double>& values, Topic* topic) {
  for (Role& role : topic->roles) {
    const auto [at, starts] = role.series.try_emplace(joints);
    if (starts) at->second = StartSeries(*topic, role, joints, joints.empty());
    JointSeries& series = series_[at->second];
    series.times.push_back(stamp);
    series.received.push_back(received);
    series.values.insert(series.values.end(), values.begin(), values.end());
    CheckSize(series);
  }
}

// A number per joint, base to tip.
void BagLog::AddArray(const BagMessage& message, Topic* topic) {
  ReadFloat64MultiArray(message.data, &array_);
  if (array_.size() != joint_names_.size()) {
    throw InputError(path_, Place(topic->about.name, topic->messages),
                     std::to_string(array_.size()) + " values",
                     "expected " + std::to_string(joint_names_.size()) +
                         ", one per joint of the robot, base to tip");
  }
  std::vector<int> joints(array_.size());
  std::iota(joints.begin(), joints.end(), 0);
  AddNumbers(joints, message.received, message.received, array_, topic);
}

void BagLog::AddWrench(const BagMessage& message, Topic* topic) {
  ReadWrenchStamped(message.data, &wrench_);
  AddNumbers({}, wrench_.stamp, message.received, wrench_.values, topic);
}

std::vector<JointSeries> BagLog::TakeSeries() {
  for (const LogTopic& chosen : chosen_) {
    const auto at = topics_.lower_bound({chosen.name, ""});
    if (at != topics_.end() && at->first.first == chosen.name) {
      if (!chosen.wrench || at->second.messages > 0) continue;
      throw InputError(path_, "topic " + OneLine(chosen.name), "",
                       "has no messages");
    }
    throw InputError(path_, "topic " + OneLine(chosen.name), "",
                     "is not in the bag; " + Topics());
  }
  for (JointSeries& series : series_) {
    if (series.channels[0].signal) DropEmptyChannels(&series);
  }
  return std::move(series_);
}

std::string BagLog::Topics() const {
  constexpr size_t kMostTopics = 40;
  // Those of types that are read come first, as the list may be cut short.
  std::vector<std::string> list, others;
  for (const auto& [name_and_type, topic] : topics_) {
    const BagTopic& about = topic.about;
    std::string text = OneLine(about.name) + " (" + OneLine(about.type);
    if (!topic.names.empty()) {
      text += " of " + JoinNames({topic.names.begin(), topic.names.end()});
    }
    (IsRead(about.type) ? list : others).push_back(text + ")");
  }
  list.insert(list.end(), others.begin(), others.end());
  std::string text;
  for (size_t k = 0; k < std::min(list.size(), kMostTopics); ++k) {
    text += (k > 0 ? ", " : "") + list[k];
  }
  if (list.size() > kMostTopics) {
    text += " and " + std::to_string(list.size() - kMostTopics) + " more";
  }
  return list.empty() ? "the bag has no topics" : "the bag has " + text;
}

}  // namespace armcal

#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "model/log_files/joint_series.h"
#include "model/log_files/line_source.h"
#include "model/ros_bags/bag_file.h"
#include "model/ros_bags/joint_messages.h"
#include "model/ros_bags/wrench_message.h"

namespace armcal {

// What the messages of a ROS 2 bag say about a robot's joints and its
// force-torque sensor. Messages of one topic that name other joints of the
// robot are a series of their own; those that name none (a gripper's) are left
// out.
class BagLog {
 public:
  // Of `options.topics`; where they are none, or all have a signal of their
  // own or are wrenches, of all other topics of type JointState too; those of
  // ros2_control, which say the same again, have to be named, as do wrenches:
  // of some robots they are estimates, in other axes than a sensor's. Throws
  // InputError, also for a topic that is not there.
  BagLog(const std::string& path, const LineOptions& options);

  // Reads a file of the bag. They come in the order of recording.
  void Read(const std::string& file);
  // After the last file.
  std::vector<JointSeries> TakeSeries();
  // "the bag has /joint_states (sensor_msgs/msg/JointState of a, b)".
  std::string Topics() const;

 private:
  // An array of a message's and what it is taken for.
  struct Field {
    Signal signal;
    std::vector<double> JointState::*values;
  };
  // Where messages with these names in this order go.
  struct Layout {
    int series = -1;          // -1: none of the robot's joints
    std::vector<int> places;  // of the series' joints among the names
  };
  // What one topic's messages are taken for.
  struct Role {
    std::optional<Signal> signal;
    bool wrench = false;
    std::map<std::string, Layout> layouts;   // by the bytes of the names
    std::map<std::vector<int>, int> series;  // by the robot's joints named
  };
  struct Topic {
    BagTopic about;
    std::vector<Role> roles;
    long messages = 0;
    std::set<std::string> names;  // of joints, also not the robot's
  };

  bool IsWanted(const BagTopic& about) const;
  Topic& FindTopic(const BagTopic& about);
  void CheckTopic(const Topic& topic) const;
  void Add(const BagMessage& message, Topic* topic);
  void ReadState(const BagMessage& message, const Topic& topic);
  void AddState(const BagMessage& message, Topic* topic);
  void AddArray(const BagMessage& message, Topic* topic);
  void AddWrench(const BagMessage& message, Topic* topic);
  // Numbers of `joints` (none: of a sensor) at a stamp, to the topic's series.
  void AddNumbers(const std::vector<int>& joints, std::int64_t stamp,
                  std::int64_t received, const std::vector<double>& values,
                  Topic* topic);
  void CheckSize(const JointSeries& series) const;
  const Layout& FindLayout(Role* role, Topic* topic);
  std::vector<Field> FieldsOf(const Role& role, const Topic& topic) const;
  int StartSeries(const Topic& topic, const Role& role,
                  const std::vector<int>& joints, bool has_stamps);

  std::string path_;
  std::vector<std::string> joint_names_;
  std::vector<LogTopic> chosen_;
  bool all_states_ = false;  // JointState of topics not chosen
  Signal effort_;            // what a JointState's effort is
  std::map<std::pair<std::string, std::string>, Topic> topics_;  // name, type
  std::vector<JointSeries> series_;
  JointState state_;
  StampedWrench wrench_;
  std::vector<double> array_;
  std::string unpacked_;
};

}  // namespace armcal

#include "model/log_files/bag_source.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "model/log_files/joint_series.h"
#include "model/log_files/log_reader.h"
#include "model/text/input_error.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::bag_source_test {

// Files by other programs, all of the log in data/log_formats (README.md).
const std::string kFolder = FORMATS_DIR "/";

LogReaderOptions Options(const std::vector<LogTopic>& topics = {}) {
  LogReaderOptions options;
  options.joint_names = {"joint1", "joint2"};
  options.topics = topics;
  return options;
}

std::string Bytes(const std::string& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

std::string Refusal(const std::string& path,
                    const LogReaderOptions& options = Options()) {
  return MessageOf<InputError>(path, [&] { ReadWholeLog(path, options); });
}

std::string RefusalOf(const std::string& name,
                      const std::vector<LogTopic>& topics = {}) {
  return Refusal(kFolder + name, Options(topics));
}

// Whether it is the beginning of the log, to the last bit.
bool Begins(const Log& log) {
  static const Log csv =
      ReadWholeLog(DATA_DIR "/log_formats/log.csv", Options());
  const int n = log.size();
  return n <= csv.size() && log.t == csv.t.head(n) &&
         log.q == csv.q.topRows(n) && log.tau == csv.tau.topRows(n);
}

bool IsWhole(const Log& log) { return log.size() == 101 && Begins(log); }

// In any order of names, with a gripper's messages between.
TEST(BagSource, ReadsWhatOthersWrite) {
  for (const char* name : {"log.db3", "zstd.mcap", "lz4.mcap", "plain.mcap",
                           "big_endian.mcap", "split", "split/split_0.mcap"}) {
    const Log log = ReadWholeLog(kFolder + name, Options());
    EXPECT_EQ(IsWhole(log), name != std::string("split/split_0.mcap")) << name;
  }
}

TEST(BagSource, JoinsTopicsAndUnpacksMessages) {
  for (const char* name : {"packed", "halves.mcap"}) {
    const Log log = ReadWholeLog(kFolder + name, Options());
    EXPECT_TRUE(log.size() == 20 && Begins(log)) << name;
  }
}

TEST(BagSource, TakesSignalsOfOtherTopics) {
  const LogTopic torques{"/torques", Signal::kEffort};
  const std::string path = kFolder + "two_topics.mcap";
  EXPECT_TRUE(IsWhole(ReadWholeLog(path, Options({torques}))));
  EXPECT_TRUE(IsWhole(
      ReadWholeLog(path, Options({{"/joint_states", std::nullopt}, torques}))));
  EXPECT_EQ(ReadWholeLog(path, Options()).tau.norm(), 0);
  EXPECT_FALSE(
      RefusalOf("two_topics.mcap", {{"/torques", std::nullopt}}).empty());
}

// ros2_control's own messages, where they are named.
TEST(BagSource, ReadsStatesOfControllers) {
  const std::string controller = "/arm_controller/controller_state";
  const auto read = [](const std::vector<LogTopic>& topics) {
    LogReaderOptions options = Options(topics);
    options.want_reference = options.want_velocity = true;
    const Log log = ReadWholeLog(kFolder + "ros2_control.mcap", options);
    EXPECT_TRUE(log.size() == 20 && Begins(log));
    return log;
  };
  EXPECT_EQ(read({}).qref.size(), 0);
  const Log state = read({{controller, std::nullopt}});
  ASSERT_EQ(state.qref.size(), state.q.size());
  EXPECT_EQ(state.qref, Eigen::MatrixXd(state.q.array() + .125));
  ASSERT_EQ(state.qd.size(), state.q.size());
  EXPECT_TRUE((state.qd.array() == 2).all());
  const Log both =
      read({{"/joint_states", std::nullopt}, {controller, Signal::kReference}});
  ASSERT_EQ(both.qref.size(), state.qref.size());
  EXPECT_EQ(both.qref, state.qref);
  EXPECT_EQ(both.qd.size(), 0);
  read({{"/dynamic_joint_states", std::nullopt}});
}

// Its stamps lie between those of the joints; tests/write_bags.py has the law.
TEST(BagSource, ReadsAForceTorqueSensorThatIsNamed) {
  const std::string path = kFolder + "wrench.mcap";
  const LogTopic sensor{"/ft", std::nullopt, true};
  LogReaderOptions options = Options({sensor});
  options.want_wrench = true;
  const Log log = ReadWholeLog(path, options);
  ASSERT_TRUE(log.size() == 20 && Begins(log));
  ASSERT_EQ(log.wrench.cols(), 6);
  for (int k = 0; k < log.size(); ++k) {
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(log.wrench(k, c), 10 * c + k, 1e-9);
  }
  options.topics = {{"/joint_states", std::nullopt}, sensor};
  EXPECT_EQ(ReadWholeLog(path, options).wrench, log.wrench);
  // Of some robots a wrench is an estimate, in other axes.
  options.topics = {};
  EXPECT_EQ(ReadWholeLog(path, options).wrench.size(), 0);
}

TEST(BagSource, SaysWhichForceTorqueSensorIsWrong) {
  const LogTopic sensor{"/ft", std::nullopt, true},
      other{"/external", std::nullopt, true};
  EXPECT_EQ(RefusalOf("wrench.mcap", {sensor, other}),
            "FILE: the force-torque sensor is in /ft and in /external: choose "
            "one by `topics`=wrench:/ft");
  EXPECT_EQ(RefusalOf("wrench.mcap", {{"/ft", std::nullopt}}),
            "FILE: topic /ft: found 'geometry_msgs/msg/WrenchStamped': is a "
            "force-torque sensor's: expected `topics`=wrench:/ft");
  EXPECT_EQ(RefusalOf("wrench.mcap", {{"/joint_states", std::nullopt, true}}),
            "FILE: topic /joint_states: found 'sensor_msgs/msg/JointState': "
            "expected geometry_msgs/msg/WrenchStamped");
}

TEST(BagSource, LeavesNothingBesideABag) {
  const std::string path =
      WriteFile(Bytes(kFolder + "log.db3"), "50%3f #?immutable=0.db3");
  EXPECT_TRUE(IsWhole(ReadWholeLog(path, Options())));
  EXPECT_FALSE(std::ifstream(path + "-shm").good());
}

// UR's driver reports currents as efforts.
TEST(BagSource, TakesEffortsAsCurrents) {
  LogReaderOptions options = Options();
  options.torque_kind = TorqueKind::kCurrent;
  options.torque_constants = {2, 4};
  const Log log = ReadWholeLog(kFolder + "zstd.mcap", options);
  const Log torques = ReadWholeLog(kFolder + "zstd.mcap", Options());
  EXPECT_EQ(log.tau.col(0), 2 * torques.tau.col(0));
  EXPECT_EQ(log.tau.col(1), 4 * torques.tau.col(1));
  options = Options(
      {{"/joint_states", std::nullopt}, {"/joint_states", Signal::kCurrent}});
  options.torque_kind = TorqueKind::kCommand;
  EXPECT_TRUE(IsWhole(ReadWholeLog(kFolder + "zstd.mcap", options)));
}

TEST(BagSource, SaysWhatIsWrong) {
  const std::string has =
      "the bag has /joint_states (sensor_msgs/msg/JointState of joint1, "
      "joint2)";
  const std::string no_effort =
      "FILE: row 1: no torque: missing tau1 or joint1/effort, tau2 or "
      "joint2/effort; or currents (i1 or joint1/current, ..) or "
      "voltages (u1, ..) with `torque_constants`; " +
      has + "; the effort of joint1, joint2 is empty or NaN in all messages";
  EXPECT_EQ(RefusalOf("nan_effort.mcap"), no_effort);
  EXPECT_EQ(RefusalOf("empty_effort.mcap"), no_effort);
  EXPECT_EQ(RefusalOf("one_nan.mcap"),
            "FILE: row 7, column tau1: found 'nan': expected a finite number");
  EXPECT_EQ(RefusalOf("short_message.mcap"),
            "FILE: topic /joint_states, message 8: says that 2 numbers follow, "
            "and 8 bytes do; expected a message of sensor_msgs/msg/JointState");
  EXPECT_EQ(RefusalOf("odd_type.mcap"),
            "FILE: no message gives the position of joint1, joint2; the bag "
            "has /joint_states (std_msgs/msg/Float32MultiArray)");
  EXPECT_EQ(RefusalOf("odd_type.mcap", {{"/joint_states", std::nullopt}}),
            "FILE: topic /joint_states: found "
            "'std_msgs/msg/Float32MultiArray': expected "
            "sensor_msgs/msg/JointState, std_msgs/msg/Float64MultiArray, "
            "control_msgs/msg/DynamicJointState or "
            "JointTrajectoryControllerState, or "
            "geometry_msgs/msg/WrenchStamped");
  EXPECT_EQ(RefusalOf("json.mcap"),
            "FILE: topic /joint_states: found 'json': expected messages "
            "encoded as cdr, as in ROS 2");
  EXPECT_EQ(RefusalOf("no_stamps.mcap"),
            "FILE: topic /joint_states: the stamps in the headers are all 0: "
            "expected times");
  EXPECT_EQ(RefusalOf("two_arms.mcap"),
            "FILE: the position of joint joint1 is in /joint_states and in "
            "/simulated/joint_states: choose one by `topics`=/joint_states");
  EXPECT_EQ(RefusalOf("two_arms.mcap", {{"/joint_states", std::nullopt}}), "");
  EXPECT_EQ(RefusalOf("two_arms.mcap", {{"/left", std::nullopt}}),
            "FILE: topic /left: is not in the bag; the bag has /joint_states "
            "(sensor_msgs/msg/JointState), /simulated/joint_states "
            "(sensor_msgs/msg/JointState)");
}

// With all their names, however long the line.
TEST(BagSource, RefusesOtherRobots) {
  LogReaderOptions options = Options();
  options.joint_names = {"joint1", "wrist"};
  EXPECT_EQ(Refusal(kFolder + "lz4.mcap", options),
            "FILE: no message gives the position of wrist; the bag has "
            "/joint_states (sensor_msgs/msg/JointState of joint1, joint2)");
  EXPECT_EQ(RefusalOf("long_names.mcap"),
            "FILE: no message gives the position of joint1, joint2; the bag "
            "has /joint_states (sensor_msgs/msg/JointState of "
            "elbow_of_the_left_arm_joint, shoulder_of_the_left_arm_joint, "
            "wrist_of_the_left_arm_joint)");
}

// Before the end of the data nothing may pass for a shorter log.
TEST(BagSource, RefusesBagsThatAreCutOff) {
  for (const char* name : {"zstd.mcap", "plain.mcap", "log.db3"}) {
    const std::string whole = Bytes(kFolder + name);
    for (size_t size = whole.size() / 2; size > 8; size -= size / 5) {
      const std::string path = WriteFile(whole.substr(0, size), name);
      EXPECT_NE(Refusal(path), "") << name << " " << size;
    }
  }
  const std::string path =
      WriteFile(Bytes(kFolder + "zstd.mcap").substr(0, 3000), "cut.mcap");
  EXPECT_EQ(Refusal(path).substr(0, 11), "FILE: byte ");
  EXPECT_NE(Refusal(path).find("is cut off; `mcap recover`"),
            std::string::npos);
}

TEST(BagSource, NoticesEveryDamagedByteOfAChunk) {
  const std::string whole = Bytes(kFolder + "zstd.mcap");
  for (size_t at = 200; at < 2000; at += 37) {
    std::string damaged = whole;
    damaged[at] ^= 0x10;
    const std::string path = WriteFile(damaged, "damaged.mcap");
    if (Refusal(path).empty()) {
      EXPECT_TRUE(IsWhole(ReadWholeLog(path, Options()))) << at;
    }
  }
}

TEST(BagSource, TellsBagsThatItDoesNotRead) {
  EXPECT_NE(Refusal(WriteFile("#ROSBAG V2.0\n")).find("is a bag of ROS 1"),
            std::string::npos);
  EXPECT_NE(Refusal(WriteFile("\x28\xb5\x2f\xfd")).find("unzstd"),
            std::string::npos);
  EXPECT_NE(Refusal(DATA_DIR).find("is a folder without a bag"),
            std::string::npos);
}

TEST(JointSeries, LiesOnTheLineBetweenMessages) {
  JointSeries series;
  series.channels = {{Signal::kEffort, 0}, {Signal::kEffort, 1}};
  series.times = {0, 10, 20, 30, 40, 50, 60, 200};
  for (int k = 0; k < 8; ++k) {
    series.values.push_back(k * k);
    series.values.push_back(-k);
  }
  JointSeriesAt at("log", series);
  ASSERT_TRUE(at.Find(25));
  EXPECT_EQ(at.value(0), 6.5);
  EXPECT_EQ(at.value(1), -2.5);
  ASSERT_TRUE(at.Find(30));
  EXPECT_EQ(at.value(0), 9);
  ASSERT_TRUE(at.Find(200));
  EXPECT_EQ(at.value(0), 49);
  EXPECT_FALSE(at.Find(-1));
  EXPECT_FALSE(at.Find(201));
  EXPECT_FALSE(at.Find(100));  // 140 > 3 x 200/7
}

}  // namespace armcal::bag_source_test

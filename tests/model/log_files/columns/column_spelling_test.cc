#include "model/log_files/columns/column_spelling.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace armcal::column_spelling_test {

std::string Spelled(const std::vector<std::string>& names,
                    const std::vector<std::string>& joints = {"shoulder_joint",
                                                              "elbow"}) {
  std::string text;
  for (const std::string& name : SpelledOut(names, joints)) {
    text += (text.empty() ? "" : ",") + name;
  }
  return text;
}

TEST(ColumnSpelling, WordsInAnyCaseWithAnythingBetween) {
  EXPECT_EQ(Spelled({"Time (s)", "Joint 1 Position (deg)", "joint_2.pos"}),
            "t [s],q1 [deg],q2");
  EXPECT_EQ(Spelled({"TIME", "dq_1", "joint1-velocity [rad/s]", "qdd[1]"}),
            "t,qd1,qd1 [rad/s],qdd1");
  EXPECT_EQ(Spelled({"seconds", "actual_current_1", "Torque2 [N.m]"}),
            "t,i1,tau2 [Nm]");
  EXPECT_EQ(Spelled({"timestamp_ns", "position_1_deg", "effort_2_Nm"}),
            "t [ns],q1 [deg],tau2 [Nm]");
}

TEST(ColumnSpelling, ByJointNamesWithoutAPath) {
  EXPECT_EQ(Spelled({"shoulder_joint_position", "elbow.effort",
                     "velocity elbow", "/js/shoulder_joint/effort"}),
            "q1,tau2,qd2,/js/shoulder_joint/effort");
}

// The file calls the joints "shoulder_joint" and "elbow", the log's arm has a
// name as well.
TEST(ColumnSpelling, ANamespaceBeforeAllJoints) {
  EXPECT_EQ(Spelled({"stamp", "left_shoulder_joint.position",
                     "left_elbow.position", "left_elbow.effort"}),
            "t,q1,q2,tau2");
  EXPECT_EQ(Spelled({"/js/a7_shoulder_joint/velocity",
                     "/js/a7_shoulder_joint/position",
                     "/js/a7_elbow/position [deg]"}),
            "qd1,q1,q2 [deg]");
  // One joint has none, two arms, a joint without a namespace, and what is
  // another quantity than the joint's own.
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"left_elbow.position", "left_elbow.effort"},
        {"left_elbow.position", "left_shoulder_joint.position",
         "right_elbow.position", "right_shoulder_joint.position"},
        {"motor_elbow.position", "motor_shoulder_joint.position"}}) {
    std::string same;
    for (const std::string& name : names) same += "," + name;
    EXPECT_EQ(Spelled(names), same.substr(1));
  }
  EXPECT_EQ(Spelled({"elbow.position", "shoulder_joint.position",
                     "raw_elbow.position", "raw_shoulder_joint.position"}),
            "q2,q1,raw_elbow.position,raw_shoulder_joint.position");
}

TEST(ColumnSpelling, CountsFromZeroWhereAllDo) {
  EXPECT_EQ(Spelled({"q0", "q1", "tau0", "tau1"}), "q1,q2,tau1,tau2");
  EXPECT_EQ(Spelled({"field.position0", "field.position1", "field.effort0"}),
            "q1,q2,tau1");
  EXPECT_EQ(Spelled({"q[0]", "q[1]", "tau_J[0]", "q_d[0]"}),
            "q1,q2,tau1,qref1");
  // Positions from 0 and torques from 1: nobody knows.
  EXPECT_EQ(Spelled({"q_0", "q_1", "tau_1", "tau_2"}), "q0,q1,tau1,tau2");
}

TEST(ColumnSpelling, RostopicWritesNanoseconds) {
  EXPECT_EQ(Spelled({"%time", "field.velocity1"}), "t [ns],qd1");
}

TEST(ColumnSpelling, OneJointNeedsNoNumber) {
  EXPECT_EQ(Spelled({"time", "position", "torque"}, {"pivot"}), "t,q1,tau1");
  EXPECT_EQ(Spelled({"time", "position", "torque"}), "t,position,torque");
}

// What is not certain to be a signal, or of which joint it is.
TEST(ColumnSpelling, LeavesWhatItDoesNotUnderstand) {
  for (const char* name :
       {"tau_ext_1", "motor_position_1", "position", "q1_error", "q_1_2",
        "torque_command_1", "joint1", "target_moment_0", "pos_1234567",
        "q_1 [turns]", ""}) {
    EXPECT_EQ(Spelled({name}), name);
  }
}

}  // namespace armcal::column_spelling_test

#include "model/log_files/columns/log_columns.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/text/input_error.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::log_columns_test {

const std::vector<std::string> kJoints = {"shoulder", "elbow"};

// "3 1*0.001": index and scale of each joint's column, or why there is none.
std::string Find(const std::string& header, Signal signal = Signal::kPosition,
                 const std::vector<std::string>& joints = kJoints) {
  std::string found;
  const std::string refusal = MessageOf<InputError>("log.csv", [&] {
    for (const LogColumn& column :
         LogColumns("log.csv", header, joints).Find(signal)) {
      found += (found.empty() ? "" : " ") + std::to_string(column.index);
      if (column.scale != 1) found += "*" + std::to_string(column.scale);
    }
  });
  return found + refusal;
}

std::string FindTime(const std::string& header) {
  std::string found;
  const std::string refusal = MessageOf<InputError>("log.csv", [&] {
    int decimals = -1;
    const int index =
        LogColumns("log.csv", header, kJoints).FindTime(&decimals);
    found = std::to_string(index) + " 1e-" + std::to_string(decimals) + " s";
  });
  return found + refusal;
}

TEST(LogColumns, MatchesByNumberAndByName) {
  EXPECT_EQ(Find("t,q1,q2"), "1 2");
  EXPECT_EQ(Find("q2,x,t,qd1,q1"), "4 0");
  EXPECT_EQ(Find("t,elbow/position,shoulder/position"), "2 1");
  EXPECT_EQ(Find("t,/joint_states/shoulder/position,/a/b/elbow/position"),
            "1 2");
  EXPECT_EQ(Find("t,q1,elbow/position"), "1 2");
  EXPECT_EQ(Find("t,left_shoulder/position,q1,q2"), "2 3");
  EXPECT_EQ(Find("t,position[1],position[2],q1,q2"), "3 4");
  EXPECT_EQ(Find("t,qd1,qd2", Signal::kVelocity), "1 2");
  EXPECT_EQ(Find("t,qdd1,qdd2", Signal::kAcceleration), "1 2");
  EXPECT_EQ(Find("t,tau1,tau2", Signal::kEffort), "1 2");
  EXPECT_EQ(Find("t,i1,i2", Signal::kCurrent), "1 2");
  EXPECT_EQ(Find("t,shoulder/velocity,elbow/velocity", Signal::kVelocity),
            "1 2");
  EXPECT_EQ(Find("t,shoulder/current,elbow/effort [A]", Signal::kCurrent),
            "1 2");
}

TEST(LogColumns, ALongerJointNameWins) {
  EXPECT_EQ(Find("t,right/elbow/position,left/elbow/position",
                 Signal::kPosition, {"elbow", "left/elbow"}),
            "1 2");
}

TEST(LogColumns, TakesTheUsualSeparatorsAndDress) {
  EXPECT_EQ(Find("t;q1;q2"), "1 2");
  EXPECT_EQ(Find("t\tq1\tq2"), "1 2");
  EXPECT_EQ(Find("t;q1;q2;note, of the day"), "1 2");
  EXPECT_EQ(Find(" t , q1 , q2 [rad] "), "1 2");
  EXPECT_EQ(Find("\"t\",\"q1\",\"q2\""), "1 2");
  EXPECT_EQ(Find("# t,q1,q2"), "1 2");
  EXPECT_EQ(FindTime("# t,q1,q2"), "0 1e-0 s");
  EXPECT_EQ(Find("t,q1,q2,"), "1 2");
}

TEST(LogColumns, ConvertsUnits) {
  EXPECT_EQ(Find("t,q1[deg],q2 [ mm ]"), "1*0.017453 2*0.001000");
  EXPECT_EQ(Find("t,qd1 [deg/s],qd2 [m/s]", Signal::kVelocity), "1*0.017453 2");
  EXPECT_EQ(Find("t,shoulder/effort[mNm],tau2[kNm]", Signal::kEffort),
            "1*0.001000 2*1000.000000");
  EXPECT_EQ(Find("t,i1 [mA],i2 [A]", Signal::kCurrent), "1*0.001000 2");
  EXPECT_EQ(FindTime("q1,q2,time"), "2 1e-0 s");
  EXPECT_EQ(FindTime("timestamp [ns],q1,q2"), "0 1e-9 s");
  EXPECT_EQ(FindTime("__time[us],q1,q2"), "0 1e-6 s");
  EXPECT_EQ(FindTime("t [ms],q1,q2"), "0 1e-3 s");
}

TEST(LogColumns, SaysWhatTheLogHolds) {
  const LogColumns columns("log.csv", "t,q1,q2,qd1,tau2", kJoints);
  EXPECT_TRUE(columns.HasAll(Signal::kPosition));
  EXPECT_TRUE(columns.HasAny(Signal::kVelocity));
  EXPECT_FALSE(columns.HasAll(Signal::kVelocity));
  EXPECT_FALSE(columns.HasAny(Signal::kCurrent));
  EXPECT_EQ(columns.Missing(Signal::kEffort), "tau1 or shoulder/effort");
  EXPECT_EQ(columns.size(), 5);
  EXPECT_EQ(columns.separator(), ',');
}

struct BadHeader {
  const char* header;
  const char* message;
};

TEST(LogColumns, RefusesWrongColumns) {
  const BadHeader cases[] = {
      {"t,q1,qd1,Q2,pos 2",
       "two columns for the position of joint elbow, 'Q2' and 'pos 2'; rename "
       "one"},
      {"t,q1,qd1,Q3,pos x",
       "missing q2 or elbow/position; the robot has 2 joints, the log holds "
       "q1; not recognised: 'Q3', 'pos x'"},
      {"t,a,b,c,d,e,f,g,h",
       "missing q1 or shoulder/position, q2 or elbow/position; the robot has 2 "
       "joints, the log holds 0 such columns; not recognised: 'a', 'b', 'c', "
       "'d', 'e', 'f', 2 more"},
      {"t,shoulder/position",
       "missing q2 or elbow/position; the robot has 2 joints, the log holds 1 "
       "such columns"},
      {"t,q1,q2,q3",
       "wrong number of joints: the robot has 2 joints, the log holds q1..q3"},
      {"t,q1,q5",
       "wrong number of joints: the robot has 2 joints, the log holds q1, q5"},
      {"t,q0,q1,q2",
       "joints are numbered from 1; the robot has 2 joints, the log holds "
       "q0..q2"},
      {"t,q1,q2,q1",
       "two columns for the position of joint shoulder, 'q1' and 'q1'; rename "
       "one"},
      {"t,q1,q2,elbow/position",
       "two columns for the position of joint elbow, 'q2' and "
       "'elbow/position'; rename one"},
      {"t,q1,/is/elbow/position,/should/elbow/position",
       "two columns for the position of joint elbow, '/is/elbow/position' and "
       "'/should/elbow/position'; rename one"},
      {"t,q1 [grad],q2",
       "column 'q1 [grad]': expected a unit of rad, deg, m, mm"},
      {"0.0,1.5,-2e3",
       "expected a header that names the columns, as in t,q1,tau1"},
      {"t|q1|q2",
       "expected several columns separated by , ; or TAB, found 't|q1|q2'"},
      {"t,q1,q2\r0,0,0\r",
       "the lines end in CR alone; save the file with LF or CRLF"},
  };
  for (const BadHeader& bad : cases) {
    EXPECT_EQ(Find(bad.header), std::string("FILE: row 1: ") + bad.message);
  }
}

TEST(LogColumns, SpacesSeparateWhereNothingElseDoes) {
  EXPECT_EQ(Find("t q1 q2"), "1 2");
  EXPECT_EQ(Find("# t q1 q2"), "1 2");  // numpy.savetxt
  EXPECT_EQ(Find("t,q1 [deg],q2 [rad]"), "1*0.017453 2");
}

// Headers as these recorders write them, for a robot of two joints.
TEST(LogColumns, ReadsRobotMakersRecorders) {
  const std::string ur =
      "timestamp target_q_0 target_q_1 actual_q_0 actual_q_1 actual_qd_0 "
      "actual_qd_1 actual_current_0 actual_current_1 actual_TCP_pose_0 "
      "joint_temperatures_0 joint_temperatures_1 actual_current_as_torque_0 "
      "actual_current_as_torque_1";
  EXPECT_EQ(FindTime(ur), "0 1e-0 s");
  EXPECT_EQ(Find(ur), "3 4");
  EXPECT_EQ(Find(ur, Signal::kReference), "1 2");
  EXPECT_EQ(Find(ur, Signal::kVelocity), "5 6");
  EXPECT_EQ(Find(ur, Signal::kCurrent), "7 8");
  EXPECT_EQ(Find(ur, Signal::kEffort), "12 13");
  EXPECT_EQ(Find(ur, Signal::kTemperature), "10 11");
  const std::string franka =
      "time,success_rate,state.q[0],state.q[1],state.q_d[0],state.q_d[1],"
      "state.dq[0],state.dq[1],state.tau_J[0],state.tau_J[1],"
      "state.tau_ext_hat_filtered[0],state.tau_ext_hat_filtered[1],cmd.q_d[0],"
      "cmd.q_d[1],cmd.tau_J_d[0],cmd.tau_J_d[1]";
  EXPECT_EQ(FindTime(franka), "0 1e-3 s");
  EXPECT_EQ(Find(franka), "2 3");
  EXPECT_EQ(Find(franka, Signal::kReference), "4 5");
  EXPECT_EQ(Find(franka, Signal::kVelocity), "6 7");
  EXPECT_EQ(Find(franka, Signal::kEffort), "8 9");
  const std::string older =
      "duration, success rate, q[0], q[1],q_d[0], q_d[1],dq[0], dq[1],"
      "tau_J[0], tau_J[1],sent commands,q_d[0], q_d[1]";
  EXPECT_EQ(FindTime(older), "0 1e-3 s");
  EXPECT_EQ(Find(older), "2 3");
  EXPECT_EQ(Find(older, Signal::kReference), "4 5");
  EXPECT_EQ(Find(older, Signal::kEffort), "8 9");
  EXPECT_EQ(Find("time,state.q[0],state.q[1],state.q[2]"),
            "FILE: row 1: wrong number of joints: the robot has 2 joints, the "
            "log holds q1..q3");
}

TEST(LogColumns, ReadsOtherSpellingsWhereItsOwnAreNotThere) {
  const std::string header =
      "Time [ms],pos_0 [deg],pos_1 [deg],torque_0,torque_1,note";
  EXPECT_EQ(FindTime(header), "0 1e-3 s");
  EXPECT_EQ(Find(header), "1*0.017453 2*0.017453");
  EXPECT_EQ(Find(header, Signal::kEffort), "3 4");
  EXPECT_EQ(LogColumns("FILE", header, {"shoulder", "elbow"}).Spelling(),
            "q is pos_0 [deg] to pos_1 [deg], tau is torque_0 to torque_1");
  // Positions in its own names, torques not.
  EXPECT_EQ(Find("t,q1,q2,tau_J1,tau_J2", Signal::kEffort), "3 4");
  EXPECT_EQ(Find("t,q1,q2,tau_J0,tau_J1", Signal::kEffort).substr(0, 12),
            "FILE: row 1:");
  // Its own names alone are looked at where they are there.
  EXPECT_EQ(Find("t,q1,q2,tau1,tau2,pos_1,pos_2,vel_1"), "1 2");
  EXPECT_EQ(LogColumns("FILE", "t,q1,q2", {"shoulder", "elbow"}).Spelling(),
            "");
}

TEST(LogColumns, RefusesWrongTime) {
  EXPECT_EQ(FindTime("clock,q1,q2"),
            "FILE: row 1: no time column: expected t, time, timestamp or "
            "__time; not recognised: 'clock'");
  EXPECT_EQ(FindTime("t,time,q1,q2"),
            "FILE: row 1: two time columns, 't' and 'time'; rename one");
  EXPECT_EQ(FindTime("t [h],q1,q2"),
            "FILE: row 1: column 't [h]': expected a unit of s, ms, us or ns");
}

TEST(LogColumns, NamesAllMissingOfASevenJointRobot) {
  EXPECT_EQ(Find("t,q1,q2,q3,q4,q5,q6", Signal::kPosition,
                 {"a", "b", "c", "d", "e", "f", "g"}),
            "FILE: row 1: missing q7 or g/position; the robot has 7 joints, "
            "the log holds q1..q6");
}

TEST(LogColumns, WhatIsNotAskedForMayBeWrong) {
  EXPECT_EQ(Find("t,q1,q2,qd1,qd1,tau7,i1 [V],,"), "1 2");
}

}  // namespace armcal::log_columns_test

#include "model/log_files/log_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "model/text/input_error.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::log_reader_test {

LogReaderOptions TwoJoints() {
  LogReaderOptions options;
  options.joint_names = {"shoulder", "elbow"};
  options.need_torque = false;
  return options;
}

LogReaderOptions Everything() {
  LogReaderOptions options = TwoJoints();
  options.need_torque = options.want_velocity = options.want_acceleration =
      true;
  return options;
}

Log ReadAll(LogReader* reader, int max_rows = 100000) {
  Log all, part;
  while (reader->Read(max_rows, &part)) {
    if (all.size() == 0) {
      all = part;
      continue;
    }
    EXPECT_EQ(part.first_row, all.first_row + all.size());
    const auto append = [](const auto& from, auto* to) {
      to->conservativeResize(to->rows() + from.rows(), from.cols());
      to->bottomRows(from.rows()) = from;
    };
    append(part.t, &all.t);
    append(part.q, &all.q);
    append(part.qd, &all.qd);
    append(part.qdd, &all.qdd);
    append(part.tau, &all.tau);
  }
  EXPECT_EQ(part.size(), 0);
  return all;
}

Log ReadText(const std::string& text,
             const LogReaderOptions& options = TwoJoints()) {
  LogReader reader(WriteFile(text), options);
  return ReadAll(&reader);
}

void ExpectSame(const Log& a, const Log& b) {
  EXPECT_EQ(a.first_row, b.first_row);
  EXPECT_EQ(a.t, b.t);
  EXPECT_EQ(a.q, b.q);
  EXPECT_EQ(a.qd, b.qd);
  EXPECT_EQ(a.qdd, b.qdd);
  EXPECT_EQ(a.tau, b.tau);
}

std::string RandomLog(int rows) {
  std::mt19937 generator(7);
  std::normal_distribution<double> number;
  std::string text = "tau1,x,q2,qdd1,time,qd1,qdd2,q1,note,tau2,qd2\n";
  char row[400];
  const auto n = [&] { return number(generator); };
  for (int i = 0; i < rows; ++i) {
    std::snprintf(
        row, sizeof(row),
        "%.17g,,%.9g,%g,17000%05d.%03d,%.3e,%g,%.12f,it's \"on\",%g,%g\n", n(),
        n(), n(), i / 1000, i % 1000, n(), n(), n(), n(), n());
    text += row;
  }
  return text;
}

TEST(LogReader, ReadsEverySignal) {
  const Log log = ReadText(
      "t,q1,q2,qd1,qd2,qdd1,qdd2,tau1,tau2\n"
      "10,1,2,3,4,5,6,7,8\n"
      "10.5,-1,-2,-3,-4,-5,-6,-7,-8e2\n",
      Everything());
  ASSERT_EQ(log.size(), 2);
  EXPECT_EQ(log.first_row, 2);
  EXPECT_EQ(log.t, Eigen::Vector2d(0, 0.5));
  EXPECT_EQ(log.q, (Eigen::Matrix2d() << 1, 2, -1, -2).finished());
  EXPECT_EQ(log.qd, (Eigen::Matrix2d() << 3, 4, -3, -4).finished());
  EXPECT_EQ(log.qdd, (Eigen::Matrix2d() << 5, 6, -5, -6).finished());
  EXPECT_EQ(log.tau, (Eigen::Matrix2d() << 7, 8, -7, -800).finished());
}

TEST(LogReader, TheLengthOfTheBlocksAndGzipChangeNothing) {
  const std::string text = RandomLog(3000);
  LogReader reader(WriteFile(text), Everything());
  const Log log = ReadAll(&reader);
  ASSERT_EQ(log.size(), 3000);
  EXPECT_EQ(log.t(2999), 2.999);
  LogReader gz(WriteFile(Gzip(text), "log.gz"), Everything());
  for (int max_rows : {1, 7, 100000}) {
    reader.Rewind();
    ExpectSame(ReadAll(&reader, max_rows), log);
    gz.Rewind();
    ExpectSame(ReadAll(&gz, max_rows), log);
  }
}

TEST(LogReader, RewindsFromTheMiddle) {
  LogReader reader(WriteFile("t,q1,q2\n5,1,2\n6,3,4\n7,5,6\n"), TwoJoints());
  Log log;
  ASSERT_TRUE(reader.Read(2, &log));
  reader.Rewind();
  ASSERT_TRUE(reader.Read(2, &log));
  EXPECT_EQ(log.first_row, 2);
  EXPECT_EQ(log.t, Eigen::Vector2d(0, 1));
  ASSERT_TRUE(reader.Read(2, &log));
  EXPECT_EQ(log.first_row, 4);
  EXPECT_EQ(log.t(0), 2);
  EXPECT_FALSE(reader.Read(2, &log));
  EXPECT_FALSE(reader.Read(2, &log));
}

TEST(LogReader, TakesNumbersAsPeopleWriteThem) {
  const Log log = ReadText(
      "\xef\xbb\xbft;q1;q2;note\r\n"
      " +0 ; +1.5;-2e+1 ;1,5\r\n"
      "1e-1;.5;5.;nan\r\n"
      "0.1;-0;1e-400;\r\n"
      "  \r\n\r\n");
  EXPECT_EQ(log.t, Eigen::Vector3d(0, 0.1, 0.1));  // equal times pass
  EXPECT_EQ(log.q.col(0), Eigen::Vector3d(1.5, 0.5, 0));
  EXPECT_EQ(log.q.col(1), Eigen::Vector3d(-20, 5, 0));
}

TEST(LogReader, ConvertsUnits) {
  LogReaderOptions options = Everything();
  options.torque_constants = {10, 20};
  options.gear_ratios = {1, 3};
  LogReader reader(WriteFile("timestamp [us],q1 [deg],q2 [mm],"
                             "shoulder/velocity[deg/s],qd2[rad/s],i1,i2[mA]\n"
                             "0,180,1000,90,1,1,1000\n"
                             "250,0,1,0,0,0,0\n"),
                   options);
  EXPECT_EQ(reader.torque_source(),
            "currents times 10 20 N m/A times gear ratios 1 3");
  EXPECT_TRUE(reader.has_velocity());
  EXPECT_FALSE(reader.has_acceleration());
  const Log log = ReadAll(&reader);
  EXPECT_EQ(log.t, Eigen::Vector2d(0, 0.00025));
  EXPECT_DOUBLE_EQ(log.q(0, 0), M_PI);
  EXPECT_DOUBLE_EQ(log.q(0, 1), 1);
  EXPECT_DOUBLE_EQ(log.qd(0, 0), M_PI / 2);
  EXPECT_EQ(log.qdd.size(), 0);
  EXPECT_DOUBLE_EQ(log.tau(0, 0), 10);
  EXPECT_DOUBLE_EQ(log.tau(0, 1), 60);
}

TEST(LogReader, KeepsEpochTimes) {
  const std::string seconds =
      "t,q1,q2\n1700000000.123456789,0,0\n1700000000.123456790,0,0\n";
  EXPECT_EQ(ReadText(seconds).t, Eigen::Vector2d(0, 1e-9));
  const std::string nanoseconds =
      "t[ns],q1,q2\n1700000000123456789,0,0\n1700000000123456790,0,0\n";
  EXPECT_EQ(ReadText(nanoseconds).t, Eigen::Vector2d(0, 1e-9));
}

TEST(LogReader, LooksOnlyAtWhatIsWanted) {
  const std::string path =
      WriteFile("t,q1,q2,qd1,qd2,tau1,tau2\n0,1,2,nan,x,,inf\n");
  LogReader reader(path, TwoJoints());
  const Log log = ReadAll(&reader);
  EXPECT_EQ(log.size(), 1);
  EXPECT_EQ(log.qd.size() + log.qdd.size() + log.tau.size(), 0);
  EXPECT_EQ(reader.torque_source(), "");
  EXPECT_TRUE(reader.has_velocity());
  LogReaderOptions velocity = TwoJoints();
  velocity.want_velocity = true;
  EXPECT_EQ(MessageOf<InputError>(path,
                                  [&] {
                                    LogReader wanting(path, velocity);
                                    ReadAll(&wanting);
                                  }),
            "FILE: row 2, column qd1: found 'nan': expected a finite number");
}

// Commands stand in for torques where there are none, not where some miss.
TEST(LogReader, CommandsDoWhereThereIsNoTorque) {
  LogReaderOptions options = TwoJoints();
  options.need_torque = options.commands_do = true;
  const auto read = [&options](const std::string& text) {
    return ReadWholeLog(WriteFile(text, "commanded.csv"), options);
  };
  Log log = read("t,q1,q2,qref1,qref2\n0,1,2,3,4\n");
  EXPECT_EQ(log.qref(0, 1), 4);
  EXPECT_EQ(log.tau.size(), 0);
  log = read("t,q1,q2,i1,i2,qref1,qref2\n0,1,2,5,6,3,4\n");
  EXPECT_EQ(log.tau.size(), 0);
  log = read("t,q1,q2,tau1,tau2,qref1,qref2\n0,1,2,5,6,3,4\n");
  EXPECT_EQ(log.tau(0, 1), 6);
  EXPECT_THROW(read("t,q1,q2,tau1,qref1,qref2\n0,1,2,5,3,4\n"), InputError);
  EXPECT_THROW(read("t,q1,q2,qref1\n0,1,2,3\n"), InputError);
  options.torque_constants = {2, 3};
  log = read("t,q1,q2,i1,i2,qref1,qref2\n0,1,2,5,6,3,4\n");
  EXPECT_EQ(log.tau(0, 1), 18);
}

// A log whose stamps are wrong is read with the times that are given for it.
TEST(LogReader, ReadsOtherTimes) {
  const std::string path =
      WriteFile("t,q1,q2\n0,1,2\n1,1,2\n2,1,2\n", "timed.csv");
  LogReaderOptions options = TwoJoints();
  const Eigen::Vector3d times(0, .5, .7);
  options.sample_times[path] = std::make_shared<const Eigen::VectorXd>(times);
  LogReader reader(path, options);
  Log log;
  for (int pass = 0; pass < 2; ++pass) {
    for (int k = 0; k < 3; ++k) {
      ASSERT_TRUE(reader.Read(1, &log));
      EXPECT_EQ(log.t[0], times[k]);
    }
    EXPECT_FALSE(reader.Read(1, &log));
    reader.Rewind();
  }
  options.sample_times[path] =
      std::make_shared<const Eigen::VectorXd>(times.head(2));
  LogReader short_reader(path, options);
  EXPECT_THROW(short_reader.Read(3, &log), InputError);
}

TEST(LogReader, RefusesBadFiles) {
  const auto refusal = [](const std::string& bytes) {
    const std::string path = WriteFile(bytes);
    return MessageOf<InputError>(path, [&] {
      LogReader reader(path, TwoJoints());
      ReadAll(&reader);
    });
  };
  EXPECT_EQ(refusal(""), "FILE: the file is empty");
  EXPECT_EQ(refusal(Gzip("")), "FILE: the file is empty");
  EXPECT_EQ(refusal("t,q1\n0,1\n"),
            "FILE: row 1: missing q2 or elbow/position; the robot has 2 "
            "joints, the log holds q1");
  const std::string gz = Gzip(RandomLog(3000));
  EXPECT_EQ(refusal(gz.substr(0, gz.size() - 4)),
            "FILE: row 3002: the gzip stream ends early, the file is "
            "truncated; copy or record it again");
}

TEST(LogReader, ANumberAfterTheDamageIsNeverDelivered) {
  const std::string text = "t,q1,q2\n0,1,2\n1,1,2.5\n";
  const std::string gz = Gzip(text);
  LogReader reader(WriteFile(gz.substr(0, gz.size() - 8)), TwoJoints());
  Log log;
  int rows = 0;
  EXPECT_THROW(while (reader.Read(1, &log)) rows += log.size(), InputError);
  EXPECT_LE(rows, 2);
}

}  // namespace armcal::log_reader_test

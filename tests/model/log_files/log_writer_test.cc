#include "model/log_files/log_writer.h"

#include <gtest/gtest.h>

#include "model/log_files/log_reader.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::log_writer_test {

Log TwoJoints() {
  Log log;
  log.t = Eigen::Vector3d(0, .004, .0081);
  log.q = Eigen::MatrixXd::Random(3, 2);
  log.qd = Eigen::MatrixXd::Random(3, 2);
  log.tau = 100 * Eigen::MatrixXd::Random(3, 2);
  log.qref = Eigen::MatrixXd::Random(3, 2);
  log.temperature = 40 * Eigen::MatrixXd::Random(3, 2);
  return log;
}

Log ReadBack(const std::string& text, LogReaderOptions options) {
  const std::string path = WriteFile(text);
  options.joint_names = {"a", "b"};
  options.want_velocity = true;
  options.want_reference = true;
  options.want_temperature = true;
  LogReader reader(path, options);
  Log log;
  reader.Read(10, &log);
  return log;
}

TEST(LogWriter, ReaderReadsItBack) {
  const Log log = TwoJoints();
  const Log back = ReadBack(LogText(log), {});
  EXPECT_TRUE(back.t.isApprox(log.t, 1e-9));
  EXPECT_TRUE(back.q.isApprox(log.q, 1e-8));
  EXPECT_TRUE(back.qd.isApprox(log.qd, 1e-8));
  EXPECT_TRUE(back.tau.isApprox(log.tau, 1e-8));
  EXPECT_TRUE(back.qref.isApprox(log.qref, 1e-8));
  EXPECT_TRUE(back.temperature.isApprox(log.temperature, 1e-8));
}

TEST(LogWriter, CurrentsTimesTheirConstantsAreTheTorques) {
  const Log log = TwoJoints();
  LogWriterOptions options;
  options.torque_constants = {14.5, .2};
  const std::string text = LogText(log, options);
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "t,q1,q2,qd1,qd2,i1,i2,qref1,qref2,temp1,temp2");
  LogReaderOptions read;
  read.torque_constants = options.torque_constants;
  EXPECT_TRUE(ReadBack(text, read).tau.isApprox(log.tau, 1e-8));
}

}  // namespace armcal::log_writer_test

#include "model/log_files/columns/wrench_columns.h"

#include <gmock/gmock.h>

#include "model/log_files/log_reader.h"
#include "model/log_files/log_writer.h"
#include "model/text/input_error.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::wrench_columns_test {

using testing::HasSubstr;

// "3 1*0.001 ..": index and scale of the six, or why there are none.
std::string Find(const std::string& header) {
  std::string found;
  const std::string refusal = MessageOf<InputError>("log.csv", [&] {
    const LogColumns columns("log.csv", header, {"joint"});
    for (const LogColumn& column : FindWrench("log.csv", columns)) {
      found += (found.empty() ? "" : " ") + std::to_string(column.index);
      if (column.scale != 1) found += "*" + std::to_string(column.scale);
    }
  });
  return found + refusal;
}

TEST(WrenchColumns, AreFoundByNameInAnyOrder) {
  EXPECT_EQ(Find("t,q1,fx,fy,fz,tx,ty,tz"), "2 3 4 5 6 7");
  EXPECT_EQ(Find("t,tz,ty,tx,q1,fz,fy,fx"), "7 6 5 3 2 1");
  EXPECT_EQ(Find("t,q1,tau1"), "");
}

TEST(WrenchColumns, TakeUnits) {
  EXPECT_EQ(Find("t,q1,fx [mN],fy [N],fz [kN],tx [Nm],ty [mNm],tz [kNm]"),
            "2*0.001000 3 4*1000.000000 5 6*0.001000 7*1000.000000");
  EXPECT_THAT(Find("t,q1,fx [lbf],fy,fz,tx,ty,tz"),
              HasSubstr("column fx [lbf]: found 'lbf': expected the unit N, "
                        "mN or kN"));
  EXPECT_THAT(Find("t,q1,fx,fy,fz,tx [N],ty,tz"),
              HasSubstr("expected the unit Nm, mNm or kNm"));
}

TEST(WrenchColumns, MayBeSpelledInWords) {
  EXPECT_EQ(Find("t,q1,force_x,force_y,force_z,torque_x,torque_y,torque_z"),
            "2 3 4 5 6 7");
  EXPECT_EQ(Find("t,q1,/ft/wrench/force/x,/ft/wrench/force/y,"
                 "/ft/wrench/force/z,/ft/wrench/torque/x,/ft/wrench/torque/y,"
                 "/ft/wrench/torque/z"),
            "2 3 4 5 6 7");
  // UR's, in the base frame and without a bias, are something else.
  EXPECT_EQ(Find("t,q1,actual_TCP_force_0,actual_TCP_force_1,"
                 "actual_TCP_force_2,actual_TCP_force_3,actual_TCP_force_4,"
                 "actual_TCP_force_5"),
            "");
  EXPECT_EQ(Find("t,q1,grip_force_x"), "");
}

TEST(WrenchColumns, RefusesAPartOfThem) {
  EXPECT_THAT(Find("t,q1,fx,fy,fz,tx,tz"),
              HasSubstr("row 1: found 'fx, fy, fz, tx, tz': a force-torque "
                        "sensor has six columns, of which ty is missing"));
  EXPECT_THAT(Find("t,q1,wrench.force.x"),
              HasSubstr("of which wrench_force_y, wrench_force_z, "
                        "wrench_torque_x, wrench_torque_y, wrench_torque_z is "
                        "missing"));
  EXPECT_THAT(Find("t,q1,fx,fx,fy,fz,tx,ty,tz"),
              HasSubstr("found 'fx': the column is there twice"));
  EXPECT_THAT(
      Find("t,q1,fx,fy,fz,tx,ty,tz,force_x,force_y,force_z"),
      HasSubstr("found 'fx and force_x': expected one force-torque sensor"));
}

// A position in millimetres, as other programs call it.
TEST(WrenchColumns, LeaveTranslationsAlone) {
  EXPECT_EQ(Find("t,q1,tx [mm],ty [mm],tz [mm]"), "");
}

// Written, and read back from the text and from arrays in memory.
TEST(WrenchColumns, ComeBackFromFilesAndArrays) {
  Log log;
  log.t = Eigen::Vector3d(0, .004, .008);
  log.q = Eigen::MatrixXd::Random(3, 1);
  log.wrench = Eigen::MatrixXd::Random(3, 6);
  LogReaderOptions options;
  options.joint_names = {"joint"};
  options.need_torque = false;
  options.want_wrench = true;
  for (const LogSource& source :
       {LogSource(WriteFile(LogText(log))), LogSource("memory", log)}) {
    LogReader reader(source, options);
    EXPECT_TRUE(reader.has_wrench());
    Log back;
    reader.Read(10, &back);
    EXPECT_TRUE(back.wrench.isApprox(log.wrench, 1e-8)) << source.name;
  }
  options.want_wrench = false;
  LogReader reader(LogSource("memory", log), options);
  Log back;
  reader.Read(10, &back);
  EXPECT_EQ(back.wrench.size(), 0);
}

}  // namespace armcal::wrench_columns_test

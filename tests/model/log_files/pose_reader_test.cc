#include "model/log_files/pose_reader.h"

#include <gtest/gtest.h>

#include "model/text/input_error.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::pose_reader_test {

PoseMeasurements Read(const std::string& text) {
  return ReadPoses(WriteFile(text, "poses.csv"), {"shoulder", "elbow"});
}

struct BadPoses {
  const char* text;
  const char* message;
};

constexpr char kKinds[] =
    "FILE: row 1: expected one kind of measurement: x1 y1 z1 [x2 ..] "
    "(targets), x y z qw qx qy qz (poses), length1 (a wire), point or plane "
    "(touched ones), tilt_x tilt_y (an inclinometer)";

const BadPoses kBad[] = {
    {"", "FILE: the file is empty"},
    {"q1,q2,x1,y1,z1\n", "FILE: the file has a header and no rows"},
    {"q1,q2,x1,y1,z1\n\n", "FILE: the file has a header and no rows"},
    {"q1,q2,x1,z1\n0,0,1,2\n", "FILE: row 1: the column y1 is missing"},
    {"q1,q2,z1\n0,0,1\n", "FILE: row 1: the column x1, y1 is missing"},
    {"q1,q2,x1,y1,z1,x2,y2\n0,0,1,2,3,4,5\n",
     "FILE: row 1: the column z2 is missing"},
    {"q1,q2,x,y,z\n0,0,1,2,3\n",
     "FILE: row 1: the column qw, qx, qy, qz is missing"},
    {"q1,q2,x,y,z,qw,qx,qy\n0,0,1,2,3,1,0,0\n",
     "FILE: row 1: the column qz is missing"},
    {"q1,q2\n0,0\n", kKinds},
    {"image,q1,q2,bx,by,u,v\n1,0,0,0,0,5,6\n",
     "FILE: row 1: found 'u, v': images of a board, expected the camera's "
     "intrinsics beside them"},
    {"q1,q2,point,plane\n0,0,1,1\n",
     "FILE: row 1: expected one of the columns point and plane"},
    {"q1,q2,point\n0,0,1.5\n",
     "FILE: row 2, column point: found '1.5': expected the number of the "
     "touched point, from 1"},
    {"q1,q2,x1,y1,z1,length1\n0,0,1,2,3,4\n", kKinds},
    {"q1,q2,x,y,z,qw,qx,qy,qz,length1\n0,0,1,2,3,1,0,0,0,1\n", kKinds},
    {"q1,x1,y1,z1\n0,1,2,3\n",
     "FILE: row 1: missing q2 or elbow/position; the robot has 2 joints, the "
     "log holds q1; not recognised: 'x1', 'y1', 'z1'"},
    {"q1,q2,q3,length1\n0,0,0,1\n",
     "FILE: row 1: wrong number of joints: the robot has 2 joints, the log "
     "holds q1..q3"},
    {"q1,q2,x1[cm],y1,z1\n0,0,1,2,3\n",
     "FILE: row 1, column x1[cm]: found 'cm': expected the unit m or mm"},
    {"q1,q2,length1[in]\n0,0,1\n",
     "FILE: row 1, column length1[in]: found 'in': expected the unit m or mm"},
    {"q1,q2,x,y,z,qw[mm],qx,qy,qz\n0,0,1,2,3,1,0,0,0\n",
     "FILE: row 1, column qw[mm]: found 'mm': expected no unit"},
    {"q1[grad],q2,length1\n0,0,1\n",
     "FILE: row 1: column 'q1[grad]': expected a unit of rad, deg, m, mm"},
    {"q1,q2,x1,y1,z1,x1[mm]\n0,0,1,2,3,4\n",
     "FILE: row 1: found 'x1': the column is there twice"},
    {"q1,q2,q1,length1\n0,0,0,1\n",
     "FILE: row 1: two columns for the position of joint shoulder, 'q1' and "
     "'q1'; rename one"},
    {"q1,q2,length1\n0,0,nan\n",
     "FILE: row 2, column length1: found 'nan': expected a finite number"},
    {"q1,q2,length1\n0,0,1\n0,inf,1\n",
     "FILE: row 3, column q2: found 'inf': expected a finite number"},
    {"q1,q2,length1\n0,,1\n",
     "FILE: row 2, column q2: the field is empty, expected a number"},
    {"q1,q2,length1\n0,0\n",
     "FILE: row 2: found '2 fields': expected 3 as in the header"},
    {"q1,q2,length1\n0,0,1\n0,0",
     "FILE: row 3: found '2 fields': expected 3 as in the header; the file "
     "ends inside this row, delete it"},
    {"q1;q2;length1\n0;0;1,5\n",
     "FILE: row 2, column length1: found '1,5': expected a finite number with "
     "a decimal point, not a comma"},
    {"q1,q2,length1\n0,0,-1\n",
     "FILE: row 2, column length1: found '-1': expected a length above 0"},
    {"q1,q2,x,y,z,qw,qx,qy,qz\n0,0,1,2,3,1,0,0,0\n0,0,1,2,3,0,0,0,0\n",
     "FILE: row 3, column qw: found '0 0 0 0': expected a unit quaternion"},
    {"q1,q2,x,y,z,qw,qx,qy,qz\n0,0,1,2,3,30,0,90,0\n",
     "FILE: row 2, column qw: found '30 0 90 0': expected a unit quaternion"},
    {"0,0,1\n0,0,1\n",
     "FILE: row 1: expected a header that names the columns, as in t,q1,tau1"},
};

TEST(PoseReader, RefusesMalformedFiles) {
  for (const BadPoses& bad : kBad) {
    const std::string path = WriteFile(bad.text, "poses.csv");
    EXPECT_EQ(MessageOf<InputError>(path,
                                    [&] {
                                      ReadPoses(path, {"shoulder", "elbow"});
                                    }),
              bad.message)
        << bad.text;
  }
  EXPECT_EQ(MessageOf<InputError>("/no/such",
                                  [] { ReadPoses("/no/such", {"shoulder"}); }),
            "FILE: cannot be opened: No such file or directory");
}

TEST(PoseReader, ReadsTouchedPoints) {
  EXPECT_TRUE(Read("q1,q2,plane\n0,0,1\n0,1,2\n").planes);
  const PoseMeasurements m = Read("q1,q2,point\n0,0,7\n0,1,3\n1,0,7\n");
  EXPECT_FALSE(m.planes);
  EXPECT_EQ(m.touched, (std::vector<int>{1, 0, 1}));
  EXPECT_EQ(m.num_points(), 2);
}

// Labels of other measurements, numbers or not, which files had before.
TEST(PoseReader, LeavesColumnsOfTheseNamesAloneElsewhere) {
  const PoseMeasurements m =
      Read("q1,q2,point,u,length1\n0,0,left,5,1\n0,1,right,6,2\n");
  EXPECT_EQ(m.size(), 2);
  EXPECT_TRUE(m.touched.empty());
}

TEST(PoseReader, ReadsTargets) {
  const PoseMeasurements m = Read(
      "pose,q1[deg],x2[mm],y2,z2,elbow/position,z1,y1,x1,u95_1,u95_2[mm]\n"
      "1,90,1000,2,3,.5,6,5,4,.01,20\n\n2,-90,-1000,-2,-3,-.5,-6,-5,-4,0,0\n");
  ASSERT_EQ(m.size(), 2);
  EXPECT_NEAR(m.q(0, 0), M_PI / 2, 1e-15);
  EXPECT_EQ(m.q(1, 1), -.5);
  ASSERT_EQ(m.targets.size(), 2);
  EXPECT_EQ(m.targets[0].row(0), Eigen::RowVector3d(4, 5, 6));
  EXPECT_EQ(m.targets[1].row(0), Eigen::RowVector3d(1, 2, 3));
  EXPECT_EQ(m.targets[1].row(1), Eigen::RowVector3d(-1, -2, -3));
  EXPECT_EQ(m.u95.row(0), Eigen::RowVector2d(.01, .02));
  EXPECT_EQ(m.row, (std::vector<long>{2, 4}));
  EXPECT_EQ(m.poses.size() + m.lengths.size(), 0);
}

TEST(PoseReader, ReadsPosesAndWires) {
  const PoseMeasurements poses =
      Read("q1;q2;qx;qy;qz;qw;x;y;z\r\n0;0;.1;.1;.1;.985;1;2;3\r\n");
  ASSERT_EQ(poses.poses.rows(), 1);
  Eigen::RowVectorXd pose(7);
  pose << 1, 2, 3, .985, .1, .1, .1;
  EXPECT_EQ(poses.poses.row(0), pose);
  EXPECT_TRUE(poses.targets.empty());
  const PoseMeasurements wire =
      Read(Gzip("q1,q2,length1 [mm],x_ctrl\n1,2,500,n/a\n1,2,250,\n"));
  ASSERT_EQ(wire.lengths.size(), 2);
  EXPECT_EQ(wire.lengths[0], .5);
  EXPECT_EQ(wire.lengths[1], .25);
  EXPECT_EQ(wire.u95.size(), 0);
}

// Rows that are left out of a file keep the others' numbers; names are none.
TEST(PoseReader, TakesNumbersOfPosesWhereTheFileHasThem) {
  EXPECT_EQ(Read("pose,q1,q2,length1\n3,0,0,1\n7,0,0,1\n").number,
            (std::vector<long>{3, 7}));
  EXPECT_TRUE(Read("pose,q1,q2,length1\nhome,0,0,1\n7,0,0,1\n").number.empty());
  EXPECT_TRUE(Read("q1,q2,length1\n0,0,1\n").number.empty());
}

// A joint's name alone is a position here, whatever it may be in a log.
TEST(PoseReader, TakesJointsByTheirNamesAlone) {
  const PoseMeasurements named =
      Read("shoulder [deg],elbow,length1\n180,2,1\n");
  EXPECT_NEAR(named.q(0, 0), M_PI, 1e-12);
  EXPECT_EQ(named.q(0, 1), 2);
}

// A portal's joints are called as what is measured is: a column is one of both.
TEST(PoseReader, KnowsThePortalsJointsFromItsTool) {
  const std::string pose =
      WriteFile("q1,q2,q3,x,y,z,qw,qx,qy,qz\n1,2,3,4,5,6,1,0,0,0\n", "p.csv");
  const PoseMeasurements whole = ReadPoses(pose, {"x", "y", "z"});
  EXPECT_EQ(whole.kind(), PoseMeasurements::Kind::kPoses);
  EXPECT_EQ(whole.q(0, 2), 3);
  const std::string target =
      WriteFile("x,y,z,x1,y1,z1\n1,2,3,4,5,6\n", "t.csv");
  const PoseMeasurements targets = ReadPoses(target, {"x", "y", "z"});
  EXPECT_EQ(targets.kind(), PoseMeasurements::Kind::kTargets);
  EXPECT_EQ(targets.q(0, 1), 2);
}

TEST(PoseReader, ReadsTilts) {
  const std::string path =
      WriteFile("q1,q2,tilt_x[deg],tilt_y[deg],u95_1[deg]\n0,0,30,-45,.01\n",
                "tilts.csv");
  const PoseMeasurements measured = ReadPoses(path, {"shoulder", "elbow"});
  EXPECT_EQ(measured.kind(), PoseMeasurements::Kind::kTilts);
  EXPECT_NEAR(measured.tilts(0, 0), M_PI / 6, 1e-15);
  EXPECT_NEAR(measured.tilts(0, 1), -M_PI / 4, 1e-15);
  EXPECT_NEAR(measured.u95(0, 0), .01 * M_PI / 180, 1e-15);
}

// 45 without a unit is no angle in rad.
TEST(PoseReader, RefusesTiltsInOtherUnits) {
  const std::string path =
      WriteFile("q1,q2,tilt_x,tilt_y\n0,0,0,45\n", "tilts.csv");
  EXPECT_EQ(MessageOf<InputError>(path,
                                  [&] {
                                    ReadPoses(path, {"shoulder", "elbow"});
                                  }),
            "FILE: row 2, column tilt_y: found '45': expected an angle to the "
            "horizontal below 80 degrees (in rad, unless the column's name "
            "ends with [deg])");
}

}  // namespace armcal::pose_reader_test

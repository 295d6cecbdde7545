#include "model/robot_files/mjcf/mjcf_includes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "model/robot_files/mjcf/mjcf_reader.h"
#include "model/text/input_error.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::mjcf_includes_test {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

std::string Body(const std::string& name) {
  return "<x><worldbody><body name='" + name + "'><joint name='" + name +
         "_joint'/><geom size='1'/></body></worldbody></x>";
}

class MjcfIncludes : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = WriteFile("", "folder");
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "robot/parts");
  }
  void TearDown() override { fs::remove_all(folder_); }

  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  // The robot of the file robot/arm.xml with that text.
  Robot Read(const std::string& text, const std::string& allowed = "") const {
    Write("robot/arm.xml", "<mujoco>" + text + "</mujoco>");
    RobotReaderOptions options;
    options.folder = allowed;
    return ReadMjcf((folder_ / "robot/arm.xml").string(), options);
  }
  std::string Refusal(const std::string& text,
                      const std::string& allowed = "") const {
    return MessageOf<InputError>((folder_ / "robot/arm.xml").string(),
                                 [&] { Read(text, allowed); });
  }

  fs::path folder_;
};

TEST_F(MjcfIncludes, StandInThePlaceOfTheElement) {
  Write("robot/parts/defaults.xml",
        "<d><default><joint damping='3'/></default></d>");
  Write(
      "robot/hand.xml",
      "<h><body name='hand'><joint name='wrist'/><geom size='1'/></body></h>");
  const Robot robot = Read(
      "<include file='parts/defaults.xml'/><worldbody><body name='arm'>"
      "<joint name='elbow'/><geom size='1'/><include file='hand.xml'/>"
      "</body></worldbody>");
  EXPECT_THAT(robot.JointNames(), ElementsAre("elbow", "wrist"));
  EXPECT_EQ(robot.links[1].joint.viscous, 3);
  EXPECT_THAT(robot.notes, Contains("read as well, by <include>: "
                                    "parts/defaults.xml, hand.xml"));
}

// As MuJoCo 4.0.0 looks for them: beside the robot's file first, then beside
// the including one.
TEST_F(MjcfIncludes, AreFoundBesideTheRobotFirst) {
  Write("robot/parts/a.xml", "<x><include file='b.xml'/></x>");
  Write("robot/parts/b.xml", Body("beside_a"));
  const std::string text = "<include file='parts/a.xml'/>";
  EXPECT_EQ(Read(text).links[0].name, "beside_a");
  Write("robot/b.xml", Body("beside_robot"));
  EXPECT_EQ(Read(text).links[0].name, "beside_robot");
}

TEST_F(MjcfIncludes, MessagesNameTheFile) {
  Write("robot/b.xml", "<x>\n<worldbody><body pos='1 2'/></worldbody></x>");
  EXPECT_THAT(Refusal("<include file='b.xml'/>"),
              HasSubstr("robot/b.xml: line 2, <body pos> of body 'body1': "
                        "found '1 2': expected three numbers in m"));
}

TEST_F(MjcfIncludes, LeadToNoOtherFolder) {
  Write("other.xml", Body("other"));
  const std::string in_folder =
      "expected a file in the robot file's own folder; `robot_folder`=DIR "
      "allows those in another";
  EXPECT_EQ(Refusal("<include file='../other.xml'/>"),
            "FILE: line 1, <include file>: found '../other.xml': " + in_folder);
  EXPECT_THAT(Refusal("<include file='/etc/passwd'/>"), HasSubstr(in_folder));
  fs::create_symlink(folder_ / "other.xml", folder_ / "robot/link.xml");
  EXPECT_THAT(Refusal("<include file='link.xml'/>"), HasSubstr(in_folder));
  // The folder's name begins like the allowed one's.
  fs::create_directory(folder_ / "robot2");
  Write("robot2/x.xml", Body("x"));
  EXPECT_THAT(Refusal("<include file='../robot2/x.xml'/>"),
              HasSubstr(in_folder));
  EXPECT_EQ(
      Read("<include file='../other.xml'/>", folder_.string()).links[0].name,
      "other");
  EXPECT_EQ(Refusal("", (folder_ / "none").string()),
            "`robot_folder`: found '" + (folder_ / "none").string() +
                "': expected a folder");
}

TEST_F(MjcfIncludes, AreFilesReadOnce) {
  EXPECT_THAT(Refusal("<include file='arm.xml'/>"),
              HasSubstr("expected a file that is not included already"));
  Write("robot/a.xml", "<x><include file='./a.xml'/></x>");
  EXPECT_THAT(Refusal("<include file='a.xml'/>"),
              HasSubstr("a.xml: line 1, <include file>: found './a.xml': "
                        "expected a file that is not included already"));
  EXPECT_THAT(Refusal("<include file='parts'/>"),
              HasSubstr("expected a file that exists"));
  EXPECT_THAT(Refusal("<include file='none.xml'/>"),
              HasSubstr("expected a file that exists"));
  EXPECT_THAT(Refusal("<include/>"), HasSubstr("expected an attribute 'file'"));
}

TEST_F(MjcfIncludes, HaveLimits) {
  for (int k = 0; k < 30; ++k) {
    Write("robot/" + std::to_string(k) + ".xml",
          "<x><include file='" + std::to_string(k + 1) + ".xml'/></x>");
  }
  Write("robot/30.xml", "<x/>");
  EXPECT_THAT(Refusal("<include file='0.xml'/>"),
              HasSubstr("19.xml: line 1, <include file>: found '20.xml': "
                        "expected at most 200 files"));
  Write("robot/30.xml", Body("a"));
  EXPECT_EQ(Refusal("<include file='11.xml'/>"), "");
}

TEST_F(MjcfIncludes, ATextHasNoFolder) {
  const Document text("arm.mjcf", "<mujoco><include file='b.xml'/></mujoco>");
  EXPECT_EQ(
      MessageOf<InputError>("arm.mjcf", [&] { ReadMjcf(text, {}); }),
      "FILE: line 1, <include file>: found 'b.xml': expected a robot that "
      "is one text: only a file has a folder with others");
}

}  // namespace armcal::mjcf_includes_test

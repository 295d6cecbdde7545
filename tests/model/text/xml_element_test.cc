#include "model/text/xml_element.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/fixtures/urdf_text.h"

namespace armcal::xml_element_test {

using namespace urdf_text;

class XmlFileRefusal : public testing::TestWithParam<Case> {};

TEST_P(XmlFileRefusal, SaysWhereAndWhy) {
  EXPECT_EQ(Refusal(GetParam()), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Xml, XmlFileRefusal,
    testing::Values(
        Case{"<robot name=\"arm\">", "<!DOCTYPE robot><robot name=\"arm\">",
             "line 2: found '<!DOCTYPE': expected no DOCTYPE or entity "
             "declarations"},
        Case{"<robot name=\"arm\">",
             "<!DOCTYPE r [\n<!ENTITY a \"b\">]><robot name=\"arm\">",
             "line 2: found '<!DOCTYPE': expected no DOCTYPE or entity "
             "declarations"},
        Case{"<link name=\"base\"/>", "<xacro:macro name=\"m\"/>",
             "line 3, <xacro:macro>: expected a plain URDF: run xacro first "
             "(xacro robot.urdf.xacro > robot.urdf)"},
        Case{"value=\"2\"", "value=\"2\" value=\"3\"",
             "line 7: an attribute is malformed or given twice"},
        Case{"</robot>", "</robot>\n<robot/>",
             "line 27: found '<robot>': expected only one root element"},
        Case{"</robot>", "",
             "line 2: an element is not closed or closed by another name; is "
             "the file truncated?"},
        Case{"</inertial>", "</inertia>",
             "line 5: an element is not closed or closed by another name; is "
             "the file truncated?"},
        Case{"value=\"2\"", "value=2",
             "line 7: an attribute is malformed or given twice"}));

TEST(XmlFileTest, WholeFiles) {
  EXPECT_EQ(Refusal(kArm), "");
  EXPECT_EQ(Refusal(""), "the file is empty");
  EXPECT_EQ(Refusal(" \n"), "the file is empty");
  EXPECT_EQ(Refusal("t,q1,tau1\n"),
            "line 1: expected XML: elements, and no text around them");
  EXPECT_EQ(Refusal("\xFF\xFE<\0r\0"), "is UTF-16: expected UTF-8 text");
  EXPECT_EQ(Refusal(std::string("<robot\0/>", 9)),
            "contains NUL bytes: expected UTF-8 text");
  EXPECT_EQ(Refusal("<sdf/>"),
            "line 1, <sdf>: found 'sdf': expected the root element <robot>");
  EXPECT_EQ(Refusal("<robot/>"),
            "line 1, <robot>: expected at least one <link>");
  EXPECT_EQ(Refusal("<robot><link name='a'/></robot>"),
            "expected a joint that moves a link of base link 'a'");
  EXPECT_EQ(Refusal(std::string((32 << 20) + 1, ' ')),
            "is larger than 32 MiB, the most that such a file may have");
  std::string deep = "<robot>";
  for (int i = 0; i < 200000; ++i) deep += "<a>";
  EXPECT_EQ(Refusal(deep), "line 1: elements are nested too deeply");
}

TEST(XmlFileTest, FilesThatCannotBeRead) {
  const auto refusal = [](const std::string& path) -> std::string {
    try {
      ReadUrdf(path, {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal("no/such.urdf"),
            "no/such.urdf: cannot be opened: No such file or directory");
  EXPECT_EQ(refusal("/tmp"), "/tmp: is a folder: expected a file");
}

}  // namespace armcal::xml_element_test

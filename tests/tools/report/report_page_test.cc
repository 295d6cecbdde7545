#include "tools/report/report_page.h"

#include <gmock/gmock.h>

#include "model/text/input_error.h"
#include "tests/fixtures/temp_file.h"
#include "tools/report/assets.h"

namespace armcal::report_page_test {

using testing::HasSubstr;
using testing::Not;

const char kHostile[] = "</script><img src=x onerror=alert(1)><!--";

ReportContent Content() {
  ReportContent content;
  content.command = "calibrate";
  content.robot = kHostile;
  content.result = {{"joints", {{{"name", kHostile}}}}};
  content.arguments = {"armcal", "calibrate", std::string("--log=") + kHostile};
  content.files = {{kHostile, "00", 1}};
  return content;
}

TEST(ReportPage, NamesAreNeverHtml) {
  const std::string page = ReportPage(Content());
  EXPECT_THAT(page, Not(HasSubstr("<img")));
  EXPECT_THAT(page, HasSubstr("\\u003cimg src=x onerror=alert(1)"));
}

TEST(ReportPage, LoadsNothing) {
  std::string page = ReportPage(Content());
  page.replace(page.find(DygraphsScript()), DygraphsScript().size(), "");
  for (const char* reference : {"src=\"", "href=\"http", "@import", "url("}) {
    EXPECT_THAT(page, Not(HasSubstr(reference))) << reference;
  }
  EXPECT_THAT(page, HasSubstr("default-src 'none'; script-src 'sha256-"));
  EXPECT_THAT(page, Not(HasSubstr("script-src 'unsafe-inline'")));
}

TEST(ReportPage, BytesThatAreNoTextDoNotStopIt) {
  ReportContent content = Content();
  content.robot = "\xff\xfe";
  EXPECT_THAT(ReportPage(content), HasSubstr("\xef\xbf\xbd"));
}

TEST(ReportPage, TheSameContentGivesTheSameBytes) {
  EXPECT_EQ(ReportPage(Content()), ReportPage(Content()));
}

// FIPS 180-4's example.
TEST(HashFile, IsSha256) {
  const SourceFile file = HashFile(WriteFile("abc", "abc.txt"));
  EXPECT_EQ(file.sha256,
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(file.bytes, 3);
  EXPECT_THROW(HashFile("/nowhere/at/all"), InputError);
}

}  // namespace armcal::report_page_test

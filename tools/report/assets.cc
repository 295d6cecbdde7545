#include "tools/report/assets.h"

// Of cmake/embed.cmake.
extern "C" {
extern const char embedded_dygraphs_script[], embedded_dygraphs_script_end[];
extern const char embedded_dygraphs_style[], embedded_dygraphs_style_end[];
extern const char embedded_report_script[], embedded_report_script_end[];
extern const char embedded_report_style[], embedded_report_style_end[];
extern const char embedded_watch_html[], embedded_watch_html_end[];
extern const char embedded_watch_script[], embedded_watch_script_end[];
extern const char embedded_watch_style[], embedded_watch_style_end[];
}

namespace armcal {
namespace {

std::string_view Between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace

std::string_view DygraphsScript() {
  return Between(embedded_dygraphs_script, embedded_dygraphs_script_end);
}
std::string_view DygraphsStyle() {
  return Between(embedded_dygraphs_style, embedded_dygraphs_style_end);
}
std::string_view ReportScript() {
  return Between(embedded_report_script, embedded_report_script_end);
}
std::string_view ReportStyle() {
  return Between(embedded_report_style, embedded_report_style_end);
}

std::string_view WatchHtml() {
  return Between(embedded_watch_html, embedded_watch_html_end);
}
std::string_view WatchScript() {
  return Between(embedded_watch_script, embedded_watch_script_end);
}
std::string_view WatchStyle() {
  return Between(embedded_watch_style, embedded_watch_style_end);
}

}  // namespace armcal

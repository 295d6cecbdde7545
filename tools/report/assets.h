#pragma once

#include <string_view>

namespace armcal {

// Files that CMake puts into the program (CMakeLists.txt), as they are.
std::string_view DygraphsScript();  // Debian's libjs-dygraphs, MIT licence
std::string_view DygraphsStyle();
std::string_view ReportScript();  // assets/*.js, one after the other
std::string_view ReportStyle();   // assets/report.css
std::string_view WatchHtml();     // assets/watch.html, .js, .css
std::string_view WatchScript();
std::string_view WatchStyle();

}  // namespace armcal

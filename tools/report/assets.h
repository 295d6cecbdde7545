#pragma once

#include <string_view>

namespace armcal {

// Files that CMake puts into the program (CMakeLists.txt), as they are.
std::string_view DygraphsScript();  // Debian's libjs-dygraphs, MIT licence
std::string_view DygraphsStyle();
std::string_view ChartsScript();  // assets/charts.js
std::string_view PlotsScript();   // assets/plots.js
std::string_view ReportScript();  // assets/report.js
std::string_view ReportStyle();   // assets/report.css

}  // namespace armcal

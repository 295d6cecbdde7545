#include "tools/python/robot_reading.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <map>
#include <string>

#include "model/robot_files/robot_reader.h"
#include "model/text/decimal_point.h"
#include "model/text/input_text.h"
#include "tools/python/samples.h"

namespace armcal {
namespace {

namespace py = pybind11;

LoadedRobot ReadLoadedRobot(const Document& file, const std::string& base,
                            const std::string& tip, const py::object& gravity,
                            const std::map<std::string, double>& posture,
                            const std::string& folder) {
  RobotReaderOptions options;
  options.folder = folder;
  options.base = base;
  options.tip = tip;
  options.posture = posture;
  if (!gravity.is_none()) {
    options.gravity = ReadVector("gravity", gravity, 3);
  }
  return {ReadRobot(file, options), file, base, tip, posture, folder};
}

LoadedRobot ReadRobotFile(const std::filesystem::path& path,
                          const std::string& base, const std::string& tip,
                          const py::object& gravity,
                          const std::filesystem::path& robot_folder,
                          const std::map<std::string, double>& posture) {
  return ReadLoadedRobot(path.string(), base, tip, gravity, posture,
                         robot_folder.string());
}

// Named as a file of that format is, by which readers tell it.
LoadedRobot ReadRobotText(const std::string& text, const std::string& format,
                          const std::string& name, const std::string& base,
                          const std::string& tip, const py::object& gravity,
                          const std::map<std::string, double>& posture) {
  for (const std::string known : {"urdf", "mjcf", "sdf", "yaml"}) {
    if (format != known) continue;
    return ReadLoadedRobot({name + "." + format, text}, base, tip, gravity,
                           posture, "");
  }
  throw py::value_error("format: found " + Quoted(format) +
                        ", expected urdf, mjcf, sdf or yaml");
}

std::string TextOf(const LoadedRobot& file) {
  constexpr long kMostBytes = 32L << 20;  // that readers take
  return file.file.Text(kMostBytes);
}

void AddOrigin(py::class_<LoadedRobot>* robot) {
  const auto add = [robot](const char* name, auto get, const char* doc) {
    robot->def_property_readonly(name, get, doc);
  };
  add(
      "path",
      [](const LoadedRobot& f) {
        return f.file.is_file() ? f.file.name() : "";
      },
      "The file it is from; empty for a text.");
  add(
      "source", [](const LoadedRobot& f) { return f.file.name(); },
      "What messages and reports call what it is from: the path, or the text's "
      "name with its format.");
  add("text", &TextOf, "The text it is from, of a file too.");
  add(
      "base", [](const LoadedRobot& f) { return f.base; },
      "As it was asked for.");
  add(
      "tip", [](const LoadedRobot& f) { return f.tip; },
      "As it was asked for.");
  add(
      "posture", [](const LoadedRobot& f) { return f.posture; },
      "{joint: position} of joints beside these, as it was asked for.");
  add(
      "robot_folder", [](const LoadedRobot& f) { return f.folder; },
      "As it was asked for.");
}

}  // namespace

void AddRobotReading(py::module_* module, py::class_<LoadedRobot>* robot) {
  const py::none none;
  (*robot).def_static(
      "from_text", &ReadRobotText, py::arg("text"), py::arg("format") = "urdf",
      py::kw_only(), py::arg("name") = "robot", py::arg("base") = "",
      py::arg("tip") = "", py::arg("gravity") = none,
      py::arg("posture") = py::dict(), py::call_guard<DecimalPoint>(),
      "The robot of a text: urdf, mjcf, sdf or yaml. Messages and "
      "reports call it name.format; base, tip, gravity and posture as of "
      "read_robot.");
  AddOrigin(robot);
  module->def(
      "read_robot", &ReadRobotFile, py::arg("path"), py::arg("base") = "",
      py::arg("tip") = "", py::arg("gravity") = none,
      py::arg("robot_folder") = "", py::arg("posture") = py::dict(),
      py::call_guard<DecimalPoint>(),
      "The robot of a URDF, MJCF, SDF or YAML file; of the first three what "
      "moves from link base to link tip, or to several: 'left,right'. "
      "gravity: (3,), m/s^2, instead of the file's. robot_folder: where "
      "files that an MJCF file names may lie, instead of its own folder. "
      "posture: {joint: position}, where joints beside these are held.");
}

}  // namespace armcal

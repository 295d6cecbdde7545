// write_left_out --from_logs=DIR --from_labels=DIR --logs=DIR --labels=DIR
//
// Cases with one effect, for a diagnoser that does not know this effect: the
// same logs, its name in case.json's --without, and labels that say it is not
// in the catalogue (tests/blind/README.md).

#include <gflags/gflags.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/blind/blind_program.h"
#include "tests/blind/case_files.h"

DEFINE_string(from_logs, "blind/logs", "cases of write_blind_cases");
DEFINE_string(from_labels, "blind/labels", "their labels");
DEFINE_string(logs, "left_out/logs", "folder for the new cases");
DEFINE_string(labels, "left_out/labels", "folder for what they hide");

namespace armcal {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json Read(const fs::path& path) {
  std::ifstream file(path);
  return json::parse(file);
}

// Whether the label is of such a case.
bool WriteCase(const std::string& name, json label) {
  if (label.at("stratum") != "one") return false;
  json& effect = label.at("effects").at(0);
  const fs::path from = fs::path(FLAGS_from_logs) / name;
  const fs::path to = fs::path(FLAGS_logs) / name;
  fs::create_directories(to);
  for (const auto& entry : fs::directory_iterator(from)) {
    const fs::path file = to / entry.path().filename();
    if (!fs::exists(file)) fs::create_symlink(fs::absolute(entry.path()), file);
  }
  json content = Read(from / "case.json");
  content["flags"].push_back("--without=" +
                             effect.at("effect").get<std::string>());
  fs::remove(to / "case.json");
  WriteText(to / "case.json", content.dump(1) + "\n");
  label["stratum"] = "left_out";
  effect["in_catalogue"] = false;
  WriteText(fs::path(FLAGS_labels) / (name + ".json"), label.dump(1) + "\n");
  return true;
}

int Main() {
  fs::create_directories(FLAGS_labels);
  int written = 0;
  for (const auto& entry : fs::directory_iterator(FLAGS_from_labels)) {
    if (entry.path().extension() == ".json") {
      written += WriteCase(entry.path().stem(), Read(entry.path()));
    }
  }
  std::printf("%d cases\n", written);
  return written > 0 ? 0 : 1;
}

}  // namespace
}  // namespace armcal

int main(int argc, char** argv) {
  return armcal::RunBlindProgram("write_left_out", &armcal::Main, argc, argv);
}

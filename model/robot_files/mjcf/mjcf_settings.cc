#include "model/robot_files/mjcf/mjcf_settings.h"

#include "model/robot_files/mjcf/mjcf_defaults.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

bool Bool(const MjcfElement& element, const char* attribute, bool absent) {
  if (!element.Has(attribute)) return absent;
  return element.Choice(attribute, {"true", "false"}) == "true";
}

void ReadEulerSequence(const MjcfElement& compiler, MjcfSettings* settings) {
  if (!compiler.Has("eulerseq")) return;
  const std::string text = compiler.Text("eulerseq");
  if (text.size() != 3 ||
      text.find_first_not_of("xyzXYZ") != std::string::npos) {
    compiler.own().Refuse("eulerseq", text,
                          "expected three of the letters xyzXYZ");
  }
  settings->eulerseq = text;
}

void ReadInertiaSource(const MjcfElement& compiler, MjcfSettings* settings) {
  using FromGeoms = MjcfSettings::FromGeoms;
  if (compiler.Has("inertiafromgeom")) {
    const std::string choice =
        compiler.Choice("inertiafromgeom", {"auto", "true", "false"});
    settings->inertia_from_geoms = choice == "auto"   ? FromGeoms::kWhereAbsent
                                   : choice == "true" ? FromGeoms::kAlways
                                                      : FromGeoms::kNever;
  }
  if (compiler.Has("inertiagrouprange")) {
    settings->inertia_groups = compiler.Range("inertiagrouprange", "");
  }
}

void ReadCompiler(const MjcfElement& compiler, MjcfSettings* settings) {
  if (compiler.Choice("coordinate", {"local", "global"}) == "global") {
    compiler.own().Refuse("coordinate", "global",
                          "expected local, as MuJoCo itself does since 2.3.4; "
                          "MuJoCo 2.3.3 saves a global model as a local one");
  }
  settings->totalmass =
      compiler.NumberOr("settotalmass", "kg", settings->totalmass);
  if (compiler.Has("angle")) {
    settings->degrees =
        compiler.Choice("angle", {"degree", "radian"}) == "degree";
  }
  ReadEulerSequence(compiler, settings);
  ReadInertiaSource(compiler, settings);
  settings->autolimits = Bool(compiler, "autolimits", settings->autolimits);
  settings->balanceinertia =
      Bool(compiler, "balanceinertia", settings->balanceinertia);
  settings->boundmass =
      compiler.NumberOr("boundmass", "kg", settings->boundmass);
  settings->boundinertia =
      compiler.NumberOr("boundinertia", "kg m^2", settings->boundinertia);
}

void ReadOption(const XmlElement& element, MjcfSettings* settings) {
  const MjcfElement option({element});
  settings->gravity = option.VectorOr("gravity", "m/s^2", settings->gravity);
  for (const char* fluid : {"density", "viscosity"}) {
    if (option.NumberOr(fluid, "", 0) == 0) continue;
    settings->notes.push_back(std::string("the ") + fluid +
                              " of the medium is not used: armcal's arms move "
                              "in a vacuum");
  }
  const std::optional<XmlElement> flag = element.Child("flag");
  if (flag && MjcfElement({*flag}).Choice("gravity", {"enable", "disable"}) ==
                  "disable") {
    settings->gravity.setZero();
  }
}

}  // namespace

MjcfSettings ReadMjcfSettings(const XmlElement& root) {
  MjcfSettings settings;
  for (const XmlElement& compiler : root.Children("compiler")) {
    ReadCompiler(MjcfElement({compiler}), &settings);
  }
  for (const XmlElement& option : root.Children("option")) {
    ReadOption(option, &settings);
  }
  return settings;
}

}  // namespace armcal

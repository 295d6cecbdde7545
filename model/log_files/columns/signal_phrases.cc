#include "model/log_files/columns/signal_phrases.h"

#include <cctype>
#include <map>
#include <set>

namespace armcal {
namespace {

// What signals are called beside armcal's own words (NamesOf), their words
// joined by blanks.
const std::map<std::string, Signal>& OtherPhrases() {
  static const auto* const kPhrases = new std::map<std::string, Signal>{
      {"pos", Signal::kPosition},
      {"positions", Signal::kPosition},
      {"angle", Signal::kPosition},
      {"dq", Signal::kVelocity},
      {"qdot", Signal::kVelocity},
      {"vel", Signal::kVelocity},
      {"velocities", Signal::kVelocity},
      {"speed", Signal::kVelocity},
      {"ddq", Signal::kAcceleration},
      {"acc", Signal::kAcceleration},
      {"accelerations", Signal::kAcceleration},
      {"tau j", Signal::kEffort},  // libfranka's
      {"torque", Signal::kEffort},
      {"torques", Signal::kEffort},
      {"efforts", Signal::kEffort},
      {"force", Signal::kEffort},
      {"currents", Signal::kCurrent},
      {"motor current", Signal::kCurrent},
      {"q ref", Signal::kReference},
      {"q d", Signal::kReference},  // libfranka's
      {"q des", Signal::kReference},
      {"q cmd", Signal::kReference},
      {"target q", Signal::kReference},
      {"position reference", Signal::kReference},
      {"position command", Signal::kReference},
      {"desired position", Signal::kReference},
      {"target position", Signal::kReference},
      {"commanded position", Signal::kReference},
      {"pos ref", Signal::kReference},
      {"pos des", Signal::kReference},
      {"pos cmd", Signal::kReference},
      {"temperatures", Signal::kTemperature},
      {"voltages", Signal::kVoltage},
      {"motor voltage", Signal::kVoltage}};
  return *kPhrases;
}

const std::set<std::string>& Fillers() {
  static const auto* const kFillers = new std::set<std::string>{
      "joint", "joints", "j",      "axis",  "actual", "measured",
      "meas",  "state",  "states", "field", "robot"};
  return *kFillers;
}

// Units by how else they are written, as Plain() has them.
const std::map<std::string, std::string>& OtherUnits() {
  static const auto* const kUnits = new std::map<std::string, std::string>{
      {"radian", "rad"},     {"radians", "rad"},    {"degree", "deg"},
      {"degrees", "deg"},    {"\u00b0", "deg"},     {"\u00b0/s", "deg/s"},
      {"rad/s2", "rad/s^2"}, {"deg/s2", "deg/s^2"}, {"amp", "A"},
      {"amps", "A"},         {"volt", "V"},         {"volts", "V"},
      {"\u00b0c", "degC"},   {"sec", "s"},          {"secs", "s"},
      {"seconds", "s"}};
  return *kUnits;
}

const std::set<std::string>& OtherQuantities() {
  static const auto* const kWords = new std::set<std::string>{
      "motor",    "rotor",     "drive",     "desired",   "des",       "target",
      "command",  "commanded", "cmd",       "reference", "ref",       "goal",
      "setpoint", "planned",   "error",     "err",       "external",  "ext",
      "min",      "max",       "lower",     "upper",     "limit",     "limits",
      "nominal",  "model",     "predicted", "estimated", "simulated", "sim"};
  return *kWords;
}

// In lower case, without blanks, dots and stars.
std::string Plain(std::string_view unit) {
  std::string plain;
  for (const char c : unit) {
    if (c != ' ' && c != '.' && c != '*') {
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  return plain;
}

}  // namespace

std::optional<Signal> SignalOf(const std::string& phrase) {
  for (const Signal signal : kSignals) {
    const SignalNames& names = NamesOf(signal);
    if (phrase == names.number_prefix || phrase == names.path_part)
      return signal;
  }
  const auto other = OtherPhrases().find(phrase);
  if (other == OtherPhrases().end()) return std::nullopt;
  return other->second;
}

bool IsFiller(const std::string& word) { return Fillers().count(word) > 0; }

bool TellsOtherQuantity(const std::string& word) {
  return OtherQuantities().count(word) > 0;
}

std::optional<std::string> UnitOf(std::string_view text) {
  const std::string plain = Plain(text);
  int decimals = 0;
  if (plain.empty()) return std::nullopt;
  if (FindTimeUnit(plain, &decimals)) return plain;
  for (const Signal signal : kSignals) {
    for (const Unit& unit : NamesOf(signal).units) {
      if (Plain(unit.name) == plain) return std::string(unit.name);
    }
  }
  const auto other = OtherUnits().find(plain);
  if (other == OtherUnits().end()) return std::nullopt;
  return other->second;
}

}  // namespace armcal

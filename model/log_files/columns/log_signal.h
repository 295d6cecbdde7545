#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace armcal {

// What a log may hold for each joint. kCurrent is a motor current and kVoltage
// what drives a motor, also where an effort column says so by its unit
// ("shoulder/effort [A]", as UR robots report).
// kReference is the position that a controller was told to take.
enum class Signal {
  kPosition,
  kVelocity,
  kAcceleration,
  kEffort,
  kCurrent,
  kReference,
  kTemperature,
  kVoltage
};

constexpr Signal kSignals[] = {Signal::kPosition,     Signal::kVelocity,
                               Signal::kAcceleration, Signal::kEffort,
                               Signal::kCurrent,      Signal::kReference,
                               Signal::kTemperature,  Signal::kVoltage};

struct Unit {
  std::string_view name;
  double scale;  // to SI units
};

// How the columns of a signal are called and measured. To accept another unit,
// add it to the table in log_signal.cc.
struct SignalNames {
  std::string_view number_prefix;  // q in q1
  std::string_view path_part;      // position in shoulder/position
  std::vector<Unit> units;
};

const SignalNames& NamesOf(Signal signal);
// Null where the signal is not measured in that unit.
const Unit* FindUnit(Signal signal, std::string_view name);

bool IsTimeName(std::string_view name);
// Whether time may be counted in this unit, 10^-decimals s.
bool FindTimeUnit(std::string_view name, int* decimals);

// Splits "q1 [deg]" into name and unit; the unit is empty where there is none.
std::string_view SplitUnit(std::string_view name, std::string_view* unit);

// 12 of the name "q12" between "q" and ""; -1 where that is not its shape.
int NumberBetween(std::string_view before, std::string_view after,
                  std::string_view name);

// The names of a header as armcal has them, where it is one of a robot maker's
// recorder: "q1" for the "actual_q_0" of Universal Robots. Other names stay,
// and so does the second of two that would be the same. To read another
// recorder's logs, add it to the table in log_signal.cc.
std::vector<std::string> OwnNames(std::vector<std::string> names);

}  // namespace armcal

#include "calib/watch/event.h"

#include "model/text/format.h"

namespace armcal {
namespace {

constexpr double kHalfWidth95 = 1.96;  // of a normal distribution

std::string Joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names)
    text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

const char* WatchEventName(WatchEvent::Kind kind) {
  switch (kind) {
    case WatchEvent::Kind::kLearned:
      return "learned";
    case WatchEvent::Kind::kContact:
      return "contact";
    case WatchEvent::Kind::kContactEnded:
      return "contact ended";
    case WatchEvent::Kind::kPayload:
      return "payload";
    case WatchEvent::Kind::kFriction:
      return "friction";
    case WatchEvent::Kind::kUndecided:
      return "cannot tell yet";
    case WatchEvent::Kind::kHole:
      return "hole";
    case WatchEvent::Kind::kBadRow:
      return "row skipped";
  }
  return "";
}

bool IsChange(WatchEvent::Kind kind) {
  return kind == WatchEvent::Kind::kContact ||
         kind == WatchEvent::Kind::kPayload ||
         kind == WatchEvent::Kind::kFriction ||
         kind == WatchEvent::Kind::kUndecided;
}

std::string ToText(const WatchEvent& event) {
  std::string text =
      Format("%10.3f s  %-15s", event.time, WatchEventName(event.kind));
  if (!event.joints.empty()) text += " " + Joined(event.joints);
  for (const WatchedValue& value : event.values) {
    text += Format("  %s %.3g +- %.2g %s", value.name.c_str(), value.value,
                   kHalfWidth95 * value.stddev, value.unit.c_str());
  }
  if (event.since_calibration) {
    text += "  other than calibrated";
  } else if (IsChange(event.kind)) {
    text += Format("  since %.3f s", event.onset);
  }
  if (!event.text.empty()) text += "  " + event.text;
  return text;
}

nlohmann::json ToJson(const WatchEvent& event) {
  nlohmann::json values = nlohmann::json::array();
  for (const WatchedValue& value : event.values) {
    values.push_back({{"name", value.name},
                      {"unit", value.unit},
                      {"value", value.value},
                      {"stddev", value.stddev},
                      {"ci95",
                       {value.value - kHalfWidth95 * value.stddev,
                        value.value + kHalfWidth95 * value.stddev}}});
  }
  return {{"event", WatchEventName(event.kind)},
          {"time_s", event.time},
          {"onset_s", event.onset},
          {"delay_s", event.delay()},
          {"joints", event.joints},
          {"values", values},
          {"log_bayes_factor", event.log_bayes},
          {"since_calibration", event.since_calibration},
          {"text", event.text}};
}

}  // namespace armcal

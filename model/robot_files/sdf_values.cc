#include "model/robot_files/sdf_values.h"

#include "model/text/input_text.h"

namespace armcal {

double SdfNumberOr(const XmlElement& owner, const char* tag,
                   const std::string& unit, double absent) {
  const auto child = owner.Child(tag);
  if (!child) return absent;
  double value = 0;
  const std::string text = child->Content();
  const std::string why = WhyNotNumbers(text, 1, unit, &value);
  if (!why.empty()) child->Refuse("", text, why);
  return value;
}

double SdfNonNegativeOr(const XmlElement& owner, const char* tag,
                        const std::string& unit, double absent) {
  const double value = SdfNumberOr(owner, tag, unit, absent);
  if (value >= 0) return value;
  owner.RequiredChild(tag).Refuse(
      "", NumberText(value),
      "expected a number in " + unit + " that is not negative");
}

Eigen::Vector3d SdfVector(const XmlElement& element, const std::string& unit) {
  Eigen::Vector3d v;
  const std::string text = element.Content();
  const std::string why = WhyNotNumbers(text, 3, unit, v.data());
  if (!why.empty()) element.Refuse("", text, why);
  return v;
}

}  // namespace armcal

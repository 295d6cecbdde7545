#pragma once

#include <Eigen/Core>
#include <string>

#include "model/text/xml_element.h"

namespace armcal {

// Numbers of an SDF file, which stand in elements of their own: the content of
// the child `tag`, or `absent` where there is none. InputError for what is no
// number in `unit`.
double SdfNumberOr(const XmlElement& owner, const char* tag,
                   const std::string& unit, double absent);
// The same of a number that must not be negative.
double SdfNonNegativeOr(const XmlElement& owner, const char* tag,
                        const std::string& unit, double absent);
// Three numbers, the element's content.
Eigen::Vector3d SdfVector(const XmlElement& element, const std::string& unit);

}  // namespace armcal

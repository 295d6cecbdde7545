#pragma once

#include <string>
#include <vector>

namespace armcal {

// The names of a header as armcal has them, where they are spelled in another
// way that leaves no doubt: "q1 [deg]" for "Joint 1 Position (deg)", "q1" and
// "q2" for "pos_0" and "pos_1". What a name says are its words, in any case and
// with anything between them: a signal (NamesOf and SignalOf), a number or the
// name of a joint, and a unit. Joints are counted from 0 where each signal's
// columns are. A robot's name or a namespace may stand before joints' names,
// the same before all. Other names stay. Of a robot of one joint no number is
// asked for.
std::vector<std::string> SpelledOut(
    const std::vector<std::string>& names,
    const std::vector<std::string>& joint_names);

}  // namespace armcal

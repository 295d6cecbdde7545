#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/effects/effects.h"
#include "model/log_files/log_reader.h"
#include "model/log_files/time_base.h"
#include "model/robot/robot.h"
#include "model/text/input_error.h"
#include "problems/robust_loss.h"
#include "tools/command.h"

namespace armcal {

// The flags that commands share, parsed in one place. All throw UsageError for
// a value that is not what the flag takes, InputError for what files hold.
FlagGroup TorqueFlags();  // how a log's torques are to be read
FlagGroup ChainFlags();   // which chain of the robot file, and how it hangs

// --robot --base --tip --gravity, unless the input has a robot.
Robot RobotFromFlags(const CommandInput& input);
// A robot of another file, by the same flags but --robot.
Robot RobotOfFile(const std::string& path, const FlagValues& flags);
LogReaderOptions LogOptionsFromFlags(const FlagValues& flags,
                                     const Robot& robot);
Document RobotFileFromFlags(const CommandInput& input);
std::vector<std::string> LogsFromFlags(const CommandInput& input);  // --log
// --validate
std::vector<std::string> ValidationLogsFromFlags(const CommandInput& input);
TimeRange CropFromFlags(const FlagValues& flags);  // --crop
// --validate_crop
TimeRange ValidationCropFromFlags(const FlagValues& flags);
std::optional<double> BandwidthFromFlags(
    const FlagValues& flags);                        // --bandwidth
std::string OutFromFlags(const FlagValues& flags);   // --out
std::string BaseFromFlags(const FlagValues& flags);  // --base
int ThreadsFromFlags(const FlagValues& flags);       // --threads; 0: all cores
// --loss; nothing: what suits the measurement.
std::optional<RobustLoss> LossFromFlags(const FlagValues& flags);

// "1,2.5" and "0:0.5,1:1.5"; `flag` names the flag in the message.
std::vector<double> ParseNumbers(const std::string& flag,
                                 const std::string& text);
double PositiveNumber(const std::string& flag, const std::string& text);
std::vector<TimeRange> ParseRanges(const std::string& flag,
                                   const std::string& text);
std::vector<std::string> SplitAtCommas(const std::string& text);
// The same, none of them empty.
std::vector<std::string> FileNames(const std::string& flag,
                                   const std::string& value);

// The effects of a list of names.
std::vector<const Effect*> ParseEffects(const std::string& flag,
                                        const std::string& text);

// What `make` returns for the robot; where it cannot be (invalid_argument, as
// calib/ throws it), InputError that names the robot file. `where` precedes the
// reason.
template <class Make>
auto MakeForRobot(const CommandInput& input, const std::string& where,
                  Make make) {
  try {
    return make();
  } catch (const std::invalid_argument& error) {
    throw InputError(RobotFileFromFlags(input).name(), "", "",
                     where + error.what());
  }
}

}  // namespace armcal

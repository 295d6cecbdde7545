// The compiled part of the Python package armcal.

#include <glog/logging.h>
#include <pybind11/pybind11.h>

#include "model/text/input_error.h"
#include "model/text/option_name.h"
#include "tools/command.h"
#include "tools/python/command_binding.h"
#include "tools/python/option_binding.h"
#include "tools/python/robot_binding.h"
#include "tools/source_hash.h"
#include "tools/version.h"

PYBIND11_MODULE(_armcal, module) {
  namespace py = pybind11;
  armcal::CheckLibraryVersions();
  armcal::SetOptionPrefix("--");  // the texts of commands are theirs
  FLAGS_logtostderr = true;       // else glog writes to files in /tmp
  module.attr("__version__") = ARMCAL_VERSION;
  module.attr("__sources__") = armcal::SourceHash();
  py::register_exception<armcal::InputError>(module, "InputError",
                                             PyExc_ValueError)
      .attr("__doc__") =
      "Bad input: the file, the place in it, the value "
      "found and what was expected.";
  py::register_exception<armcal::OptionError>(module, "UsageError",
                                              PyExc_ValueError)
      .attr("__doc__") = "An option that is not known, or its value.";
  armcal::AddRobot(&module);
  armcal::AddCommands(&module);
  armcal::AddOptions(&module);
}

#include "tools/python/option_binding.h"

#include <gflags/gflags.h>
#include <pybind11/stl.h>

#include <map>
#include <string>
#include <vector>

#include "model/text/decimal_point.h"
#include "tools/flag_choices.h"
#include "tools/flag_text.h"
#include "tools/python/command_flags.h"

namespace armcal {
namespace {

namespace py = pybind11;

// What Python's functions say of an option.
struct OptionDefinition {
  std::string name, type, form, default_text, description;
  FlagWords words;
};

// What a flag's values are, in words that Python has too.
std::string TypeName(const std::string& flag) {
  static const std::map<std::string, std::string> kNames = {{"string", "str"},
                                                            {"double", "float"},
                                                            {"int32", "int"},
                                                            {"uint64", "int"},
                                                            {"bool", "bool"}};
  return kNames.at(gflags::GetCommandLineFlagInfoOrDie(flag.c_str()).type);
}

std::vector<OptionDefinition> DefinitionsOf(const std::string& command) {
  std::vector<OptionDefinition> definitions;
  for (const std::string& flag : CommandNamed(command).FlagNames()) {
    const FlagText text(flag);
    definitions.push_back({flag, TypeName(flag), text.value, text.default_value,
                           text.description, WordsOf(flag)});
  }
  return definitions;
}

// {name: (default, description)}, in the order of --help.
py::dict OptionsOf(const std::string& command) {
  py::dict options;
  for (const OptionDefinition& option : DefinitionsOf(command)) {
    options[py::str(option.name)] =
        py::make_tuple(option.default_text, option.description);
  }
  return options;
}

}  // namespace

void AddOptions(py::module_* module) {
  using Option = OptionDefinition;
  py::class_<Option>(*module, "Option", "An option of a command, as --help.")
      .def_readonly("name", &Option::name, "The flag's, without dashes.")
      .def_readonly("type", &Option::type, "str, float, int or bool.")
      .def_readonly("form", &Option::form, "HZ, FILES, ..; empty for a bool.")
      .def_readonly("default", &Option::default_text, "Empty: none.")
      .def_readonly("description", &Option::description, "A sentence.")
      .def_property_readonly(
          "words", [](const Option& option) { return option.words.words; },
          "What the value may be, where it is words.")
      .def_property_readonly(
          "several", [](const Option& option) { return option.words.list; },
          "Whether it may be several of the words.");
  module->def("option_definitions", &DefinitionsOf, py::arg("command"),
              py::call_guard<DecimalPoint>(),
              "The options of a command, in the order of --help.");
  module->def("options", &OptionsOf, py::arg("command"),
              py::call_guard<DecimalPoint>(),
              "{name: (default, description)} of a command's flags.");
}

}  // namespace armcal

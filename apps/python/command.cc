#include <pybind11/stl.h>

#include <csignal>
#include <string>
#include <vector>

#include "../lyrefit/line/program.h"
#include "bindings.h"

namespace lyrefit::python {
namespace {

// Python ignores SIGPIPE. The command is ended by it, as by `lyrefit ... | head`.
int RunCommand(std::vector<std::string> arguments) {
  std::signal(SIGPIPE, SIG_DFL);
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  return RunProgram(static_cast<int>(arguments.size()), argv.data());
}

}  // namespace

void BindCommand(py::module_* module) { module->def("_run_command", &RunCommand); }

}  // namespace lyrefit::python

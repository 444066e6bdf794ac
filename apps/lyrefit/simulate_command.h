#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "flags.h"
#include "lyrefit/fit/simulate.h"

namespace lyrefit {

// `lyrefit simulate`: writes the curve of a device as a table that `lyrefit fit` reads.
class SimulateCommand {
 public:
  explicit SimulateCommand(CLI::App* app);
  bool Chosen() const { return command_->parsed(); }
  int Run();

 private:
  Expected<SimulateOptions> Options() const;

  CLI::App* command_;
  SimulateOptions flags_;
  ConditionFlags conditions_;
  std::string from_file_;
  std::vector<std::string> set_list_;
  std::string voltages_;
  std::string out_file_ = "-";
};

}  // namespace lyrefit

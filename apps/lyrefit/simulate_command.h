#pragma once

#include <string>
#include <vector>

#include "command_line.h"
#include "flags.h"
#include "lyrefit/fit/simulate.h"

namespace lyrefit {

// `lyrefit simulate`: writes the curve of a device as a table that `lyrefit fit` reads.
class SimulateCommand {
 public:
  explicit SimulateCommand(CommandLine* line);
  bool Chosen() const { return verb_->Chosen(); }
  int Run();

 private:
  Expected<SimulateOptions> Options() const;
  Expected<void> CheckTargets() const;

  Verb* verb_;
  SimulateOptions flags_;
  ConditionFlags conditions_;
  std::string from_file_;
  std::string layout_file_;
  std::string from_curve_;
  std::vector<std::string> set_list_;
  std::vector<std::string> with_list_;
  std::string voltages_;
  std::string out_file_ = "-";
};

}  // namespace lyrefit

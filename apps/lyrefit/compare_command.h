#pragma once

#include <string>

#include "command_line.h"
#include "study_flags.h"

namespace lyrefit {

// `lyrefit compare`: algorithms against each other, pure and polished, on the same budget.
class CompareCommand {
 public:
  explicit CompareCommand(CommandLine* line);
  bool Chosen() const { return verb_->Chosen(); }
  int Run();

 private:
  Verb* verb_;
  StudyFlags flags_;
  std::string plot_file_;
  std::string convergence_file_;
};

}  // namespace lyrefit

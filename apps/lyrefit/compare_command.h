#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "study_flags.h"

namespace lyrefit {

// `lyrefit compare`: algorithms against each other, pure and polished, on the same budget.
class CompareCommand {
 public:
  explicit CompareCommand(CLI::App* app);
  bool Chosen() const { return command_->parsed(); }
  int Run();

 private:
  CLI::App* command_;
  StudyFlags flags_;
  std::string plot_file_;
  std::string convergence_file_;
};

}  // namespace lyrefit

#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "study_flags.h"

namespace lyrefit {

// `lyrefit sensitivity`: MLO over a grid of its two settings.
class SensitivityCommand {
 public:
  explicit SensitivityCommand(CLI::App* app);
  bool Chosen() const { return command_->parsed(); }
  int Run();

 private:
  CLI::App* command_;
  StudyFlags flags_;
  std::string memory_rates_ = "0,0.25,0.5,0.75,1";
  std::string distance_coefficients_ = "0,0.25,0.5,0.75,1";
};

}  // namespace lyrefit

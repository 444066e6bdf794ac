#pragma once

#include <string>

#include "command_line.h"
#include "study_flags.h"

namespace lyrefit {

// `lyrefit sensitivity`: MLO over a grid of its two settings.
class SensitivityCommand {
 public:
  explicit SensitivityCommand(CommandLine* line);
  bool Chosen() const { return verb_->Chosen(); }
  int Run();

 private:
  Verb* verb_;
  StudyFlags flags_;
  std::string memory_rates_ = "0,0.25,0.5,0.75,1";
  std::string distance_coefficients_ = "0,0.25,0.5,0.75,1";
};

}  // namespace lyrefit

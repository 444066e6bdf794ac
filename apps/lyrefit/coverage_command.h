#pragma once

#include <string>
#include <vector>

#include "command_line.h"
#include "lyrefit/study/coverage.h"

namespace lyrefit {

// `lyrefit coverage`: how often the intervals of joint fits hold parameters that are known.
class CoverageCommand {
 public:
  explicit CoverageCommand(CommandLine* line);
  bool Chosen() const { return verb_->Chosen(); }
  int Run();

 private:
  Verb* verb_;
  CoverageOptions options_;
  std::vector<std::string> set_list_;
  std::string json_file_;
  bool quiet_ = false;
};

}  // namespace lyrefit

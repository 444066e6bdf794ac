#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "lyrefit/study/coverage.h"

namespace lyrefit {

// `lyrefit coverage`: how often the intervals of joint fits hold parameters that are known.
class CoverageCommand {
 public:
  explicit CoverageCommand(CLI::App* app);
  bool Chosen() const { return command_->parsed(); }
  int Run();

 private:
  CLI::App* command_;
  CoverageOptions options_;
  std::vector<std::string> set_list_;
  std::string json_file_;
};

}  // namespace lyrefit

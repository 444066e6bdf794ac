#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "lyrefit/study/audit.h"

namespace lyrefit {

// `lyrefit audit`: checks published parameter rows against the curves they are said to fit.
class AuditCommand {
 public:
  explicit AuditCommand(CLI::App* app);
  bool Chosen() const { return command_->parsed(); }
  int Run();

 private:
  CLI::App* command_;
  AuditOptions options_;
  std::string rows_file_;
  std::string json_file_;
  std::string csv_file_;
  bool brief_ = false;
};

}  // namespace lyrefit

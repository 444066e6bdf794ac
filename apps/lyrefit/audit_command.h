#pragma once

#include <string>

#include "command_line.h"
#include "lyrefit/study/audit.h"

namespace lyrefit {

// `lyrefit audit`: checks published parameter rows against the curves they are said to fit.
class AuditCommand {
 public:
  explicit AuditCommand(CommandLine* line);
  bool Chosen() const { return verb_->Chosen(); }
  int Run();

 private:
  Verb* verb_;
  AuditOptions options_;
  std::string rows_file_;
  std::string json_file_;
  std::string csv_file_;
  bool brief_ = false;
};

}  // namespace lyrefit

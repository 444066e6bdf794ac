#pragma once

#include <string>

#include "command_line.h"
#include "flags.h"
#include "lyrefit/certify/certify.h"

namespace lyrefit {

// `lyrefit certify`: proves how low the measured-current RMSE of a curve can go.
class CertifyCommand {
 public:
  explicit CertifyCommand(CommandLine* line);
  bool Chosen() const { return verb_->Chosen(); }
  int Run();

 private:
  Expected<void> Write(const Certificate& certificate) const;

  Verb* verb_;
  CertifyOptions options_;
  CurveFlags curve_;
  std::string models_ = "sd,dd,td";
  ReportFlags output_;
};

}  // namespace lyrefit

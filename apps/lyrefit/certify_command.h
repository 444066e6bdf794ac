#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "flags.h"
#include "lyrefit/certify/certify.h"

namespace lyrefit {

// `lyrefit certify`: proves how low the measured-current RMSE of a curve can go.
class CertifyCommand {
 public:
  explicit CertifyCommand(CLI::App* app);
  bool Chosen() const { return command_->parsed(); }
  int Run();

 private:
  Expected<void> Write(const Certificate& certificate) const;

  CLI::App* command_;
  CertifyOptions options_;
  CurveFlags curve_;
  std::string models_ = "sd,dd,td";
  ReportFlags output_;
};

}  // namespace lyrefit

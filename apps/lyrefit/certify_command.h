#pragma once

#include <CLI/CLI.hpp>
#include <optional>
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
  Expected<IvCurve> Curve() const;
  Expected<void> CheckTargets() const;
  Expected<void> Write(const Certificate& certificate) const;

  CLI::App* command_;
  CertifyOptions options_;
  ConditionFlags conditions_;
  std::string curve_file_;
  std::optional<int> curve_index_;
  std::string models_ = "sd,dd,td";
  std::string json_file_;
  std::string plot_file_;
  bool brief_ = false;
  bool quiet_ = false;
};

}  // namespace lyrefit

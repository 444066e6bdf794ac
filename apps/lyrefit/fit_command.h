#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bounds_flag.h"
#include "command_line.h"
#include "family_flags.h"
#include "flags.h"
#include "lyrefit/fit/fit.h"
#include "lyrefit/report/fits_table.h"

namespace lyrefit {

// `lyrefit fit`: reads a curve or a set of curves, fits it, writes the report.
class FitCommand {
 public:
  explicit FitCommand(CommandLine* line);
  bool Chosen() const { return verb_->Chosen(); }
  int Run();

 private:
  void AddModelFlags();
  void AddSearchFlags();
  void AddPolishFlags();
  int RunFamilyFit();
  Expected<void> SetFixed();
  Expected<void> SetErrors();
  Expected<void> SetKernel();
  int RunOne();
  int RunMany();
  Expected<void> CheckMany() const;
  Expected<FitReport> FitFile(const std::string& file, int threads, const Observer& observer) const;
  Expected<void> Write(const std::vector<FittedFile>& fits) const;

  Verb* verb_;
  FitOptions options_;
  std::vector<std::string> files_;
  CurveFlags curve_;  // of one file, or of each
  bool auto_model_ = false;
  bool no_polish_ = false;
  BoundsFlags bounds_;
  std::vector<std::string> fix_list_;
  std::vector<std::string> with_list_;
  std::string noise_ = "white";
  std::string kernel_;
  FamilyFlags family_;
  ReportFlags output_;
};

}  // namespace lyrefit

#pragma once

#include <string>
#include <vector>

#include "command_line.h"
#include "flags.h"
#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/diagnose/healthy.h"

namespace lyrefit {

// `lyrefit diagnose`: says what the base model gets wrong in a measurement, and why.
class DiagnoseCommand {
 public:
  explicit DiagnoseCommand(CommandLine* line);
  bool Chosen() const { return verb_->Chosen(); }
  int Run();

 private:
  void AddDiagnosisFlags();
  void AddCatalogueFlags();
  Expected<void> CheckFlags();
  Expected<void> CheckNames() const;
  bool Several() const { return files_.size() > 1 && !together_; }  // measurements
  Expected<CurveSet> Read(const std::vector<std::string>& files) const;
  Expected<Diagnosis> DiagnoseFiles(const std::vector<std::string>& files) const;
  Expected<void> Write(const std::vector<std::string>& names,
                       const std::vector<Diagnosis>& diagnoses) const;
  // diagnose_healthy.cc: against the module's own past.
  void AddHealthyFlags();
  Expected<void> CheckHealthyFlags() const;
  Expected<std::vector<IvCurve>> ReadSweeps(const std::vector<std::string>& files,
                                            const ConditionFlags& conditions) const;
  int RunHealthy();
  int RunModule();
  Expected<void> WriteText(const std::vector<Diagnosis>& diagnoses) const;

  Verb* verb_;
  DiagnoseOptions options_;
  std::vector<std::string> files_;
  ReadOptions reading_;
  bool list_columns_ = false;
  ConditionFlags conditions_;
  std::string effects_;
  std::string noise_ = "field";
  bool no_held_out_ = false;
  bool together_ = false;
  std::string extend_file_;
  std::string answers_file_;
  std::string explain_;
  bool list_ = false;
  std::vector<std::string> healthy_files_;
  bool module_ = false;
  HealthyOptions healthy_;
  ReportFlags output_;
};

}  // namespace lyrefit

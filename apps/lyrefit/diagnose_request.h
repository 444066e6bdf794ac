#pragma once

#include <string>
#include <vector>

#include "flags.h"
#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/diagnose/healthy.h"

namespace lyrefit {

// What was said to `lyrefit diagnose`.
struct DiagnoseRequest {
  std::vector<std::string> files;
  bool together = false;
  ReadOptions reading;
  bool list_columns = false;
  ConditionOptions conditions;
  DiagnoseOptions options;
  std::vector<std::string> healthy_files;
  bool module = false;
  HealthyOptions healthy;
  bool list = false;
  std::string explain;
  ReportFlags output;
  std::string extend_file;
  std::string answers_file;

  bool Several() const { return files.size() > 1 && !together; }  // measurements
};

// diagnose_healthy.cc: against the module's own past.
void AddHealthyFlags(VerbLine* verb, DiagnoseRequest* request);
Expected<void> CheckHealthyFlags(const DiagnoseRequest& request);
Expected<int> RunHealthy(const VerbLine& verb, const DiagnoseRequest& request);
Expected<int> RunModule(const VerbLine& verb, const DiagnoseRequest& request);

}  // namespace lyrefit

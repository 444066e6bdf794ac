#pragma once

#include <string>
#include <vector>

#include "flags.h"
#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/diagnose/reference.h"
#include "lyrefit/read/device_layout.h"
#include "lyrefit/report/documents.h"

namespace lyrefit {

// Values of the flags of `lyrefit diagnose`.
struct DiagnoseRequest {
  std::vector<std::string> files;
  bool together = false;
  ReadOptions reading;
  bool list_columns = false;
  ConditionOptions conditions;
  DiagnoseOptions options;
  std::vector<std::string> reference_files;
  bool module = false;
  DeviceLayout layout;  // by the sheet of the module among `files`
  ReferenceOptions reference;
  bool list = false;
  std::string explain;
  ReportFlags output;
  std::string extend_file;
  std::string answers_file;

  bool Several() const { return files.size() > 1 && !together; }  // several measurements
};

// Comparison with the reference sweeps of the module; defined in diagnose_reference.cc.
void AddReferenceFlags(VerbLine* verb, DiagnoseRequest* request);
Expected<void> CheckReferenceFlags(const DiagnoseRequest& request);
Expected<int> RunReferences(const VerbLine& verb, const DiagnoseRequest& request);
Expected<int> RunModule(const VerbLine& verb, const DiagnoseRequest& request);

}  // namespace lyrefit

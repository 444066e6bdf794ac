#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/diagnose/diagnose_options.h"
#include "lyrefit/estimate/fit/fit_options.h"
#include "lyrefit/read/condition_options.h"
#include "lyrefit/read/read_curve.h"
#include "table_options.h"

namespace lyrefit {

// A verb of the page for one file, with the form's options.
struct PageRequest {
  std::string verb;  // "about", "look", "fit", "diagnose"
  std::string file;
  FormTexts form;
};

Expected<PageRequest> ReadRequest(const std::string& json);

// The forms of the verbs fit and diagnose, from their option tables.
nlohmann::ordered_json DescribeForms();

// Options for reading a file and conditions of its curves.
struct ReadingForm {
  ReadOptions reading;
  ConditionOptions conditions;
};

struct FitForm {
  ReadingForm file;
  FitOptions options;
  bool automatic = false;  // --model auto
};

struct DiagnoseForm {
  ReadingForm file;
  DiagnoseOptions options;
};

// Each function reads its options from the texts of a form and fails for an unknown option.
// ReadLookForm ignores the options of the verbs.
Expected<ReadingForm> ReadLookForm(FormTexts form);
Expected<FitForm> ReadFitForm(FormTexts form);
Expected<DiagnoseForm> ReadDiagnoseForm(FormTexts form);

}  // namespace lyrefit

#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/condition_options.h"
#include "lyrefit/curve/read_curve.h"
#include "lyrefit/diagnose/diagnose_options.h"
#include "lyrefit/fit/fit_options.h"
#include "table_options.h"

namespace lyrefit {

// What the page says of one file and what is to be done with it.
struct PageRequest {
  std::string verb;  // "about", "look", "fit", "diagnose"
  std::string file;
  FormTexts form;
};

Expected<PageRequest> ReadRequest(const std::string& json);

// The forms of the two verbs, made of their option tables.
nlohmann::ordered_json DescribeForms();

// How a file is read and what is said beside it.
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

// Each takes its own out of the texts of a form; an error where something is left that it does not
// know. A look leaves what is meant for the verbs.
Expected<ReadingForm> ReadLookForm(FormTexts form);
Expected<FitForm> ReadFitForm(FormTexts form);
Expected<DiagnoseForm> ReadDiagnoseForm(FormTexts form);

}  // namespace lyrefit

#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/devices/cell_options.h"
#include "lyrefit/devices/stated_sheet.h"
#include "lyrefit/diagnose/diagnose_options.h"
#include "lyrefit/estimate/fit/fit_options.h"
#include "lyrefit/read/condition_options.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/translate/translate_options.h"
#include "table_options.h"

namespace lyrefit {

// A verb of the page, its files, and the form's options.
struct PageRequest {
  std::string verb;  // "about", "look", "fit", "diagnose", "translate", "cell", "datasheet"
  std::string file;
  std::vector<std::string> files;  // those of a cell; for a look all that are there
  FormTexts form;
};

Expected<PageRequest> ReadRequest(const std::string& json);

// An error as an answer: {"error", "message", "file", "line", "column"}.
nlohmann::ordered_json ErrorJson(const Error& error);

// The forms of the verbs, from their option tables.
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

struct TranslateForm {
  ReadingForm file;
  TranslateOptions options;
  std::string module;                // file of its sheet; empty: none
  std::vector<std::string> further;  // files of curves for procedure 3
};

struct CellForm {
  ReadingForm file;
  CellOptions options;
};

// Each function reads its options from the texts of a form and fails for an unknown option.
// ReadLookForm ignores the options of the verbs.
Expected<ReadingForm> ReadLookForm(FormTexts form);
Expected<FitForm> ReadFitForm(FormTexts form);
Expected<DiagnoseForm> ReadDiagnoseForm(FormTexts form);
Expected<TranslateForm> ReadTranslateForm(FormTexts form);
Expected<CellForm> ReadCellForm(FormTexts form);
Expected<StatedSheet> ReadSheetForm(FormTexts form);

}  // namespace lyrefit

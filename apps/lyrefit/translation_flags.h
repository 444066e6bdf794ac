#pragma once

#include <string>

#include "flags.h"
#include "lyrefit/translate/translate.h"

namespace lyrefit {

// Flags of a translation and its field test on the device and its measurement. `whose` ends the
// help text of the file of coefficients.
inline void AddTranslationFlags(VerbLine* verb, const std::string& whose,
                                std::string* coefficients_file, std::string* module_file,
                                TranslateOptions* options) {
  verb->AddOption("--coefficients", coefficients_file,
                  "JSON with alpha_sc_A_K, beta_oc_V_K, ..." + whose + "; flags go before it")
      .Type("FILE")
      .Reads()
      .Group("Coefficients");
  verb->AddOption("--module", module_file, kModuleHelp).Type("FILE").Reads().Group("Field test");
  ForNestedTables(options,
                  [verb](const auto& table, auto* nested) { AddTableFlags(verb, table, nested); });
}

}  // namespace lyrefit

// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/diagnose/diagnose_options.h"
#include "lyrefit/read/device_layout.h"
#include "lyrefit/translate/device_coefficients.h"
#include "lyrefit/translate/field_test_options.h"
#include "lyrefit/translate/procedures.h"
#include "lyrefit/translate/uncertainty_options.h"

namespace LYREFIT_PUBLIC lyrefit {

// Target, procedures and known properties of the device and its measurement.
struct TranslateOptions {
  TranslationTarget target;           // standard conditions
  std::vector<Procedure> procedures;  // empty: all that the data allow
  KeyPointMethod key_points = KeyPointMethod::kInterpolated;
  double lead_resistance_ohm = 0;
  double rear_irradiance_W_m2 = 0;
  double bifaciality_isc = 0;
  std::string technology;  // of the module's sheet, where the curve states none
  StatedCoefficients coefficients;
  std::vector<IvCurve> further;  // of the same device under other conditions, procedure 3
  UncertaintyOptions uncertainty;
  FieldTestOptions field_test;  // scored where a rating is stated
  // By the sheet of the module: cells and bypass diodes that the curve does not state, and modules in
  // series where neither field_test nor the curve has them.
  DeviceLayout layout;
  ChecklistOptions checklist;
  FieldNotes notes;
  DiagnoseOptions diagnosis;  // of the extended model; without hold-out
  // Also computes the linear budgets of the procedures that are not recommended.
  bool all_budgets = true;
};

// Echo of the options of a nested struct that differ from their defaults.
template <auto Member, const auto& Table>
constexpr OptionNest<TranslateOptions> NestedOptions() {
  return {[](const TranslateOptions& options, const TranslateOptions& defaults,
             std::vector<OptionEcho>* echoes) {
    AppendNonDefaults(options.*Member, defaults.*Member, Table, echoes);
  }};
}

// "1000,25" or "STC": irradiance in W/m2 and cell temperature in C.
Expected<void> ReadTarget(const std::string& text, TranslateOptions* options, const TextReaders&);
std::vector<std::string> TargetTexts(const TranslateOptions& options);

inline constexpr OptionRow<TranslateOptions> kTranslateOptionTable[] = {
    OptionRow<TranslateOptions>("Translation"),
    {"to", "G,T", "irradiance in W/m2 and cell temperature in C, or STC",
     OptionText<TranslateOptions>{ReadTarget, TargetTexts}},
    {"procedures", "NAME[,NAME]",
     "those to compute: iec1, iec2, iec3, iec4, desoto, pvsyst, extended",
     EnumListOption<&TranslateOptions::procedures>(), OptionTrait::kNone,
     ": all that the data allow"},
    {"key-points", "NAME", "how Isc, Voc and Pmax are taken from readings",
     EnumOption<&TranslateOptions::key_points>()},
    OptionRow<TranslateOptions>("Measurement"),
    {"lead-resistance", "OHM", "of the leads between the device and where the voltage is read",
     &TranslateOptions::lead_resistance_ohm, 0, 1000},
    {"rear-irradiance-Wm2", "G", "on the back of the module (IEC TS 60904-1-2)",
     &TranslateOptions::rear_irradiance_W_m2, 0, 2000},
    {"bifaciality", "PHI", "Isc under light from the back / from the front",
     &TranslateOptions::bifaciality_isc, 0, 1.5},
    {"coefficients", "", "alpha, beta, ...",
     NestedOptions<&TranslateOptions::coefficients, kCoefficientTable>()},
    {"uncertainty", "", "how sure the inputs are",
     NestedOptions<&TranslateOptions::uncertainty, kUncertaintyOptionTable>()},
    {"field-test", "", "rating and tolerance",
     NestedOptions<&TranslateOptions::field_test, kFieldTestOptionTable>()},
    {"checklist", "", "limits of the conditions",
     NestedOptions<&TranslateOptions::checklist, kChecklistOptionTable>()},
    {"notes", "", "what is printed on the page",
     NestedOptions<&TranslateOptions::notes, kFieldNotesTable>()},
    {"diagnosis", "", "the options of the diagnosis",
     NestedOptions<&TranslateOptions::diagnosis, kDiagnoseOptionTable>()},
};

// Calls see(table, options) for the tables of the nested options, except the diagnosis.
template <class See>
void ForNestedTables(TranslateOptions* options, const See& see) {
  see(kCoefficientTable, &options->coefficients);
  see(kFieldTestOptionTable, &options->field_test);
  see(kUncertaintyOptionTable, &options->uncertainty);
  see(kChecklistOptionTable, &options->checklist);
  see(kFieldNotesTable, &options->notes);
}

// The options of the diagnosis that precedes a translation.
const std::vector<OptionRow<DiagnoseOptions>>& TranslateDiagnosisRows();

// The uncertainties draw with the seed and the threads of the diagnosis.
void ShareSeedAndThreads(TranslateOptions* options);

// Reads a module's data sheet from JSON: rated_power_W, gamma_pmp_percent_K, technology, the layout of
// ReadDeviceLayout, and the coefficients of ReadCoefficients; or from a .PAN file or a row of SAM's
// library of modules (ReadModuleSheet). Options that are set already are
// kept. Errors: neither of them, in JSON a key that no sheet has, a value of the wrong type.
Expected<void> ReadModule(const std::string& path, TranslateOptions* options);

// Errors: an option outside its range, implausible, or without another one that it needs.
Expected<void> ValidateTranslateOptions(const TranslateOptions& options);

}  // namespace lyrefit

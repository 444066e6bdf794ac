#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/translate/device_coefficients.h"
#include "lyrefit/translate/translate_options.h"

namespace lyrefit {

// A curve with everything that its translation needs found once.
struct Preparation {
  PreparedCurve curve;
  SettledInputs inputs;
  std::optional<FitReport> fit;        // of a single diode
  std::optional<Diagnosis> diagnosis;  // where the extended model is wanted
  std::string why_no_model;
  std::vector<std::string> doubts;  // of the readings; see CheckReadings
  std::vector<std::string> warnings;
};

// Corrects the temperature as read to that of the cells (CellCorrection_K), fits, settles the
// coefficients, diagnoses (unless the procedures asked for do without).
// Errors: an unusable curve, readings that are refused (JudgeReadings), no irradiance or temperature known, a dark curve, readings that end
// before the point of maximum power, coefficients or leads that no device has.
Expected<Preparation> Prepare(const IvCurve& read, const TranslateOptions& options,
                              const Observer& observer);

// The single diode of a curve, as fast as a fit goes.
Expected<FitReport> FitOneDiode(const IvCurve& curve, int threads);

}  // namespace lyrefit

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/translate/device_coefficients.h"
#include "lyrefit/translate/translate_options.h"

namespace lyrefit {

// A curve with everything that its translation needs, computed once.
struct Preparation {
  PreparedCurve curve;
  SettledInputs inputs;
  std::optional<FitReport> fit;        // of the single diode
  std::optional<Diagnosis> diagnosis;  // where the extended procedure is requested
  std::string why_no_model;
  std::vector<std::string> doubts;  // of the readings; see CheckReadings
  std::vector<std::string> warnings;
};

// Corrects the measured temperature to that of the cells (CellCorrection_K), fits a single diode,
// completes the coefficients and diagnoses the curve if the extended procedure is requested.
// Errors: an invalid curve, rejected readings (JudgeReadings), unknown irradiance or temperature, a
// dark curve, readings that end before the point of maximum power, implausible coefficients or
// leads.
Expected<Preparation> Prepare(const IvCurve& read, const TranslateOptions& options,
                              const Observer& observer);

// Fits one diode without intervals, which is the fastest fit.
Expected<FitReport> FitOneDiode(const IvCurve& curve, int threads);

}  // namespace lyrefit

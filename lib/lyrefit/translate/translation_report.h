// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/translate/checklist.h"
#include "lyrefit/translate/device_coefficients.h"
#include "lyrefit/translate/field_test.h"
#include "lyrefit/translate/field_test_options.h"
#include "lyrefit/translate/procedures.h"
#include "lyrefit/translate/uncertainty.h"

namespace LYREFIT_PUBLIC lyrefit {

// Result of one procedure, or why there is none.
struct TranslatedResult {
  Procedure procedure = Procedure::kIec1;
  std::string title;    // "IEC 60891 procedure 1"
  std::string why_not;  // empty: it was computed
  KeyPoints key_points{};
  CurvePoints curve;
  UncertaintyBudget budget;  // of Isc, Voc, Imp, Vmp, Pmax, FF: see KeyPointQuantities
  // Range of current beyond open circuit that the readings lack and the single diode covers, in
  // parts of the target's Isc.
  double extrapolated = 0;

  // Whether the procedure gave a result.
  bool computed() const { return why_not.empty(); }
};

// Results of all procedures for one curve, with the conditions of its measurement.
struct TranslationReport {
  std::string version;  // of lyrefit
  IvCurve curve;
  TranslationTarget target;                               // where it was carried to
  KeyPointMethod method = KeyPointMethod::kInterpolated;  // of all key points here
  double equivalent_irradiance_W_m2 = 0;                  // front plus bifaciality times rear
  KeyPoints source{};                                     // of the corrected readings
  SettledInputs inputs;
  std::vector<TranslatedResult> results;  // in the order of Procedure, with those not computed
  int recommended = -1;                   // position in `results`; -1: none was computed
  std::string reason;                     // of the recommendation
  std::optional<Diagnosis> diagnosis;     // where one was made
  std::string verdict;                    // of the diagnosis; empty: none was made
  std::vector<std::string> causes;        // ids of the diagnosed causes
  std::vector<std::string> kept;          // titles of causes that act at the target too
  std::vector<std::string> removed;       // titles of causes of the sweep
  std::optional<FieldTest> field_test;    // where a rating was stated and the target is STC
  Checklist checklist;                    // conditions of the standards
  UncertaintyOptions uncertainty;         // classes of the sensors and the instrument
  FieldNotes notes;
  std::vector<OptionEcho> non_default_options;
  double read_temperature_C = 0;         // measured, before the correction in `inputs`
  std::vector<std::string> assumptions;  // on curve and coefficients
  std::vector<std::string> doubts;       // of the readings, before any fit; see CheckReadings
  std::vector<std::string> warnings;     // including `doubts`
  std::uint64_t seed = 0;
  double seconds = 0;
  bool interrupted = false;

  // The recommended result; nullptr: none was computed.
  const TranslatedResult* Recommended() const {
    return recommended < 0 ? nullptr : &results[recommended];
  }
};

}  // namespace lyrefit

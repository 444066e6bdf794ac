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
#include "lyrefit/translate/field_notes.h"
#include "lyrefit/translate/field_test.h"
#include "lyrefit/translate/procedures.h"
#include "lyrefit/translate/uncertainty.h"

namespace LYREFIT_PUBLIC lyrefit {

// What one procedure makes of the curve, or why it makes nothing.
struct TranslatedResult {
  Procedure procedure = Procedure::kIec1;
  std::string title;    // "IEC 60891 procedure 1"
  std::string why_not;  // empty: it was computed
  KeyPoints key_points{};
  CurvePoints curve;
  UncertaintyBudget budget;  // Isc, Voc, Imp, Vmp, Pmax, FF: see KeyPointQuantities
  // How much of the curve at the target lies where nothing was read and the single diode stands in:
  // in parts of Isc (beyond open circuit).
  double extrapolated = 0;

  // Whether the procedure gave a curve.
  bool computed() const { return why_not.empty(); }
};

// A curve at other conditions.
struct TranslationReport {
  std::string version;  // of lyrefit
  IvCurve curve;
  TranslationTarget target;                               // where it was carried to
  KeyPointMethod method = KeyPointMethod::kInterpolated;  // of all key points here
  double equivalent_irradiance_W_m2 = 0;                  // front and back
  KeyPoints source{};                                     // of the readings, leads allowed for
  SettledInputs inputs;
  std::vector<TranslatedResult> results;  // in the order of Procedure, those without one among them
  int recommended = -1;                   // position in `results`; -1: none was computed
  std::string reason;                     // why that one
  std::optional<Diagnosis> diagnosis;     // where one was made, and what follows of it
  std::string verdict;                    // its own; empty: none was made
  std::vector<std::string> causes;        // its ids
  std::vector<std::string> kept;          // titles of causes that act at the target too
  std::vector<std::string> removed;       // of those that were of the sweep
  std::optional<FieldTest> field_test;    // where a rating was stated and the target is STC
  Checklist checklist;                    // what the standards ask for
  UncertaintyOptions uncertainty;         // what light, temperature and instrument are
  FieldNotes notes;
  std::vector<OptionEcho> non_default_options;
  double read_temperature_C = 0;         // before the cells' correction, which is in `inputs`
  std::vector<std::string> assumptions;  // of the reader, of the coefficients
  std::vector<std::string> doubts;       // of the readings, before any fit; see CheckReadings
  std::vector<std::string> warnings;     // these doubts among them
  std::uint64_t seed = 0;
  double seconds = 0;
  bool interrupted = false;

  // The result to quote; nullptr: none was computed.
  const TranslatedResult* Recommended() const {
    return recommended < 0 ? nullptr : &results[recommended];
  }
};

}  // namespace lyrefit

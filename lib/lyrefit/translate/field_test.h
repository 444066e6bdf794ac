// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/translate/field_test_options.h"
#include "lyrefit/translate/procedures.h"
#include "lyrefit/translate/uncertainty.h"

namespace LYREFIT_PUBLIC lyrefit {

// Zone of Pmax at standard conditions against the least power L that the rating allows, by the
// probability of conformity (JCGM 106, 7.4): that the true power is at least L. The interval is the
// expanded one, k = 2, or the drawn one where both disagree:
//
//   pass                     at least 80 %, and the interval is at or above L
//   pass within uncertainty  at least 80 %, a part of the interval is below L
//   undecided                more than 20 %, less than 80 %
//   fail within uncertainty  at most 20 %, a part of the interval is at or above L
//   fail                     at most 20 %, and the interval is below L
//   doubtful                 not scored: implausible readings (curve/plausibility.h), or a power of
//                            more than 1.5 times the rating or less than 0.1 of it (wrong units,
//                            the rating of another device, wrong irradiance)
//
// Field instruments use these zones for Voc and Isc, with the instrument's error in place of the
// uncertainty (HT I-V600 manual, 6.5.2.1). A power above the upper tolerance does not fail; it
// casts doubt on the irradiance or the rating.
enum class Zone { kPass, kPassWithin, kUndecided, kFailWithin, kFail, kDoubtful };

template <>
struct EnumTable<Zone> {
  static constexpr EnumText<Zone> kRows[] = {
      {Zone::kPass, "pass"},           {Zone::kPassWithin, "pass within uncertainty"},
      {Zone::kUndecided, "undecided"}, {Zone::kFailWithin, "fail within uncertainty"},
      {Zone::kFail, "fail"},           {Zone::kDoubtful, "doubtful"}};
};

// Passes, with or without the interval crossing the limit.
inline bool IsPass(Zone zone) { return zone == Zone::kPass || zone == Zone::kPassWithin; }
inline bool IsFail(Zone zone) { return zone == Zone::kFail || zone == Zone::kFailWithin; }

// One measurement, with its conditions.
struct FieldMeasurement {
  KeyPoints measured = {};            // as read
  TranslationInputs inputs;           // irradiance, temperature, gains, leads
  std::optional<double> predicted_W;  // Pmax at these conditions by a model of the faultless string
  std::string predicted_by;           // name of that model
  std::string doubt;                  // why the readings are implausible; empty: they are not
};

// Power of a string against its rating, with the probability of a wrong verdict.
struct FieldTest {
  double rated_W = kUnknown;     // of the string: modules times rating, less cabling
  double lowest_W = kUnknown;    // the rating less its tolerance
  double highest_W = kUnknown;   // the rating plus its tolerance
  std::string tolerance;         // as printed
  double standard_W = kUnknown;  // Pmax at standard conditions, and its interval
  double standard_low_W = kUnknown;
  double standard_high_W = kUnknown;
  Zone zone = Zone::kPass;
  std::string doubt;  // why it is not scored; empty: it is
  // Probability that the true power is at least L. The prior is flat: no information but this
  // measurement. NaN where the test is not scored.
  double probability_conforms = kUnknown;
  double probability_wrong = kUnknown;  // that it is on the other, less probable side of L
  double probability_step = 0;          // resolution of the probability, 1 / draws; 0: no draws
  double measured_W = kUnknown;
  double predicted_W = kUnknown;  // at the conditions measured
  std::string predicted_by;       // name of the prediction's model
  // Measured over predicted Pmax. Its own budget has rating, coefficient, sensors and instrument,
  // but no translation procedure.
  double performance_factor = kUnknown;
  double performance_low = kUnknown;
  double performance_high = kUnknown;
  UncertaintyBudget performance_budget;
  std::string sentence;
  std::vector<std::string> notes;  // sentences
};

// `standard`: Pmax in W at 1000 W/m2 and 25 C. Errors: no rating, a rating or a power that is not
// positive, options outside their ranges.
Expected<FieldTest> JudgeFieldTest(const UncertainOutput& standard,
                                   const FieldMeasurement& measurement,
                                   const FieldTestOptions& options,
                                   const UncertaintyOptions& uncertainty,
                                   const Observer& observer = {});

// The zone of an interval against its limit.
Zone ZoneOf(double low, double high, double limit, double conforms);

// The probability of conformity, "96.3 %".
std::string ConformityText(const FieldTest& test);

}  // namespace lyrefit

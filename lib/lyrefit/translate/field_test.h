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

// Pmax at standard conditions against the least that the rating allows, L. The interval is the
// expanded one, k = 2, or the drawn one where both disagree:
//
//   pass                     all of it at or above L
//   pass within uncertainty  the value at or above L, a part of the interval below
//   fail within uncertainty  the value below L, a part of the interval at or above
//   fail                     all of it below L
//   doubtful                 not judged: no device has such readings (curve/plausibility.h), or the
//                            power is far above the rating (more than 1.5 times: other units than
//                            were read, the rating of another device, light that was not stated)
//
// as field instruments give them for Voc and Isc (HT I-V600 manual, 6.5.2.1), where the instrument's
// error has the place of the uncertainty. More power than the upper tolerance is no failure; it is
// a doubt about the light or the rating.
enum class Zone { kPass, kPassWithin, kFailWithin, kFail, kDoubtful };

template <>
struct EnumTable<Zone> {
  static constexpr EnumText<Zone> kRows[] = {{Zone::kPass, "pass"},
                                             {Zone::kPassWithin, "pass within uncertainty"},
                                             {Zone::kFailWithin, "fail within uncertainty"},
                                             {Zone::kFail, "fail"},
                                             {Zone::kDoubtful, "doubtful"}};
};

// For sure or within the uncertainty.
inline bool IsPass(Zone zone) { return zone == Zone::kPass || zone == Zone::kPassWithin; }

// What was measured, and where.
struct FieldMeasurement {
  KeyPoints measured = {};            // as read
  TranslationInputs inputs;           // light, temperature, gains, leads
  std::optional<double> predicted_W;  // Pmax at these conditions by a model of the healthy string
  std::string predicted_by;           // what gave it, in words
  std::string doubt;                  // why no device has such readings; empty: nothing is doubted
};

// Whether a string does what its rating says, and how sure that is.
struct FieldTest {
  double rated_W = kUnknown;     // of the string: modules times rating, less cabling
  double lowest_W = kUnknown;    // the rating less its tolerance
  double highest_W = kUnknown;   // the rating with it
  std::string tolerance;         // of the rating, as printed
  double standard_W = kUnknown;  // Pmax at standard conditions, and its interval
  double standard_low_W = kUnknown;
  double standard_high_W = kUnknown;
  Zone zone = Zone::kPass;
  std::string doubt;  // why it cannot be judged; empty: it is
  // That the true value is on the other side of L than what the verdict says. The prior is flat:
  // nothing is known of the string but this measurement. NaN where it is not judged.
  double probability_wrong = kUnknown;
  double probability_step =
      0;  // 1 / draws: what smaller probabilities cannot be told from; 0: none
  double measured_W = kUnknown;
  double predicted_W = kUnknown;  // at the conditions measured
  std::string predicted_by;       // what gave the prediction, in words
  // Measured over predicted Pmax, with a budget of its own: nothing but rating, coefficient,
  // sensors and instrument is in it, no procedure.
  double performance_factor = kUnknown;
  double performance_low = kUnknown;
  double performance_high = kUnknown;
  UncertaintyBudget performance_budget;
  std::string sentence;
  std::vector<std::string> notes;  // sentences
};

// `standard`: Pmax at 1000 W/m2 and 25 C. Errors: no rating, a rating or a power that is not
// positive, options outside their ranges.
Expected<FieldTest> JudgeFieldTest(const UncertainOutput& standard,
                                   const FieldMeasurement& measurement,
                                   const FieldTestOptions& options,
                                   const UncertaintyOptions& uncertainty,
                                   const Observer& observer = {});

// The zone of an interval against its limit.
Zone ZoneOf(double value, double low, double high, double limit);

}  // namespace lyrefit

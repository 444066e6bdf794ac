// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/translate/field_test_options.h"
#include "lyrefit/translate/procedures.h"
#include "lyrefit/translate/uncertainty_options.h"

namespace LYREFIT_PUBLIC lyrefit {

// Whether a condition of a standard is met.
enum class Condition { kMet, kNotMet, kNotKnown };

template <>
struct EnumTable<Condition> {
  static constexpr EnumText<Condition> kRows[] = {{Condition::kMet, "met"},
                                                  {Condition::kNotMet, "not met"},
                                                  {Condition::kNotKnown, "not known"}};
};

// One condition that a standard requires, and its state.
struct CheckedCondition {
  std::string id;                          // "irradiance", "steadiness", ...
  std::string title;                       // "light above 700 W/m2"
  Condition state = Condition::kNotKnown;  // stays unknown until somebody states or measures it
  double value = kUnknown;                 // the figure, in `unit`
  double limit = kUnknown;                 // threshold for `value`, in `unit`
  std::string unit;
  std::string found;   // `value` in words; empty where it is unknown
  std::string source;  // origin of the value
  std::string clause;  // clause of the standard that requires it; empty: lyrefit's own
  std::string cure;    // how to determine or meet it; empty where it is met
};

// All conditions, and how many have each state.
struct Checklist {
  std::vector<CheckedCondition> conditions;  // in a fixed order
  int met = 0;                               // conditions that are met
  int not_met = 0;                           // conditions that are not met
  int not_known = 0;                         // conditions that nobody stated or measured
  std::string sentence;
};

// Inputs of CheckConditions besides the curve.
struct ConditionFacts {
  const Diagnosis* diagnosis = nullptr;  // of this curve, for steady light; or nullptr
  UncertaintyOptions uncertainty;        // classes of sensors and instrument
  std::optional<Procedure> procedure;    // the one used for the step to `target`
  TranslationTarget target;              // conditions of the translated curve
};

// Checks the conditions of IEC 61829:2015 (as summarised by others), IEC 60904-1, IEC 60891:2021
// and IEC 62446-1, in a fixed order. A condition is met only if somebody has stated or measured it.
Checklist CheckConditions(const IvCurve& curve, const ConditionFacts& facts,
                          const ChecklistOptions& options);

}  // namespace lyrefit

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/translate/checklist_options.h"
#include "lyrefit/translate/procedures.h"
#include "lyrefit/translate/uncertainty_options.h"

namespace LYREFIT_PUBLIC lyrefit {

// Whether something that a standard asks for held.
enum class Condition { kMet, kNotMet, kNotKnown };

template <>
struct EnumTable<Condition> {
  static constexpr EnumText<Condition> kRows[] = {{Condition::kMet, "met"},
                                                  {Condition::kNotMet, "not met"},
                                                  {Condition::kNotKnown, "not known"}};
};

// One thing that a standard asks for, and what is known of it.
struct CheckedCondition {
  std::string id;                          // "irradiance", "steadiness", ...
  std::string title;                       // "light above 700 W/m2"
  Condition state = Condition::kNotKnown;  // nothing is met that nobody measured or said
  double value = kUnknown;                 // the figure, in `unit`
  double limit = kUnknown;                 // what it is held against, in the same
  std::string unit;
  std::string found;   // the figure in words; empty where nothing is known
  std::string source;  // where the figure is from
  std::string clause;  // of the standard that asks for it; empty: ours
  std::string cure;    // what would make it known, or met; empty where it is met
};

// All that the standards ask for.
struct Checklist {
  std::vector<CheckedCondition> conditions;  // in a fixed order
  int met = 0;                               // conditions that are met
  int not_met = 0;                           // that are not
  int not_known = 0;                         // of which nobody knows
  std::string sentence;
};

// What the conditions of one curve are judged by.
struct ConditionFacts {
  const Diagnosis* diagnosis = nullptr;  // of this curve: what it says of the light; may be missing
  UncertaintyOptions uncertainty;        // sensors and instrument
  std::optional<Procedure> procedure;    // that carries it to `target`
  TranslationTarget target;              // where the curve is carried to
};

// The conditions that IEC 61829:2015 (as summarised by others), IEC 60904-1, IEC 60891:2021 and
// IEC 62446-1 ask for, one after the other. Nothing is taken as met that nobody has said or
// measured.
Checklist CheckConditions(const IvCurve& curve, const ConditionFacts& facts,
                          const ChecklistOptions& options);

}  // namespace lyrefit

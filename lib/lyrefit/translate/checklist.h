#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/translate/checklist_options.h"
#include "lyrefit/translate/procedures.h"
#include "lyrefit/translate/uncertainty_options.h"

namespace lyrefit {

enum class Condition { kMet, kNotMet, kNotKnown };

template <>
struct EnumTable<Condition> {
  static constexpr EnumText<Condition> kRows[] = {{Condition::kMet, "met"},
                                                  {Condition::kNotMet, "not met"},
                                                  {Condition::kNotKnown, "not known"}};
};

struct CheckedCondition {
  std::string id;     // "irradiance", "steadiness", ...
  std::string title;  // "light above 700 W/m2"
  Condition state = Condition::kNotKnown;
  double value = kUnknown;  // the figure, in `unit`
  double limit = kUnknown;
  std::string unit;
  std::string found;   // the figure in words; empty where nothing is known
  std::string source;  // where the figure is from
  std::string clause;  // of the standard that asks for it; empty: ours
  std::string cure;    // what would make it known, or met; empty where it is met
};

struct Checklist {
  std::vector<CheckedCondition> conditions;
  int met = 0;
  int not_met = 0;
  int not_known = 0;
  std::string sentence;
};

// What the conditions of one curve are judged by.
struct ConditionFacts {
  const Diagnosis* diagnosis = nullptr;  // of this curve: what it says of the light; may be missing
  UncertaintyOptions uncertainty;        // sensors and instrument
  std::optional<Procedure> procedure;    // that carries it to `target`
  TranslationTarget target;
};

// The conditions that IEC 61829:2015 (as summarised by others), IEC 60904-1, IEC 60891:2021 and
// IEC 62446-1 ask for, one after the other. Nothing is taken as met that nobody has said or
// measured.
Checklist CheckConditions(const IvCurve& curve, const ConditionFacts& facts,
                          const ChecklistOptions& options);

}  // namespace lyrefit

#pragma once

#include <string>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"
#include "lyrefit/model/parameter.h"

namespace LYREFIT_PUBLIC lyrefit {

enum class BoundSide { kNone, kLower, kUpper };  // Active bound of a parameter.

template <>
struct EnumTable<BoundSide> {
  static constexpr EnumText<BoundSide> kRows[] = {
      {BoundSide::kNone, "none"}, {BoundSide::kLower, "lower"}, {BoundSide::kUpper, "upper"}};
};

// Method of an interval.
enum class IntervalMethod {
  kNone,       // fixed parameter, or intervals not requested
  kSymmetric,  // estimate -+ t x standard error on the parameter's scale, clipped to the bounds
  kProfile,    // ends where the profiled sum of squares reaches the F threshold, or at a bound
  kUnsettled,  // profile without the threshold on one side: the true end lies outside
};

template <>
struct EnumTable<IntervalMethod> {
  static constexpr EnumText<IntervalMethod> kRows[] = {
      {IntervalMethod::kNone, "none"},
      {IntervalMethod::kSymmetric, "symmetric"},
      {IntervalMethod::kProfile, "profile"},
      {IntervalMethod::kUnsettled, "unsettled profile"}};
};

// A value with its 95 % interval.
struct Ranged {
  double value = kUnknown;  // the estimate
  double low_95 = kUnknown;
  double high_95 = kUnknown;
};

// One parameter: its values after the search and after the polish, in reporting units. NaN: not
// available (no polish, or no finite standard error).
struct Estimate {
  ParameterInfo info;
  ParameterBounds bounds;
  bool fixed = false;
  bool free() const { return !fixed && bounds.whole == 0; }  // integers are enumerated, not fitted
  double searched = kUnknown;
  double refined = kUnknown;
  double standard_error = kUnknown;
  double low_95 = kUnknown;
  double high_95 = kUnknown;
  IntervalMethod interval = IntervalMethod::kNone;  // method of low_95 and high_95
  BoundSide at_bound = BoundSide::kNone;
  bool identifiable = true;
  std::string reason;  // why not identifiable, as a phrase
};

// Two strongly correlated parameters.
struct Correlation {
  std::string first;   // symbol
  std::string second;  // symbol of the other
  double value = 0;    // correlation coefficient, -1 to 1
};

}  // namespace lyrefit

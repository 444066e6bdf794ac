#pragma once

#include <string>
#include <vector>

#include "faults/adapter.h"
#include "faults/field_case.h"

namespace faults::field {

// A quantity that an accepted claim reports, beside its true value.
struct Compared {
  std::string quantity;
  double truth;
  double value;
  bool interval = false;  // the claim has an interval
  bool holds = false;     // the interval contains the truth
};

struct CaseScore {
  bool named = false;        // at least one claim
  bool first_right = false;  // the first name is accepted
  bool any_right = false;
  int claims = 0;
  int in_set = 0;    // claims whose name is not accepted, but one that is said beside it
  int spurious = 0;  // claims of which neither is accepted
  std::string first = "-";
  std::vector<Compared> compared;
};

// Scores an answer. Two sorts of claims do not count: quantisation and outliers, which are no
// module faults, and the second diode of a laboratory curve that has one.
CaseScore ScoreCase(const Case& made, const Answer& answer);

}  // namespace faults::field

#pragma once

#include <string>
#include <vector>

#include "hidden/adapter.h"
#include "hidden/field_case.h"

namespace hidden::field {

// A number that an accepted claim reads off, beside the true one.
struct Compared {
  std::string quantity;
  double truth;
  double value;
  bool interval = false;  // there is one
  bool holds = false;     // and the truth lies within
};

struct Judgement {
  bool named = false;        // anything
  bool first_right = false;  // first name accepted
  bool any_right = false;
  int claims = 0;
  int spurious = 0;  // not accepted
  std::string first = "-";
  std::vector<Compared> compared;
};

// Resolution and outliers are no faults of a module, and the second diode of a bench curve that has
// one is no false alarm: such claims do not count.
Judgement Judge(const Case& made, const Answer& answer);

}  // namespace hidden::field

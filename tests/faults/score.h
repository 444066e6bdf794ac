#pragma once

#include <optional>
#include <string>
#include <vector>

#include "faults/adapter.h"
#include "faults/case.h"

namespace faults {

// All claims but that of a second diode which the device really has.
std::vector<Claim> Counted(const Case& made, const Answer& answer);

// Whether a claim identifies the cause. Either its name is acceptable, or its set contains the
// cause and at most two names of claim and set are not acceptable.
bool Names(const Claim& claim, const Cause& cause);

struct CaseScore {
  bool detected = false;
  bool first_right = false;  // the first name is acceptable
  bool in_set = false;       // the cause itself is among the names of the first claim
  bool named = false;        // any claim identifies the cause (Names)
  int set_size = 0;
  std::string first = "-";
};

CaseScore ScoreCase(const Case& made, const Answer& answer, std::size_t cause = 0);

// First strength of the claim that names the cause, in the unit of the cause without milli, micro
// or percent. Empty if the units have different dimensions.
struct Sized {
  double value;
  double low;
  double high;
};
std::optional<Sized> SizeOf(const Cause& cause, const Answer& answer);

}  // namespace faults

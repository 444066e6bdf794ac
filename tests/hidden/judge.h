#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hidden/adapter.h"
#include "hidden/case.h"

namespace hidden {

// Claims that count: not the second diode a device really has.
std::vector<Claim> Counted(const Case& made, const Answer& answer);

// The first claim's name is among the acceptable ones, or its set holds the cause with at most two
// names besides that are not acceptable.
bool Names(const Claim& claim, const Cause& cause);

struct Judgement {
  bool detected = false;
  bool first_right = false;  // first name acceptable
  bool in_set = false;       // the cause itself among the first claim's names
  bool named = false;        // by Names, in any claim
  int set_size = 0;
  std::string first = "-";
};

Judgement Judge(const Case& made, const Answer& answer, std::size_t cause = 0);

// The first strength of the claim that names the cause in its own unit, made plain: without
// milli, micro or percent. Nothing where the units differ.
struct Sized {
  double value;
  double low;
  double high;
};
std::optional<Sized> SizeOf(const Cause& cause, const Answer& answer);

}  // namespace hidden

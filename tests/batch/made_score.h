#pragma once

#include <string>

namespace made {

struct ScoreRequest {
  std::string results;  // a row a string: id, and of the columns below what there is
  std::string truth;    // as WritePlant writes it
};

// What of the hidden faults was found, and what was called a fault that is none. A row is an alarm
// if `cause` names one, `group_flag` is true or `zone` is fail. It is right if the truth accepts
// `cause` or one of its `equivalents`; where no cause is named, if it accepts what `group_outlier` says
// is too low or too high ("Voc-").
// Returns what went wrong, empty if nothing did; `text` is the score.
std::string Score(const ScoreRequest& request, std::string* text);

}  // namespace made

#pragma once

#include <string>

namespace made {

struct ScoreRequest {
  std::string results;  // one row per string: id, and those of the columns below that exist
  std::string truth;    // as written by WritePlant
};

// Counts the faults that were found and the false alarms. A row is an alarm if `cause` is set,
// `group_flag` is true or `zone` is a fail. It has a right name if the truth accepts `cause` or one
// of its `equivalents`. Without a cause, the deviations in `group_outlier` count as names ("Voc-"
// for a Voc that is too low).
// Returns an error message, empty on success; `text` is the score.
std::string Score(const ScoreRequest& request, std::string* text);

// The same for the changes of a later campaign (PlantRequest::years). `campaign` is the campaign.json
// of the results. Counts the changes that were found and those with an accepted name, the strings
// without a change that were called changed, and the watts; shares with Wilson's 95 % limits.
struct ChangeScoreRequest {
  std::string results, campaign, truth;
};
std::string ScoreChanges(const ChangeScoreRequest& request, std::string* text);

}  // namespace made

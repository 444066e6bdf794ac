#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lyrefit/model/cause.h"
#include "plant/campaign.h"

namespace lyrefit {

// Sentences on changes.

// What is said of one string. `equivalents` are the candidates, the most probable first: ids of
// effects, and missing_module, other_module, cleaning, repair, exchanged.
Cause CauseOf(const Campaign& campaign, const std::vector<CampaignString>& before,
              const std::vector<CampaignString>& after, std::size_t i);

// What a change that all strings share may come from. `whose`: the subject of the sentence.
std::string CommonSentence(const CampaignGroup& group, const char* whose);

std::vector<std::string> IdsIn(const std::string& words);  // with spaces between them

double Percent(double logarithm);                    // of a ratio, less 1
double Half95(const CampaignChange& change, int q);  // half-width of the 95 % interval
bool HasChange(const CampaignChange& change);        // there are figures of both campaigns

}  // namespace lyrefit

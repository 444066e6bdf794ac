#pragma once

#include <string>
#include <vector>

#include "lyrefit/report/document.h"
#include "plant/campaign_summary.h"

namespace lyrefit {

// The section "Since the last campaign" of the summary and of the plant's page: what all strings
// share, the strings that changed by watts lost, exchanged, gone and new ones. At most `most` rows a
// table. Empty without a comparison.
std::vector<Section> CampaignSections(const CampaignSummary& summary, std::size_t most);

// Watts lost of the strings that changed, with their intervals. Without such strings it has no panel.
block::Figure CampaignFigureOf(const CampaignSummary& summary);

// "23 of 500 strings changed since the last campaign: 5.2 kW lost, 0.6 kW gained."
std::string CampaignVerdict(const CampaignSummary& summary);

}  // namespace lyrefit

#pragma once

#include <string>
#include <vector>

#include "lyrefit/report/document.h"
#include "plant/campaign_summary.h"
#include "plant/plant_summary.h"

namespace lyrefit {

// What the page of a plant is made of.
struct PlantContent {
  std::string plant;                  // its name
  PlantSummary summary;               // of the rows
  CampaignSummary campaign;           // with earlier results
  std::vector<ResultColumn> columns;  // of the table of all rows
  std::vector<block::Field> facts;    // about the whole plant: an instrument, an option, the seed
  std::string results;                // prefix from the page to the folder of the results
};

// Verdict, pictures and tables: what is lost where, what changed since the last campaign, which strings to visit first, all strings,
// distributions, neighbours, strings without a result.
Document PlantDocument(const PlantContent& content);

}  // namespace lyrefit

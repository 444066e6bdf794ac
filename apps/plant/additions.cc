#include "plant/additions.h"

#include "plant/campaign_results.h"
#include "plant/neighbours.h"
#include "plant/samples.h"
#include "plant/scale_rows.h"
#include "plant/string_verdict.h"

namespace lyrefit {

BatchAdditions PlantAdditions(const PlantOptions& options, PlantResults* results) {
  return {std::make_shared<NeighbourAddition>(options, results),
          std::make_shared<ScaleAddition>(results), std::make_shared<SampleAddition>(results),
          std::make_shared<CampaignAddition>(options, results), std::make_shared<StringAddition>()};
}

}  // namespace lyrefit

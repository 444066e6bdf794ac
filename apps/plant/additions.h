#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/batch/batch_options.h"
#include "plant/campaign_summary.h"
#include "plant/sample_summary.h"

namespace LYREFIT_PUBLIC lyrefit {

// How the rows of a plant are compared with each other, and with those of an earlier run.
struct PlantOptions {
  // For the comparison of strings with their neighbours: see neighbours.h.
  double group_level = 0.001;
  double like_light = 0.05;
  // Results of an earlier run of task field-test on the same plant, a folder or a file: each string
  // is compared with its own earlier figures (campaign.h). Empty: none. The figures of both runs are
  // kept in memory, 560 bytes a string.
  std::string before;
  double change_level = 0.05;
};

inline constexpr OptionRow<PlantOptions> kPlantOptionTable[] = {
    OptionRow<PlantOptions>("Batch"),
    {"group-level", "", "rate at which healthy strings differ from those of their combiner",
     &PlantOptions::group_level, 1e-6, 0.2},
    {"like-light", "", "how far apart irradiances may be that are compared, in parts",
     &PlantOptions::like_light, 0.001, 0.5},
    {"change-level", "",
     "probability that any string without a change is called changed since --before",
     &PlantOptions::change_level, 1e-6, 0.5},
};

// What the additions found in all rows, as numbers. The report of the run has it as text.
struct PlantResults {
  std::int64_t compared = 0;                        // number of strings with neighbours
  std::int64_t flagged = 0;                         // of `compared`: flagged as different
  std::map<std::string, std::int64_t> plan_causes;  // number of rows for each cause of the scale
  std::vector<SampleSummary> samples;               // of task `cell`
  std::string working_pixel;                        // when a pixel works, in one sentence
  CampaignSummary campaign;                         // with earlier results
};

// The additions of the command: each compares the rows of a plant in its own way and adds its cells,
// its files and what it says in the report. Rows that lack what one needs are left as they are.
//   neighbours  strings of a combiner with each other (neighbours.h)
//   scale       strings with their plan and with each other, for rows of a task WithPlan
//               (scale_judge.h)
//   samples     samples.csv and samples.jsonl with the statistics of each sample and direction, for
//               rows of task `cell` (samples.h)
//   campaign    strings with themselves in earlier results, and campaign.json (campaign.h)
//   verdict     one verdict a string, of all of these together, on its row and its page
//               (string_verdict.h)
// `results`, unless it is null, is set when the results of a run are written. Shards are merged with
// any options: those of their runs stand in their heads.
BatchAdditions PlantAdditions(const PlantOptions& options = {}, PlantResults* results = nullptr);

}  // namespace lyrefit

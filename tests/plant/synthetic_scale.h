#pragma once

#include <cstdint>
#include <string>

namespace made {

// Small simulated plants whose strings have faults that change the scale of a curve and not its
// shape: two combiners of nine strings each, and a plan. Every cell of every module is simulated
// (faults/field_module.h).
//
// Per plant: type and number of modules, weather, and how far its modules are from their data
// sheet. Three to four strings have a fault; in every third plant one combiner has an error that all
// its strings share (a sensor, or dirt).
struct ScalePlantsRequest {
  std::string folder;  // gets plantNNN/strings.csv, plantNNN/plan.csv, plantNNN/truth.csv, *.json
  int plants = 200;
  std::uint64_t seed = 1;
  int threads = 0;  // 0: all cores; the output does not depend on it
};

// Returns an error message, empty on success.
std::string WriteScalePlants(const ScalePlantsRequest& request);

// Reads FOLDER/plantNNN/RESULTS/results.csv beside FOLDER/plantNNN/truth.csv. A name is right if
// plan_cause is the fault, or if it is its twin, which no measurement of the string can tell from
// it: soiling and a light sensor that reads high. A claim is wrong if neither the cause nor one of
// plan_equivalents is the fault. Each rate has its 95 % interval by Wilson. `planned`: else only
// faults that neighbours can show count.
struct ScaleScoreRequest {
  std::string folder;
  std::string results;
  bool planned = true;
};
std::string ScoreScalePlants(const ScaleScoreRequest& request, std::string* text);

}  // namespace made

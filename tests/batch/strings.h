#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "lyrefit/batch/batch.h"
#include "lyrefit/batch/checkpoint.h"
#include "temp_folder.h"

namespace lyrefit {

// A string of a combiner, as one row of JSON Lines. The curve is an explicit function, not a diode
// model.
struct SyntheticString {
  std::string id;
  double isc_A = 9;
  double voc_V = 40;
  double irradiance_W_m2 = 1000;
  int points = 30;
};

inline std::string RowOf(const SyntheticString& string) {
  std::string voltages, currents;
  for (int i = 0; i < string.points; ++i) {
    const double v = string.voc_V * i / (string.points - 1);
    const double current =
        string.isc_A * (1 - std::expm1(v / (0.06 * string.voc_V)) / std::expm1(1 / 0.06) -
                        0.02 * i / string.points);
    voltages += fmt::format("{}{:.5g}", i == 0 ? "" : ",", v);
    currents += fmt::format("{}{:.5g}", i == 0 ? "" : ",", current);
  }
  return fmt::format(
      R"({{"id":"{}","cells_in_series":60,"temperature_C":40,"irradiance_W_m2":{},"date":"2026-05-04",)"
      R"("rated_power_W":300,"crew":"B","voltage_V":[{}],"current_A":[{}]}})"
      "\n",
      string.id, string.irradiance_W_m2, voltages, currents);
}

// `count` rows, eight per combiner; every ninth row is broken.
inline std::string ManyRows(int count) {
  std::string rows;
  for (int i = 0; i < count; ++i) {
    SyntheticString string{fmt::format("site/comb{}/str{}", i / 8, i)};
    string.isc_A = 9 + 0.01 * (i % 7);
    string.voc_V = 40 + 0.02 * (i % 5);
    std::string row = RowOf(string);
    if (i % 9 == 4) row.replace(row.find("[0,"), 3, "[x,");
    rows += row;
  }
  return rows;
}

// A fast task that returns the number of readings and the seed of a curve.
inline BatchTaskType CountTask() {
  BatchTaskType task;
  task.name = "count";
  task.columns = {{"readings", "", CellType::kWhole, "how many"},
                  {"own_seed", "", CellType::kText, "of the curve"}};
  task.run = [](const BatchCurve& curve, std::uint64_t seed, const Observer&) {
    return TaskResult{RowStatus::kFine,
                      "",
                      {static_cast<std::int64_t>(curve.curve->size()), std::to_string(seed)},
                      false};
  };
  return task;
}

inline Expected<BatchSummary> RunOn(const std::string& file, const BatchTaskType& task,
                                    const BatchOptions& options, const Observer& observer = {}) {
  BatchReadOptions reading;
  reading.shard = options.shard;
  auto source = OpenBatch({file}, reading);
  if (!source) return tl::unexpected(source.error());
  return RunBatch(source->get(), task, options, observer);
}

inline BatchOptions Into(const std::string& folder, int threads = 2) {
  BatchOptions options;
  options.folder = folder;
  options.threads = threads;
  return options;
}

// Contents of all result files in a folder.
inline std::string ResultsIn(const std::string& folder) {
  return FileText(folder + "/results.csv") + FileText(folder + "/results.jsonl") +
         FileText(folder + "/results.schema.json");
}

// Stops at a number of rows, in the stage "batch" (rows computed) or "results" (rows written).
inline Observer StopAfter(std::int64_t rows, const std::string& stage = "batch") {
  return [rows, stage](const Progress& progress) {
    const bool now = progress.stage == stage && progress.iteration >= rows;
    return now ? ObserverAction::kStop : ObserverAction::kContinue;
  };
}

}  // namespace lyrefit

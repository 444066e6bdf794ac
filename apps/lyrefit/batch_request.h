#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "flags.h"
#include "lyrefit/batch.h"
#include "plant/additions.h"
#include "plant/string_plan.h"

namespace lyrefit {

// Values of the flags of `lyrefit batch`.
struct BatchRequest {
  std::vector<std::string> inputs;
  std::string task = "fit";
  bool resume = false;
  BatchOptions options;
  PlantOptions comparisons;
  BatchReadOptions reading;
  ConditionOptions conditions;
  std::vector<std::string> reference_inputs;
  ReferenceOptions reference;
  std::string plan;                            // file, or "neighbours"; empty: no comparison
  std::shared_ptr<const PlantPlan> read_plan;  // of the file
  DeviceLayout layout;                         // by the sheet of the module
  bool override = false;
  FitOptions fit = BatchFitOptions();
  bool auto_model = false;
  std::string bounds = "physical";
  DiagnoseOptions diagnose;  // also for a field test
  TranslateOptions translate = BatchTranslateOptions();
  CellOptions cell;
  PixelOptions pixels;
  TrendOptions trend;
  bool operating = false;  // the inputs are operating points
  std::string coefficients_file;
  std::string html_file;
  std::string plant;  // name of the plant
  std::string module_file;
};

// The conditions that were given. They fill in what a file does not state, unless --override was.
inline ConditionOptions Filling(const BatchRequest& request) {
  ConditionOptions conditions = request.conditions;
  conditions.replaces = request.override;
  return conditions;
}

// A task for each curve, as data: its name for --task, its flags, and the function that creates it
// from them.
struct BatchTask {
  const char* name;
  void (*declare)(VerbLine* verb, BatchRequest* request);
  // The first given flag that belongs to this task only; empty: none was given.
  std::string (*given)(const VerbLine& verb);
  Expected<BatchTaskType> (*make)(const VerbLine& verb, const BatchRequest& request);
  const char* takes = "";  // name of another task, whose flags are accepted too
};

// All tasks; defined in batch_tasks.cc.
const std::vector<BatchTask>& BatchTasks();
std::string BatchTaskNames();  // "fit, diagnose"
// Declares the flags that several tasks share.
void AddSharedTaskFlags(VerbLine* verb, BatchRequest* request);

}  // namespace lyrefit

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "flags.h"
#include "lyrefit/batch.h"

namespace lyrefit {

// What was said to `lyrefit batch`.
struct BatchRequest {
  std::vector<std::string> inputs;
  std::string task = "fit";
  bool resume = false;
  BatchOptions options;
  BatchReadOptions reading;
  ConditionOptions conditions;
  std::vector<std::string> reference_inputs;
  ReferenceOptions reference;
  FitOptions fit = BatchFitOptions();
  bool auto_model = false;
  std::string bounds = "physical";
  DiagnoseOptions diagnose;  // of a field test too
  TranslateOptions translate = BatchTranslateOptions();
  std::string coefficients_file;
  std::string html_file;
  std::string plant;  // its name
  std::string module_file;
};

// What can be done with each curve, as data: its name for --task, the flags that only it has, and
// how it is made of them.
struct BatchTask {
  const char* name;
  void (*declare)(VerbLine* verb, BatchRequest* request);
  // The first flag on the line that is of this task and no other; empty: none was given.
  std::string (*given)(const VerbLine& verb);
  Expected<BatchTaskType> (*make)(const VerbLine& verb, const BatchRequest& request);
  const char* takes = "";  // another task, whose flags it understands too
};

// batch_tasks.cc: all there are.
const std::vector<BatchTask>& BatchTasks();
std::string BatchTaskNames();  // "fit, diagnose"
// Flags that mean the same for several of them.
void AddSharedTaskFlags(VerbLine* verb, BatchRequest* request);

}  // namespace lyrefit

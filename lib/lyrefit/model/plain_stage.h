// Experimental: may change in a minor version (data/stable).
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// A stage of an effect as a plain function of numbers, for laws known only at run time: a table, or
// code in another language. It is slower than the templates of effect.h. Units and requirements of
// stages are those of effect.h.

// Inputs of a stage: `count` readings, one number each per array.
struct StageInput {
  int count = 0;                            // of readings
  const double* x = nullptr;                // junction: its voltage, V; series: delivered current
  const double* photocurrent = nullptr;     // of the cell's own group, current scales
  const double* thermal_voltage = nullptr;  // k T / q, V
  const double* p = nullptr;                // the effect's parameters, the same for all readings
  int parameters = 0;                       // number of the effect's parameters
  double reach = 1;                         // largest |voltage| of all readings, V of a cell
  double cells = 1;                         // in series
};

// Results of a stage: arrays of `count` numbers to be filled. A derivative that is nullptr is not
// requested. Requested are all of them, `by_x` alone, or none.
struct StageOutput {
  double* value = nullptr;               // in the unit of the stage
  double* by_x = nullptr;                // the derivative by x
  double* by_photocurrent = nullptr;     // by the photocurrent
  double* by_thermal_voltage = nullptr;  // by the thermal voltage
  double* by_p = nullptr;                // by each parameter in turn, `count` numbers each
};

// A stage must be deterministic. It may be called from several threads at once, except in
// computations whose options set one thread. A NaN value ends the evaluation of the law.
using PlainStage = std::function<void(const StageInput& input, const StageOutput& output)>;

// A stage from values alone, differentiated by five-point differences. The steps are 1e-4 of a volt
// or a current scale, or of a parameter's value (at least of a thousandth of its range). The error
// is some 1e-12 of the value if the function is smooth over ten steps. Steps stay inside `ranges`,
// [low, high] of each parameter. `under_conditions`: the stage depends on photocurrent or thermal
// voltage. If false, the derivatives by them are 0 and not evaluated.
using PlainValue = std::function<void(const StageInput& input, double* value)>;
PlainStage WithDifferences(PlainValue stage, std::vector<std::pair<double, double>> ranges,
                           bool under_conditions);

}  // namespace lyrefit

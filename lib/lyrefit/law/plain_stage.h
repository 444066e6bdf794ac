#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// A stage of an effect as a plain function of numbers: for laws that are known only when the
// program runs, of a table or written in another language. Slower than the templates of effect.h,
// but the same in all else: what stands there of units and of what a stage has to be holds here.

// Where it is asked: `count` readings, a number of each in every array.
struct StageInput {
  int count = 0;                            // of readings
  const double* x = nullptr;                // junction: its voltage, V; series: delivered current
  const double* photocurrent = nullptr;     // of the cell, under the light of its own
  const double* thermal_voltage = nullptr;  // k T / q, V
  const double* p = nullptr;                // the effect's parameters, the same for all readings
  int parameters = 0;                       // how many p has
  double reach = 1;                         // largest |voltage| of all readings, V of a cell
  double cells = 1;                         // in series
};

// What a stage adds, and its derivatives: arrays of `count` numbers to be filled. The derivatives
// that are nullptr are not asked for; all of them are, or `by_x` alone, or none.
struct StageOutput {
  double* value = nullptr;               // in the unit of the stage
  double* by_x = nullptr;                // the derivative by x
  double* by_photocurrent = nullptr;     // by the photocurrent
  double* by_thermal_voltage = nullptr;  // by the thermal voltage
  double* by_p = nullptr;                // parameter after parameter, `count` numbers of each
};

// Must give the same for the same input. It may be called from several threads at once, but not by
// a computation whose options say one thread. NaN where the law has no value ends the evaluation.
using PlainStage = std::function<void(const StageInput& input, const StageOutput& output)>;

// A stage without derivatives: these are differences of five values at steps of 1e-4 (of a volt or
// a current scale; of the value or a thousandth of its range for a parameter), in error by some
// 1e-12 of the value where the function is smooth over ten such steps. At the end of a parameter's
// range, [low, high] for each, they lie inside of it. `under_sky`: whether the stage looks at
// photocurrent or thermal voltage; else it is not asked for derivatives by them, which are 0.
using PlainValue = std::function<void(const StageInput& input, double* value)>;
PlainStage WithDifferences(PlainValue stage, std::vector<std::pair<double, double>> ranges,
                           bool under_sky);

}  // namespace lyrefit

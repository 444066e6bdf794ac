#pragma once

#include <gtest/gtest.h>

#include <string>

#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/estimate/fit/simulate.h"

namespace lyrefit {

// A module of 60 cells with measurement noise, to which tests add effects.
inline SimulateOptions Module() {
  SimulateOptions options;
  options.parameters = {{"Iph", 8.2}, {"Is1", 2e-9}, {"n", 1.15}, {"Rs", 0.25}, {"Rsh", 300}};
  options.conditions.cells_in_series = 60;
  options.noise_A = 0.004;
  options.seed = 3;
  return options;
}

inline const Estimate& Find(const FitReport& report, const std::string& symbol) {
  for (const Estimate& e : report.estimates) {
    if (e.info.symbol == symbol) return e;
  }
  ADD_FAILURE() << "no parameter " << symbol;
  return report.estimates.front();
}

}  // namespace lyrefit

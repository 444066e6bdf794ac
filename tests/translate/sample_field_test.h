#pragma once

#include "lyrefit/translate/checklist.h"
#include "lyrefit/translate/field_test.h"

namespace lyrefit {

// Uncertainty budget of Pmax with three inputs, one of them negligible, propagated by the library.
inline UncertaintyBudget SampleBudget(int draws = 20000) {
  UncertainModel model;
  model.outputs = {{"max_power", "Pmax", "W"}};
  model.evaluate = [](const std::vector<double>& x) {
    return std::vector<double>{400 * x[0] / 800 * (1 - 0.004 * (x[1] - 45)) * x[2]};
  };
  const auto input = [](const char* name, const char* unit, double value, double u) {
    UncertainInput made;
    made.name = made.title = name;
    made.unit = unit;
    made.value = value;
    made.standard_uncertainty = u;
    made.source = std::string("certificate of the ") + name;
    return made;
  };
  UncertaintyOptions options;
  options.draws = draws;
  const UncertaintySources sources = {{input("light sensor", "W/m2", 800, 12),
                                       input("temperature sensor", "C", 45, 1),
                                       input("balance", "", 1, 1e-5)}};
  return *Propagate(model, sources, options);
}

inline FieldTest SampleFieldTest() {
  FieldTestOptions options;
  options.rated_W = 405;
  options.tolerance = {0, 5, false};
  options.power_coefficient_percent_K = -0.35;
  FieldMeasurement measurement;
  measurement.measured.max_power_voltage_V = 30;
  measurement.measured.max_power_current_A = 10;
  measurement.inputs.irradiance_W_m2 = 800;
  measurement.inputs.temperature_C = 45;
  measurement.inputs.voltage_gain = measurement.inputs.current_gain = 1;
  UncertaintyOptions uncertainty;
  uncertainty.light_source = LightSource::kCurve;
  uncertainty.draws = 2000;
  return *JudgeFieldTest(SampleBudget().outputs[0], measurement, options, uncertainty);
}

inline Checklist SampleChecklist() {
  IvCurve curve;
  curve.conditions.irradiance_W_m2 = 640;
  curve.temperature_known = false;
  for (int i = 0; i <= 40; ++i) {
    curve.voltage_V.push_back(i);
    curve.current_A.push_back(8 - 0.005 * i * i);
  }
  return CheckConditions(curve, {}, {});
}

}  // namespace lyrefit

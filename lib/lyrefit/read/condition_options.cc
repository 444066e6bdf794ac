#include "lyrefit/read/condition_options.h"

#include <fmt/format.h>

#include <cmath>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/technology.h"

namespace lyrefit {
namespace {

constexpr double kColdest_C = -100;
constexpr double kHottest_C = 150;

Expected<void> CheckConditions(const ConditionOptions& stated) {
  if (stated.cells && *stated.cells < 1) {
    return Fail(fmt::format("cells: expected at least 1 cell in series, found {}", *stated.cells));
  }
  if (stated.temperature_C && *stated.temperature_C > kHottest_C) {
    return Fail(
        fmt::format("temperature-C: {} looks like kelvin: expected degrees Celsius, {} to {}",
                    NumberText(*stated.temperature_C), kColdest_C, kHottest_C));
  }
  if (stated.temperature_C && !(*stated.temperature_C >= kColdest_C)) {
    return Fail(fmt::format("temperature-C: expected degrees Celsius, {} to {}, found {}",
                            kColdest_C, kHottest_C, NumberText(*stated.temperature_C)));
  }
  if (stated.irradiance_W_m2 &&
      !(std::isfinite(*stated.irradiance_W_m2) && *stated.irradiance_W_m2 >= 0)) {
    return Fail(fmt::format("irradiance-Wm2: expected at least 0 W/m2, found {}",
                            NumberText(*stated.irradiance_W_m2)));
  }
  if (!stated.technology.empty() && FindTechnology(stated.technology) == nullptr) {
    return Fail(fmt::format("technology: '{}' is not known: expected one of {}", stated.technology,
                            TechnologyNames()));
  }
  return {};
}

}  // namespace

Expected<void> ApplyConditions(const ConditionOptions& stated, IvCurve* curve) {
  TRY(CheckConditions(stated));
  curve->as_is = stated.as_is;
  if (!stated.technology.empty()) curve->notes.technology = stated.technology;
  if (stated.cells) {
    curve->conditions.cells_in_series = *stated.cells;
    curve->cells_known = true;
    Forget(About::kCells, &curve->assumptions);
  }
  if (stated.temperature_C) {
    curve->conditions.cell_temperature_K = *stated.temperature_C + kZeroCelsius_K;
    curve->temperature_known = true;
    Forget(About::kTemperature, &curve->assumptions);
  }
  if (stated.irradiance_W_m2) {
    curve->conditions.irradiance_W_m2 = *stated.irradiance_W_m2;
    curve->irradiance_known = true;
    Forget(About::kIrradiance, &curve->assumptions);
  }
  return {};
}

Expected<void> ApplyConditions(const ConditionOptions& stated, CurveSet* set) {
  for (IvCurve& curve : set->curves) {
    TRY(ApplyConditions(stated, &curve));
  }
  IvCurve common;  // carries the assumptions shared by the set
  common.assumptions = set->assumptions;
  TRY(ApplyConditions(stated, &common));
  set->assumptions = common.assumptions;
  return {};
}

}  // namespace lyrefit

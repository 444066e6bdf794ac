#include "lyrefit/read/condition_options.h"

#include <fmt/format.h>

#include <cmath>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/technology.h"

namespace lyrefit {
namespace {

constexpr double kColdest_C = -100;
constexpr double kHottest_C = 150;
constexpr double kMostLight_W_m2 = 1e7;  // of concentrators: ten times what they have

Expected<void> CheckConditions(const ConditionOptions& stated) {
  if (stated.cells && *stated.cells < 1) {
    return Fail(fmt::format("cells: expected at least 1 cell in series, found {}", *stated.cells));
  }
  if (stated.bypass_diodes && *stated.bypass_diodes < 0) {
    return Fail(fmt::format("bypass-diodes: expected at least 0 bypass diodes, found {}",
                            *stated.bypass_diodes));
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
      !(*stated.irradiance_W_m2 >= 0 && *stated.irradiance_W_m2 <= kMostLight_W_m2)) {
    return Fail(fmt::format("irradiance-Wm2: expected 0 to {:g} W/m2, found {}", kMostLight_W_m2,
                            NumberText(*stated.irradiance_W_m2)));
  }
  if (!stated.technology.empty() && FindTechnology(stated.technology) == nullptr) {
    return Fail(fmt::format("technology: '{}' is not known: expected one of {}", stated.technology,
                            TechnologyNames()));
  }
  return {};
}

// A condition that the user gives, and the one that the file states.
struct GivenCondition {
  About about;
  std::string given;
  std::string stated;
  std::string* stated_in;  // empty: by nobody
};

// Whether the given value counts. Says so where the file states another one.
bool Counts(const GivenCondition& one, bool replaces, const std::string& name, IvCurve* curve) {
  const bool differs = !one.stated_in->empty() && one.given != one.stated;
  if (differs && !replaces) {
    curve->assumptions.emplace_back(fmt::format("{}{} in {} counts, not the {} given (--override)",
                                                name, one.stated, *one.stated_in, one.given),
                                    one.about);
    return false;
  }
  Forget(one.about, &curve->assumptions);
  if (differs) {
    curve->assumptions.emplace_back(
        fmt::format("{}{} given, instead of {} in {}", name, one.given, one.stated, *one.stated_in),
        one.about);
  }
  one.stated_in->clear();
  return true;
}

std::string CelsiusText(double celsius) { return fmt::format("{:.6g} C", celsius); }
std::string LightText(double irradiance_W_m2) {
  return fmt::format("{:.6g} W/m2", irradiance_W_m2);
}

// `name`: what begins the sentences about the curve.
Expected<void> ApplyNamed(const ConditionOptions& stated, const std::string& name, IvCurve* curve) {
  TRY(CheckConditions(stated));
  const auto counts = [&](const GivenCondition& one) {
    return Counts(one, stated.replaces, name, curve);
  };
  Conditions& at = curve->conditions;
  DeviceNotes& notes = curve->notes;
  ConditionSources& in = curve->stated_in;
  curve->as_is = stated.as_is;
  if (!stated.technology.empty() &&
      counts({About::kTechnology, stated.technology, notes.technology, &in.technology})) {
    notes.technology = stated.technology;
  }
  if (stated.cells && counts({About::kCells, Plural(*stated.cells, "cell"),
                              Plural(at.cells_in_series, "cell"), &in.cells})) {
    at.cells_in_series = *stated.cells;
    curve->cells_known = true;
  }
  if (stated.bypass_diodes &&
      counts({About::kBypassDiodes, Plural(*stated.bypass_diodes, "bypass diode"),
              Plural(notes.bypass_diodes.value_or(0), "bypass diode"), &in.bypass_diodes})) {
    notes.bypass_diodes = stated.bypass_diodes;
  }
  if (stated.temperature_C &&
      counts({About::kTemperature, CelsiusText(*stated.temperature_C),
              CelsiusText(at.cell_temperature_K - kZeroCelsius_K), &in.temperature})) {
    at.cell_temperature_K = *stated.temperature_C + kZeroCelsius_K;
    curve->temperature_known = true;
  }
  if (stated.irradiance_W_m2 && counts({About::kIrradiance, LightText(*stated.irradiance_W_m2),
                                        LightText(at.irradiance_W_m2), &in.irradiance})) {
    at.irradiance_W_m2 = *stated.irradiance_W_m2;
    curve->irradiance_known = true;
  }
  return {};
}

}  // namespace

Expected<void> ApplyConditions(const ConditionOptions& stated, IvCurve* curve) {
  return ApplyNamed(stated, "", curve);
}

Expected<void> ApplyConditions(const ConditionOptions& stated, CurveSet* set) {
  const bool several = set->curves.size() > 1;
  for (IvCurve& curve : set->curves) {
    TRY(ApplyNamed(stated, several ? curve.name + ": " : "", &curve));
  }
  IvCurve common;  // carries the assumptions shared by the set
  common.assumptions = set->assumptions;
  TRY(ApplyConditions(stated, &common));
  set->assumptions = common.assumptions;
  return {};
}

}  // namespace lyrefit

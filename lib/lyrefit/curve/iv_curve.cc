#include "lyrefit/curve/iv_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/plausibility.h"

namespace lyrefit {
namespace {

Expected<void> CheckColumn(const char* name, const std::vector<double>& values, std::size_t points,
                           bool optional) {
  if (optional && values.empty()) return {};
  if (values.size() != points) {
    return Fail(fmt::format("expected {} values of {}, found {}", points, name, values.size()));
  }
  for (std::size_t i = 0; i < points; ++i) {
    if (std::isfinite(values[i])) continue;
    return Fail(fmt::format("expected a finite {} at point {}, found {}", name, i + 1, values[i]));
  }
  return {};
}

Expected<void> CheckConditions(const Conditions& conditions) {
  const double temperature_C = conditions.cell_temperature_K - kZeroCelsius_K;
  if (!(temperature_C >= -100 && temperature_C <= 200)) {
    return Fail(fmt::format("expected a cell temperature from -100 to 200 C, found {:.6g} C",
                            temperature_C));
  }
  if (!(conditions.irradiance_W_m2 >= 0 && std::isfinite(conditions.irradiance_W_m2))) {
    return Fail(
        fmt::format("expected an irradiance from 0 W/m2 up, found {}", conditions.irradiance_W_m2));
  }
  if (conditions.cells_in_series < 1) {
    return Fail(
        fmt::format("expected at least 1 cell in series, found {}", conditions.cells_in_series));
  }
  if (conditions.strings_in_parallel < 1) {
    return Fail(fmt::format("expected at least 1 string in parallel, found {}",
                            conditions.strings_in_parallel));
  }
  return {};
}

// Words for setups; the first row counts of which one stands in the text as a word of its own. A lamp of
// a class is that of a simulator, and simulators of modules flash.
struct SetupWords {
  Setup setup;
  std::vector<std::string> words;
};

const std::vector<SetupWords>& AllSetupWords() {
  static const std::vector<SetupWords> all = {
      {Setup::kInverter, {"inverter scan", "inverter iv scan", "inverter i-v scan", "smart i-v"}},
      {Setup::kLaboratory, {"laboratory", "liv", "glovebox", "steady-state simulator"}},
      {Setup::kFlash,
       {"flash", "flasher", "flash test", "flashtest", "flash tester", "flash lamp", "pulsed light",
        "sun simulator", "sunsimulator", "solar simulator", "class aaa", "aaa", "a+a+a+"}},
      {Setup::kOutdoor,
       {"outdoor", "outdoors", "iv tracer", "i-v tracer", "pvpm", "solmetric", "iv swinger"}}};
  return all;
}

bool IsLetterOrDigit(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

bool HasWord(const std::string& text, const std::string& word) {
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !IsLetterOrDigit(text[at - 1])) &&
        (end == text.size() || !IsLetterOrDigit(text[end]))) {
      return true;
    }
  }
  return false;
}

}  // namespace

Setup FindSetup(const std::string& text) {
  const std::string lower = LowerCase(text);
  for (const SetupWords& row : AllSetupWords()) {
    for (const std::string& word : row.words) {
      if (HasWord(lower, word)) return row.setup;
    }
  }
  return Setup::kUnknown;
}

void TakeKeyPoints(const KeyPoints& points, IvCurve* curve) {
  const auto add = [curve](double voltage_V, double current_A) {
    if (std::isnan(voltage_V) || std::isnan(current_A)) return;
    curve->voltage_V.push_back(voltage_V);
    curve->current_A.push_back(current_A);
  };
  add(0, points.short_circuit_current_A);
  add(points.max_power_voltage_V, points.max_power_current_A);
  add(points.open_circuit_voltage_V, 0);
  curve->key_points = points;
}

Expected<void> Validate(const IvCurve& curve) {
  const std::size_t points = curve.size();
  const struct {
    const char* name;
    const std::vector<double>& values;
    bool optional;
  } columns[] = {{"current", curve.current_A, false},
                 {"voltage", curve.voltage_V, false},
                 {"sigma", curve.sigma_A, true},
                 {"time", curve.time_s, true},
                 {"irradiance", curve.irradiance_W_m2, true},
                 {"temperature", curve.temperature_C, true}};
  for (const auto& column : columns) {
    TRY(CheckColumn(column.name, column.values, points, column.optional));
  }
  if (!curve.sweep.empty() && curve.sweep.size() != points) {
    return Fail(fmt::format("expected {} values of sweep, found {}", points, curve.sweep.size()));
  }
  if (points < 2) return Fail(fmt::format("expected at least two points, found {}", points));
  const auto [low, high] = std::minmax_element(curve.voltage_V.begin(), curve.voltage_V.end());
  if (*low == *high) {
    return Fail(fmt::format("expected at least two different voltages, found {} V at all {} points",
                            *low, points));
  }
  const auto sigma = std::find_if_not(curve.sigma_A.begin(), curve.sigma_A.end(),
                                      [](double value) { return value > 0; });
  if (sigma != curve.sigma_A.end()) {
    return Fail(fmt::format("expected a positive sigma at point {}, found {}",
                            sigma - curve.sigma_A.begin() + 1, *sigma));
  }
  return CheckConditions(curve.conditions);
}

CurveSet SetOfOne(IvCurve curve) {
  CurveSet set;
  set.name = curve.name;
  set.source = curve.source;
  set.curves.push_back(std::move(curve));
  return set;
}

void Forget(About about, std::vector<Assumption>* assumptions) {
  const auto concerned = [about](const Assumption& one) { return one.about == about; };
  assumptions->erase(std::remove_if(assumptions->begin(), assumptions->end(), concerned),
                     assumptions->end());
}

std::vector<std::string> SentencesOf(const std::vector<Assumption>& assumptions) {
  std::vector<std::string> sentences;
  sentences.reserve(assumptions.size());
  for (const Assumption& one : assumptions) sentences.push_back(one.sentence);
  return sentences;
}

namespace {

constexpr char kLeftEnd[] = " speaks of a temperature, not clearly of the cells: not used";

}  // namespace

Assumption LeftTemperature(const std::string& line) {
  return {line + kLeftEnd, About::kTemperature};
}

bool IsLeftTemperature(const Assumption& assumption) {
  const std::string& sentence = assumption.sentence;
  const std::string end = kLeftEnd;
  return assumption.about == About::kTemperature && sentence.size() >= end.size() &&
         sentence.compare(sentence.size() - end.size(), end.size(), end) == 0;
}

}  // namespace lyrefit

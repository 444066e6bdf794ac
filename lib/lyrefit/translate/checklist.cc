#include "lyrefit/translate/checklist.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/curve/key_points.h"
#include "lyrefit/translate/field_inputs.h"

namespace lyrefit {
namespace {

constexpr char kArrays[] = "IEC 61829:2015";
constexpr int kFewestPoints = 30;
constexpr int kFewestAtTop = 5;  // within a tenth of the largest power

CheckedCondition Item(const char* id, std::string title, const char* clause) {
  CheckedCondition item;
  item.id = id;
  item.title = std::move(title);
  item.clause = clause;
  return item;
}

// Sets a value and the state that follows from it.
void Settle(bool met, double value, double limit, const char* unit, std::string found,
            std::string source, std::string cure, CheckedCondition* item) {
  item->state = met ? Condition::kMet : Condition::kNotMet;
  item->value = value;
  item->limit = limit;
  item->unit = unit;
  item->found = std::move(found);
  item->source = std::move(source);
  if (!met) item->cure = std::move(cure);
}

CheckedCondition CheckLight(const IvCurve& curve, const ConditionFacts& facts,
                            const ChecklistOptions& options) {
  CheckedCondition item = Item(
      "irradiance", fmt::format("light above {:g} W/m2", options.least_irradiance_W_m2), kArrays);
  if (!curve.irradiance_known) {
    item.cure = "read the irradiance in the plane of the modules with each sweep";
    return item;
  }
  const double light = curve.conditions.irradiance_W_m2;
  Settle(light >= options.least_irradiance_W_m2, light, options.least_irradiance_W_m2, "W/m2",
         fmt::format("{:.0f} W/m2", light), LightClassOf(facts.uncertainty.light_source).sensor,
         "measure again in brighter light", &item);
  return item;
}

bool IsOfLight(const std::string& effect) {
  return effect == "irr_step" || effect == "drift" || effect == "transient";
}

// Sets the steadiness of the light during the sweep by a diagnosis.
void SteadyByDiagnosis(const Diagnosis& diagnosis, CheckedCondition* item) {
  for (const Cause& cause : diagnosis.verdict.causes) {
    if (!IsOfLight(cause.id)) continue;
    item->state = Condition::kNotMet;
    item->found = cause.sentence;
    item->source = "diagnosis of the curve";
    item->cure = "sweep again in steady light; the light that was lost is in this curve";
    return;
  }
  const bool tried =
      std::any_of(diagnosis.trials.begin(), diagnosis.trials.end(),
                  [](const Trial& trial) { return trial.tried && IsOfLight(trial.effect); });
  if (!tried) return;
  item->state = Condition::kMet;
  item->found = fmt::format("no step or drift of more than {:g} % of Isc in the curve",
                            100 * diagnosis.floor_current);
  item->source = "diagnosis of the curve: only what bends it can be seen";
}

CheckedCondition CheckSteady(const IvCurve& curve, const ConditionFacts& facts,
                             const ChecklistOptions& options) {
  CheckedCondition item = Item(
      "steadiness",
      fmt::format("light steady within {:g} % during the sweep", options.most_unsteady_percent),
      "IEC 60904-1");
  const std::vector<double>& light = curve.irradiance_W_m2;
  if (!light.empty()) {
    const auto [least, most] = std::minmax_element(light.begin(), light.end());
    double mean = 0;
    for (const double each : light) mean += each / static_cast<double>(light.size());
    const double percent = 100 * std::max(*most - mean, mean - *least) / mean;
    Settle(percent <= options.most_unsteady_percent, percent, options.most_unsteady_percent, "%",
           fmt::format("{:.2g} % from its mean, {:.0f} .. {:.0f} W/m2", percent, *least, *most),
           "irradiance recorded with the readings", "sweep again in steady light", &item);
    return item;
  }
  if (facts.diagnosis != nullptr) SteadyByDiagnosis(*facts.diagnosis, &item);
  if (item.state == Condition::kNotKnown) {
    item.cure = "record the irradiance with every reading, or before and after the sweep";
  }
  return item;
}

CheckedCondition CheckSweepTime(const IvCurve& curve, const ChecklistOptions& options) {
  CheckedCondition item =
      Item("sweep_time", fmt::format("sweep within {:g} s", options.most_sweep_s), kArrays);
  if (curve.time_s.empty()) {
    item.cure = "record the time of the readings";
    return item;
  }
  const auto [first, last] = std::minmax_element(curve.time_s.begin(), curve.time_s.end());
  const double seconds = *last - *first;
  Settle(seconds <= options.most_sweep_s, seconds, options.most_sweep_s, "s",
         fmt::format("{:.3g} s", seconds), "times recorded with the readings",
         "set the tracer to a faster sweep", &item);
  return item;
}

CheckedCondition CheckLightSensor(const ConditionFacts& facts) {
  const UncertaintyOptions& by = facts.uncertainty;
  const bool pyranometer = by.light_source == LightSource::kPyranometer;
  const double limit = pyranometer ? 5 : 3;
  CheckedCondition item = Item("light_sensor",
                               fmt::format("irradiance by a {} within {:g} %",
                                           pyranometer ? "pyranometer" : "reference cell", limit),
                               kArrays);
  if (by.light_source == LightSource::kNotStated && !by.irradiance_percent) {
    item.cure =
        "say what the irradiance was read from and how sure it is (--irradiance-from, "
        "--irradiance-u)";
    return item;
  }
  const double percent = IrradianceSize_percent(by);
  if (by.light_source == LightSource::kCurve) {
    Settle(false, percent, limit, "%", "the light was taken from the curve itself",
           "--irradiance-from",
           "read a clean sensor in the plane of the modules: without it uniform soiling, and "
           "whatever else dims all cells alike, cannot be seen",
           &item);
    return item;
  }
  Settle(percent <= limit, percent, limit, "%",
         fmt::format("{}, {:g} %", LightClassOf(by.light_source).sensor, percent),
         by.irradiance_percent ? "--irradiance-u" : "usual of its class, not of this sensor",
         "use a sensor with a better calibration", &item);
  return item;
}

CheckedCondition CheckTemperature(const IvCurve& curve, const ConditionFacts& facts) {
  const UncertaintyOptions& by = facts.uncertainty;
  CheckedCondition item = Item("temperature", "cell temperature known within 1 K", kArrays);
  if (!curve.temperature_known) {
    item.cure =
        "read a sensor on the back of a module, or take the temperature from Voc "
        "(IEC 60904-5)";
    return item;
  }
  const std::string read = fmt::format("{:.1f} C", curve.conditions.cell_temperature_K - 273.15);
  if (by.temperature_source == TemperatureSource::kNotStated && !by.temperature_K) {
    item.found = read;
    item.source = "stated with the curve, sensor not named";
    item.cure = "say what it was read from (--temperature-from, --temperature-u)";
    return item;
  }
  const double size = TemperatureSize_K(by);
  const double light_W_m2 = curve.conditions.irradiance_W_m2;
  const double offset = CellOffsetSize_K(by, light_W_m2);
  const double warmer = CellCorrection_K(by, light_W_m2);
  Settle(size <= 1, size, 1, "K",
         fmt::format("{} within {:g} K{}", read, size,
                     warmer != 0  ? fmt::format("; cells {:+.1f} K", warmer)
                     : offset > 0 ? fmt::format("; cells up to {:.1f} K warmer", offset)
                                  : ""),
         by.temperature_K ? "--temperature-u" : "usual of its class, not of this sensor",
         "use a better sensor", &item);
  return item;
}

CheckedCondition CheckInstrument(const ConditionFacts& facts) {
  const UncertaintyOptions& by = facts.uncertainty;
  CheckedCondition item = Item("instrument", "voltage and current within 1 %", kArrays);
  if (!by.voltage_percent || !by.current_percent) {
    item.cure = "state the calibration of the tracer (--voltage-u, --current-u)";
    return item;
  }
  const double larger = std::max(*by.voltage_percent, *by.current_percent);
  Settle(larger <= 1, larger, 1, "%",
         fmt::format("voltage {:g} %, current {:g} %", *by.voltage_percent, *by.current_percent),
         "--voltage-u, --current-u", "have the tracer calibrated", &item);
  return item;
}

CheckedCondition CheckWind(const ChecklistOptions& options) {
  CheckedCondition item =
      Item("wind", fmt::format("wind below {:g} m/s", options.most_wind_m_s), kArrays);
  if (!options.wind_m_s) {
    item.cure = "note the wind (--wind)";
    return item;
  }
  Settle(*options.wind_m_s < options.most_wind_m_s, *options.wind_m_s, options.most_wind_m_s, "m/s",
         fmt::format("{:g} m/s", *options.wind_m_s), "--wind",
         "measure again when it is calm: the temperature moves", &item);
  return item;
}

CheckedCondition CheckShortCircuit(const IvCurve& curve, const KeyPoints& key) {
  CheckedCondition item = Item("short_circuit", "readings reach short circuit", "IEC 60891:2021");
  const double least = *std::min_element(curve.voltage_V.begin(), curve.voltage_V.end());
  const double part = 100 * least / key.open_circuit_voltage_V;
  Settle(least <= 0 || part <= 2, least, 0, "V",
         fmt::format("first at {:.3g} V{}", least,
                     least > 0 ? fmt::format(", {:.1f} % of Voc", part) : ""),
         "the readings", "begin the sweep at or below 0 V: Isc is extrapolated", &item);
  return item;
}

CheckedCondition CheckOpenCircuit(const IvCurve& curve, const KeyPoints& key) {
  CheckedCondition item = Item("open_circuit", "readings reach open circuit", "IEC 60891:2021");
  const double least = *std::min_element(curve.current_A.begin(), curve.current_A.end());
  const double part = 100 * least / key.short_circuit_current_A;
  Settle(least <= 0, least, 0, "A",
         fmt::format("least current {:.3g} A{}", least,
                     least > 0 ? fmt::format(", {:.1f} % of Isc", part) : ""),
         "the readings",
         std::isfinite(key.open_circuit_voltage_V)
             ? "sweep beyond Voc: it is extrapolated"
             : "sweep beyond Voc: there is none in these readings",
         &item);
  return item;
}

CheckedCondition CheckPoints(const IvCurve& curve, const KeyPoints& key) {
  CheckedCondition item =
      Item("points",
           fmt::format("{} readings, {} within 10 % of Pmax", kFewestPoints, kFewestAtTop), "");
  const int all = static_cast<int>(curve.size());
  int top = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (curve.voltage_V[i] * curve.current_A[i] >= 0.9 * key.max_power_W) ++top;
  }
  Settle(all >= kFewestPoints && top >= kFewestAtTop, all, kFewestPoints, "",
         fmt::format("{} readings, {} within 10 % of Pmax", all, top), "the readings",
         "set the tracer to more readings", &item);
  return item;
}

CheckedCondition CheckCells(const IvCurve& curve) {
  CheckedCondition item = Item("cells", "cells in series known", "");
  if (!curve.cells_known) {
    item.cure = "state the cells in series (--cells)";
    return item;
  }
  item.state = Condition::kMet;
  item.value = curve.conditions.cells_in_series;
  item.found = fmt::format("{} in series", curve.conditions.cells_in_series);
  item.source = "stated with the curve";
  return item;
}

// Procedure 1 moves points along straight lines, which suits small steps of irradiance only.
CheckedCondition CheckStep(const IvCurve& curve, const ConditionFacts& facts) {
  const bool small = facts.procedure == Procedure::kIec1;
  const double limit = small ? 20 : 30;
  CheckedCondition item = Item(
      "light_step", fmt::format("light within {:g} % of the target's", limit), "IEC 60891:2021");
  if (!curve.irradiance_known) {
    item.cure = "read the irradiance in the plane of the modules with each sweep";
    return item;
  }
  const double percent =
      100 * std::fabs(curve.conditions.irradiance_W_m2 / facts.target.irradiance_W_m2 - 1);
  Settle(percent <= limit, percent, limit, "%",
         fmt::format("{:.0f} W/m2, {:.0f} % from {:g} W/m2", curve.conditions.irradiance_W_m2,
                     percent, facts.target.irradiance_W_m2),
         "stated with the curve",
         small ? "use procedure 2 or a model, or measure nearer to the target"
               : "measure nearer to the target",
         &item);
  return item;
}

std::string Summary(const Checklist& list) {
  std::string text = fmt::format("{} of {} conditions met", list.met, list.conditions.size());
  const auto add = [&](Condition state, int count, const char* words) {
    if (count == 0) return;
    text += fmt::format("; {}: ", words);
    bool first = true;
    for (const CheckedCondition& each : list.conditions) {
      if (each.state != state) continue;
      text += (first ? "" : ", ") + each.title;
      first = false;
    }
  };
  add(Condition::kNotMet, list.not_met, "not met");
  add(Condition::kNotKnown, list.not_known, "not known");
  return text;
}

}  // namespace

Checklist CheckConditions(const IvCurve& curve, const ConditionFacts& facts,
                          const ChecklistOptions& options) {
  const KeyPoints key = FindKeyPoints(curve.voltage_V, curve.current_A);
  Checklist list;
  list.conditions = {CheckLight(curve, facts, options),
                     CheckSteady(curve, facts, options),
                     CheckSweepTime(curve, options),
                     CheckLightSensor(facts),
                     CheckTemperature(curve, facts),
                     CheckInstrument(facts),
                     CheckWind(options),
                     CheckShortCircuit(curve, key),
                     CheckOpenCircuit(curve, key),
                     CheckPoints(curve, key),
                     CheckCells(curve)};
  if (facts.procedure) list.conditions.push_back(CheckStep(curve, facts));
  for (const CheckedCondition& each : list.conditions) {
    ++(each.state == Condition::kMet      ? list.met
       : each.state == Condition::kNotMet ? list.not_met
                                          : list.not_known);
  }
  list.sentence = Summary(list);
  return list;
}

}  // namespace lyrefit

#include "lyrefit/read/settle_conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lyrefit/base/append.h"
#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

// One condition: the sidecar's value and the table's column.
struct Source {
  About about;
  const char* unit;
  std::optional<double> sidecar;
  const std::vector<double>& column;
  double tolerance;
};

double Mean(const std::vector<double>& values) {
  // Keeps the mean of a constant column exact for any length.
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (*low == *high) return *low;
  double mean = 0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  return mean;
}

std::optional<double> Settle(const Source& source, std::vector<Assumption>* assumptions) {
  if (source.column.empty()) return source.sidecar;
  const double mean = Mean(source.column);
  const auto [low, high] = std::minmax_element(source.column.begin(), source.column.end());
  const bool varies = *high - *low > 2 * source.tolerance;
  if (varies) {
    assumptions->emplace_back(
        fmt::format("the column of the {} varies from {:.6g} to {:.6g} {}: its mean {:.6g} {} "
                    "counts for the whole curve",
                    ToText(source.about), *low, *high, source.unit, mean, source.unit),
        source.about);
  }
  if (!source.sidecar) return mean;
  if (std::abs(mean - *source.sidecar) <= source.tolerance) return source.sidecar;
  assumptions->emplace_back(
      fmt::format("the {} in the table ({:.6g} {}) differs from the one in the file beside it "
                  "({:.6g} {}): the table counts",
                  ToText(source.about), mean, source.unit, *source.sidecar, source.unit),
      source.about);
  return mean;
}

}  // namespace

const char* const kCellsAssumed =
    "number of cells in series not given: assumed 1; n is then the ideality of the whole module";
const char* const kTemperatureAssumed = "cell temperature not given: assumed 25 C";
const char* const kIrradianceAssumed = "irradiance not given: assumed 1000 W/m2";

void TakeNightAsDark(std::vector<double>* irradiance_W_m2, std::vector<Assumption>* assumptions) {
  std::size_t below = 0;
  double least = 0;
  for (double& value : *irradiance_W_m2) {
    if (!(value < 0)) continue;
    ++below;
    least = std::min(least, value);
    value = 0;
  }
  if (below == 0) return;
  const std::string count =
      irradiance_W_m2->size() == 1
          ? ""
          : fmt::format(" in {} of {} readings", below, irradiance_W_m2->size());
  assumptions->emplace_back(
      fmt::format("irradiance below zero{} (down to {:.6g} W/m2), as a sensor "
                  "shows it at night: taken as 0",
                  count, least),
      About::kIrradiance);
}

// Where a condition stands that no line and no key gave.
void SaySources(IvCurve* curve) {
  const auto say = [](bool known, const std::vector<double>& column, About about,
                      std::string* source) {
    if (!known) return source->clear();
    if (!column.empty()) *source = fmt::format("the column of the {}", ToText(about));
    if (source->empty()) *source = "the file";
  };
  ConditionSources& in = curve->stated_in;
  say(curve->cells_known, {}, About::kCells, &in.cells);
  say(curve->temperature_known, curve->temperature_C, About::kTemperature, &in.temperature);
  say(curve->irradiance_known, curve->irradiance_W_m2, About::kIrradiance, &in.irradiance);
}

void SettleConditions(const Sidecar& sidecar, IvCurve* curve) {
  if (!sidecar.name.empty()) curve->name = sidecar.name;
  curve->notes = sidecar.notes;
  curve->stated_in = sidecar.stated_in;
  Append(sidecar.assumptions, &curve->assumptions);
  Conditions& conditions = curve->conditions;
  conditions.strings_in_parallel = sidecar.strings_in_parallel.value_or(1);
  curve->strings_known = sidecar.strings_in_parallel.has_value();
  conditions.cells_in_series = sidecar.cells_in_series.value_or(1);
  curve->cells_known = sidecar.cells_in_series.has_value();
  if (!curve->cells_known) curve->assumptions.emplace_back(kCellsAssumed, About::kCells);

  const auto temperature_C =
      Settle({About::kTemperature, "C", sidecar.temperature_C, curve->temperature_C, 1},
             &curve->assumptions);
  if (!temperature_C) curve->assumptions.emplace_back(kTemperatureAssumed, About::kTemperature);
  curve->temperature_known = temperature_C.has_value();
  conditions.cell_temperature_K = temperature_C.value_or(25) + kZeroCelsius_K;

  TakeNightAsDark(&curve->irradiance_W_m2, &curve->assumptions);
  double brightest = sidecar.irradiance_W_m2.value_or(0);
  for (const double irradiance : curve->irradiance_W_m2)
    brightest = std::max(brightest, irradiance);
  const auto irradiance = Settle({About::kIrradiance, "W/m2", sidecar.irradiance_W_m2,
                                  curve->irradiance_W_m2, 0.02 * brightest},
                                 &curve->assumptions);
  if (!irradiance && curve->notes.illuminance_lux) {
    curve->assumptions.emplace_back(
        fmt::format("irradiance not given: no W/m2 follow from {:.6g} lux without the spectrum of "
                    "the light, state them with --irradiance-Wm2",
                    *curve->notes.illuminance_lux),
        About::kIrradiance);
  } else if (!irradiance && !sidecar.light.empty()) {
    curve->assumptions.emplace_back(
        fmt::format("irradiance not given: {} states a light whose W/m2 are not known; 1000 W/m2 "
                    "assumed, state the true value with --irradiance-Wm2",
                    sidecar.light),
        About::kIrradiance);
  } else if (!irradiance) {
    curve->assumptions.emplace_back(kIrradianceAssumed, About::kIrradiance);
  }
  curve->irradiance_known = irradiance.has_value();
  SaySources(curve);
  std::vector<double> settled = {irradiance.value_or(1000)};
  TakeNightAsDark(&settled, &curve->assumptions);
  conditions.irradiance_W_m2 = settled.front();
}

namespace {

// Asks for the unit of current densities without one. They are taken in mA/cm2, but at the lit cell's
// short circuit they have the size of A/cm2 under the sun, which mA/cm2 have under the light of a room.
Expected<void> AskForUnitOfDensity(const Sidecar& sidecar, const IvCurve& curve) {
  constexpr double kLeast = 1e-6, kMost = 70e-6;  // a thousandth of 1 to 70 mA/cm2
  constexpr double kDim_W_m2 = 100;
  const bool dim = sidecar.irradiance_W_m2.value_or(1000) < kDim_W_m2 || !sidecar.light.empty() ||
                   sidecar.notes.illuminance_lux;
  if (curve.current_unit_known || dim || curve.size() == 0) return {};
  const auto nearest =
      std::min_element(curve.voltage_V.begin(), curve.voltage_V.end(),
                       [](double a, double b) { return std::abs(a) < std::abs(b); });
  const double shown = std::abs(curve.current_A[nearest - curve.voltage_V.begin()]);
  if (!(shown >= kLeast && shown <= kMost)) return {};
  return Fail(fmt::format(
      "the current density names no unit, and the reading next to 0 V is {:.3g}: a cell under the "
      "sun in A/cm2, or one under the light of a room in mA/cm2? say which with --current-unit "
      "A/cm2 or --current-unit mA/cm2",
      1e3 * shown));
}

}  // namespace

Expected<void> SettleArea(const ReadOptions& options, const Sidecar& sidecar, IvCurve* curve) {
  const std::optional<double> area_cm2 =
      options.area_cm2 ? options.area_cm2 : sidecar.notes.area_cm2;
  if (!area_cm2 && options.per_area) {
    TRY(AskForUnitOfDensity(sidecar, *curve));
    curve->per_area = true;
    curve->assumptions.emplace_back(
        "no area is stated: the current densities are taken as the currents of 1 cm2");
    return {};
  }
  if (!area_cm2) {
    return Fail(
        "the table holds current densities: give the area of the cell with --area-cm2, or as "
        "area_cm2 in the JSON file beside the table");
  }
  if (!(*area_cm2 > 0 && std::isfinite(*area_cm2))) {
    return Fail(fmt::format("expected a positive area in cm2, found {}", *area_cm2));
  }
  TRY(AskForUnitOfDensity(sidecar, *curve));
  for (double& current : curve->current_A) current *= *area_cm2;
  for (double& sigma : curve->sigma_A) sigma *= *area_cm2;
  curve->assumptions.push_back(
      fmt::format("the current densities were multiplied by the area of {:.6g} cm2", *area_cm2));
  return {};
}

Sidecar MergeHead(Sidecar beside, const Sidecar& head) {
  const auto compare = [&](const Assumption& what, const char* unit, double tolerance,
                           const std::optional<double>& own, const std::optional<double>& other) {
    if (!own || !other || std::abs(*own - *other) <= tolerance) return;
    beside.assumptions.emplace_back(
        fmt::format("the {} in the head of the table ({:.6g}{}) differs from the one in the file "
                    "beside it ({:.6g}{}): the latter counts",
                    what.sentence, *other, unit, *own, unit),
        what.about);
  };
  const auto condition = [](About about) { return Assumption(ToText(about), about); };
  const auto as_number = [](const std::optional<int>& count) {
    return count ? std::optional<double>(*count) : std::nullopt;
  };
  compare(condition(About::kIrradiance), " W/m2", 0.02 * beside.irradiance_W_m2.value_or(0),
          beside.irradiance_W_m2, head.irradiance_W_m2);
  compare(condition(About::kTemperature), " C", 1, beside.temperature_C, head.temperature_C);
  compare(condition(About::kCells), "", 0, as_number(beside.cells_in_series),
          as_number(head.cells_in_series));
  compare("area", " cm2", 1e-9, beside.notes.area_cm2, head.notes.area_cm2);
  return Merge(std::move(beside), head);
}

}  // namespace lyrefit

#include "lyrefit/trend/trend_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/curve/date_time.h"

namespace lyrefit {
namespace {

bool Decided(const Ranged& one) { return one.low_95 > 0 || one.high_95 < 0; }

std::string PowerVerdict(const TrendReport& report, double least_irradiance_W_m2) {
  const TrendLoss& total = report.losses.back();
  const Ranged& energy = total.energy_percent;
  if (!std::isfinite(energy.value)) return "The series is too short for a loss.";
  if (!std::isfinite(energy.low_95)) {
    return "The series is too short for the errors of a loss.";
  }
  std::string text = fmt::format(
      "Against its first days, until {}, the device gave {:.1f} % ({:.1f} to {:.1f}) {} energy in "
      "light above {:g} W/m2 than it would have given unchanged",
      DateText(report.reference_end_s), std::fabs(energy.value),
      energy.value < 0 ? -energy.high_95 : energy.low_95,
      energy.value < 0 ? -energy.low_95 : energy.high_95, energy.value < 0 ? "more" : "less",
      least_irradiance_W_m2);
  const TrendLoss* largest = nullptr;
  for (std::size_t p = 0; p + 1 < report.losses.size(); ++p) {
    const TrendLoss& loss = report.losses[p];
    if (!(loss.energy_percent.low_95 > 0)) continue;
    if (largest == nullptr || loss.energy_percent.value > largest->energy_percent.value) {
      largest = &loss;
    }
  }
  if (largest != nullptr) {
    text += fmt::format(". The largest part, {:.1f} %, is lost by {}",
                        largest->energy_percent.value, PartTitle(largest->name));
  } else if (!Decided(energy)) {
    text += ". This interval shows no loss";
  }
  return text + ".";
}

std::string OnsetVerdict(const TrendReport& report) {
  std::string text;
  for (const TrendOnset& onset : report.onsets) {
    text += fmt::format(" From {}: {}.", DateText(onset.time_s), onset.cause.title);
  }
  return text;
}

}  // namespace

std::string PartTitle(const std::string& part) {
  if (part == "resistance_series") return "series resistance";
  if (part == "light") return "light (dirt, shade on all cells, or the light sensor)";
  if (part == "mismatch") return "mismatch (shade on a part, bypassed substrings)";
  return part;
}

std::string VerdictOf(const TrendReport& report, double least_irradiance_W_m2) {
  return PowerVerdict(report, least_irradiance_W_m2) + OnsetVerdict(report);
}

std::vector<std::string> NotDecided(const TrendReport& report) {
  std::vector<std::string> not_decided;
  const double days = (report.last_s - report.first_s) / kDay_s;
  for (const TrendLoss& loss : report.losses) {
    if (loss.name == "light" && Decided(loss.energy_percent)) {
      not_decided.emplace_back(
          "Dirt on the module, an ageing glass and a light sensor that drifts or is cleaned look "
          "alike: wash the module and take a sweep before and after, or compare the sensor with "
          "another one.");
    }
    if (loss.name == "recombination" && Decided(loss.energy_percent)) {
      not_decided.emplace_back(
          "A temperature sensor that comes off or drifts looks like recombination: compare it with "
          "Voc at sunrise, when all are at the temperature of the air.");
    }
  }
  if (report.source == TrendSource::kOperatingPoints) {
    not_decided.emplace_back(
        "Operating points do not show a shunt: what it takes is counted under light and series "
        "resistance. A sweep in dim light shows it.");
    not_decided.emplace_back(
        "Operating points do not date what grows slowly, series resistance, recombination or a "
        "shunt, nor an error of a temperature sensor: sweeps tell when it began and what it is.");
  }
  if (days < 10) {
    not_decided.emplace_back(
        "A series of less than ten days shows no steps and no onsets: its light and temperature "
        "change as its parameters would.");
  }
  if (days < 710) {
    not_decided.emplace_back(
        "A season and a trend can be told apart from two years on. Rates of a shorter series may "
        "contain a season that the law of light and temperature does not explain.");
  }
  for (const TrendQuantity& quantity : report.quantities) {
    if (!quantity.missing.empty()) {
      not_decided.push_back(fmt::format("{}: {}.", quantity.title, quantity.missing));
    }
  }
  return not_decided;
}

std::vector<std::string> FindWarnings(const TrendReport& report) {
  std::vector<std::string> warnings;
  if (report.interrupted) {
    warnings.push_back(
        fmt::format("Interrupted: what follows is of the first {} measurements.", report.rows));
  }
  const std::int64_t unusable = report.states[static_cast<int>(TrendRowState::kUnusable)];
  if (unusable * 5 > report.rows) {
    warnings.push_back(fmt::format("{} of {} measurements are unusable.", unusable, report.rows));
  }
  return warnings;
}

}  // namespace lyrefit

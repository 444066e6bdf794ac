#include "lyrefit/trend/trend_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/number_text.h"
#include "lyrefit/curve/date_time.h"
#include "lyrefit/trend/day_series.h"

namespace lyrefit {
namespace {

constexpr double kDullMatters = 0.5;  // % of the energy
constexpr double kLeastIdeality = 0.8, kMostIdeality = 2.2;

bool Decided(const Ranged& one) { return one.low_95 > 0 || one.high_95 < 0; }

double LostWhileCovered(const TrendReport& report) {
  double lost = 0;
  for (const CoveredDays& one : report.covered) lost += one.lost_percent;
  return lost;
}

// What takes the largest part of the energy, and whether it still does.
std::string LargestPart(const TrendReport& report, const TrendLoss& largest) {
  constexpr double kHalf = 0.5;
  const Ranged& energy = largest.energy_percent;
  const bool light = largest.name == "light";
  std::string by = PartTitle(largest.name);
  if (light && LostWhileCovered(report) > kHalf * energy.value) {
    by = "light, most of that on the covered days named below";
  } else if (light && report.dull_sky_percent > energy.value) {
    by = "light (the light sensor under dull skies, shade on all cells, dirt)";
  }
  std::string text = fmt::format(". The largest part, {:.1f} %, is lost by {}", energy.value, by);
  const Ranged& now = largest.now_percent;
  const bool over =
      std::isfinite(now.low_95) && now.low_95 <= 0 && now.value < kHalf * energy.value;
  if (over) {
    text += fmt::format(". It is over: the last 30 days have {:.1f} % ({:.1f} to {:.1f}) of it",
                        now.value, now.low_95, now.high_95);
  }
  return text;
}

std::string PowerVerdict(const TrendReport& report, const TrendOptions& options) {
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
      options.least_irradiance_W_m2);
  const TrendLoss* largest = nullptr;
  for (std::size_t p = 0; p + 1 < report.losses.size(); ++p) {
    const TrendLoss& loss = report.losses[p];
    if (!(loss.energy_percent.low_95 > 0)) continue;
    if (largest == nullptr || loss.energy_percent.value > largest->energy_percent.value) {
      largest = &loss;
    }
  }
  if (largest != nullptr && energy.low_95 > 0) {
    text += LargestPart(report, *largest);
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

// What was left out because no device gives it; the reasons are above the verdict.
std::string DoubtVerdict(const TrendReport& report) {
  std::string text;
  for (const TrendReason& reason : report.reasons) {
    if (!reason.doubtful) continue;
    text += fmt::format("{} that no device gives are left out, {} to {}. ",
                        Plural(reason.rows, "measurement"), DateText(reason.first_s),
                        DateText(reason.last_s));
  }
  return text;
}

std::string SkyVerdict(const TrendReport& report) {
  std::string text;
  if (report.dull_sky_percent > kDullMatters) {
    text += fmt::format(
        " Besides, {:.1f} % of the light that the sensor shows under dull skies does not reach the "
        "device: its sensor answers otherwise to such light, nothing is lost.",
        report.dull_sky_percent);
  }
  for (const CoveredDays& covered : report.covered) {
    text += fmt::format(" {} on {}: {:.1f} % of the energy.",
                        covered.frost ? "Covered in the cold, by snow or ice most likely,"
                                      : "Covered or in shade for most of the day",
                        DaysText(covered.days_s), covered.lost_percent);
  }
  return text;
}

}  // namespace

std::string ReasonText(const TrendReason& reason) {
  const std::string first = std::isfinite(reason.first_s) ? DateText(reason.first_s) : "";
  const std::string last = std::isfinite(reason.last_s) ? DateText(reason.last_s) : "";
  return fmt::format("{}{}{}{}{}: {}", Plural(reason.rows, "measurement"),
                     first.empty() ? "" : ", ", first, first == last ? "" : " to ",
                     first == last ? "" : last, reason.reason);
}

std::string DaysText(const std::vector<double>& days_s) {
  constexpr double kNext = 1.7;  // days between means of neighbouring days, at most
  std::string text;
  for (std::size_t begin = 0; begin < days_s.size();) {
    std::size_t end = begin + 1;
    while (end < days_s.size() && days_s[end] - days_s[end - 1] < kNext * kDay_s) ++end;
    if (!text.empty()) text += ", ";
    text += DateText(days_s[begin]);
    if (end > begin + 1) text += " to " + DateText(days_s[end - 1]);
    begin = end;
  }
  return text;
}

bool IsBelowAYear(const TrendReport& report) {
  return report.last_s - report.first_s < kLeastForRate_days * kDay_s;
}

std::string ExchangeWarning(const ExchangedDevice& exchange) {
  std::string changed;
  for (const std::string& one : exchange.changed) {
    changed += (changed.empty() ? "" : ", ") + one;
  }
  if (!exchange.certain) {
    return fmt::format(
        "On {} at once {}: several faults of one day, or from then on another device. Compare its "
        "serial number.",
        DateText(exchange.time_s), changed);
  }
  return fmt::format(
      "From {} on the measurements are of another device, or this one was repaired: at once {}. "
      "What follows is of the days before. Give each device a file of its own.",
      DateText(exchange.time_s), changed);
}

std::string PartTitle(const std::string& part) {
  if (part == "resistance_series") return "series resistance";
  if (part == "light") return "light (dirt, shade on all cells, or the light sensor)";
  if (part == "mismatch") return "mismatch (shade on a part, bypassed substrings)";
  return part;
}

std::string VerdictOf(const TrendReport& report, const TrendOptions& options) {
  return DoubtVerdict(report) + PowerVerdict(report, options) + SkyVerdict(report) +
         OnsetVerdict(report);
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
  if (report.ideality < kLeastIdeality || report.ideality > kMostIdeality) {
    warnings.push_back(
        fmt::format("The law has n = {:.2f}, of no junction: the sweeps of the reference days are "
                    "shaded, or the number of cells is not {}.",
                    report.ideality, report.cells_in_series));
  }
  const std::int64_t unusable = report.states[static_cast<int>(TrendRowState::kUnusable)];
  if (unusable * 5 > report.rows) {
    warnings.push_back(fmt::format("{} of {} measurements are unusable.", unusable, report.rows));
  }
  return warnings;
}

}  // namespace lyrefit

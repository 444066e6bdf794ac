#include "lyrefit/diagnose/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/distributions.h"
#include "lyrefit/base/median.h"
#include "lyrefit/diagnose/describe.h"
#include "lyrefit/diagnose/device_findings.h"
#include "lyrefit/diagnose/values.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/estimate/fit/statistics.h"

namespace lyrefit {
namespace {

double MedianSigma(const Noise& noise) { return UpperMedian(noise.sigma); }

// Statistics of the base model's residuals at the positions marked in `used`.
ResidualStatistics StatisticsOf(const AtReadings& at, const std::vector<char>& used) {
  const Readings& readings = *at.weighted.readings;
  std::vector<double> voltages, residuals;
  for (std::size_t g = 0; g + 1 < at.first.size(); ++g) {
    for (int k = at.first[g]; k < at.first[g + 1] && used[g] != 0; ++k) {
      voltages.push_back(readings.points[k].voltage * readings.scale.cells);
      residuals.push_back((at.base[k] - readings.points[k].current) * readings.scale.current_A);
    }
  }
  return FindResidualStatistics(voltages, residuals);
}

// Misfit of a fit to all readings, also those within averages, divided by their noise.
double MisfitRatio(const WeightedData& weighted, const LawFit& fit, const AtReadings& at) {
  double within = 0, more = 0;  // squares about the averages; readings minus averages
  for (std::size_t k = 0; k < fit.current.size(); ++k) {
    if (weighted.used[k] == 0) continue;
    const Reading& reading = weighted.readings->points[k];
    const double sigma = at.weighted.sigma[at.first[k]];
    within += reading.weight * reading.scatter / (sigma * sigma);
    more += reading.weight - 1;
  }
  return std::sqrt((fit.sum + within) / (Degrees(weighted, fit.law) + more));
}

// Reports a photocurrent at 1000 W/m2 larger than that of any string: the stated irradiance is
// wrong.
void AddIrradianceFinding(const Readings& readings, Evidence* evidence) {
  constexpr double kMost_A = 25;
  const double light = readings.points.front().irradiance;
  if (!readings.traits.single || readings.traits.only_dark || !(light > 0)) return;
  const double full = readings.scale.current_A / light;
  if (full < kMost_A || readings.scale.strings > 1) return;
  evidence->findings.push_back(
      {"irradiance",
       fmt::format("at the stated {:.4g} W/m2 the short-circuit current would be {:.3g} A at 1000 "
                   "W/m2, more than any string of cells gives; {:.2g} to {:.2g} W/m2 would give 6 "
                   "to 12 A",
                   1000 * light, full, 1000 * readings.scale.current_A / 12,
                   1000 * readings.scale.current_A / 6),
       {}});
}

// What would make n plausible (1 to 1.25), as far as it is possible. The data determine n Ns T only.
struct Plausible {
  bool temperature = false;  // a possible temperature does
  double coldest_C = 0;
  double warmest_C = 0;
  int cells = 0;  // a whole number of bypass groups, or of few cells, does; 0: none or several do
};

Plausible PlausibleConditions(const Readings& readings, double n) {
  constexpr double kColdest_C = -40, kWarmest_C = 110;  // of cells outdoors and in the laboratory
  constexpr double kMostOfModules = 1.25, kMostOfCells = 1.6;
  constexpr int kFewest = 18;  // cells of a bypass group
  const bool few = readings.scale.cells < kFewest;
  Plausible plausible;
  const double kelvin = readings.reference_temperature_K * n;
  plausible.coldest_C = std::max(kelvin / kMostOfModules - kZeroCelsius_K, kColdest_C);
  plausible.warmest_C = std::min(kelvin - kZeroCelsius_K, kWarmest_C);
  plausible.temperature = plausible.coldest_C < plausible.warmest_C;
  const double group =
      few ? 1 : static_cast<double>(readings.scale.cells) / SubstringsOf(readings.traits);
  const double most = std::floor(readings.scale.cells * n / group);
  const double least =
      std::ceil(readings.scale.cells * n / (few ? kMostOfCells : kMostOfModules) / group);
  if (readings.traits.module && most == least && most > 0) {
    plausible.cells = static_cast<int>(std::lround(most * group));
  }
  return plausible;
}

// Reports n below 1, an indication of a wrong temperature or number of cells even if not
// significant.
void AddIdealityFinding(const Selection& selection, Evidence* evidence) {
  const Readings& readings = *selection.weighted.readings;
  const double n = std::min(Ideality(selection.base), Ideality(selection.extended));
  if (n > 1) return;
  const Plausible plausible = PlausibleConditions(readings, n);
  evidence->findings.push_back(
      {"n_below_1",
       plausible.temperature
           ? fmt::format("n = {:.3f} is below 1: at {} cells, n between 1 and 1.25 needs {:.0f} to "
                         "{:.0f} C, not the {:.1f} C stated; check the temperature and the number "
                         "of cells",
                         n, readings.scale.cells, plausible.coldest_C, plausible.warmest_C,
                         readings.reference_temperature_K - kZeroCelsius_K)
           : fmt::format("n = {:.3f} is below that of any junction at any plausible temperature",
                         n),
       {}});
}

// Reports readings at a limit of the instrument and the current grid.
void AddValueFindings(const AtReadings& at, const ValueFindings& values, Evidence* evidence) {
  const ReadingScale& scale = at.weighted.readings->scale;
  const auto clipping = [&](const std::vector<int>& points, const std::string& text) {
    evidence->findings.push_back({"clipping", text, points});
  };
  if (evidence->clipped_points > 0) {
    clipping(values.clipped,
             fmt::format("{} readings repeat the largest current, {:.6g} A, exactly",
                         evidence->clipped_points, evidence->clip_level_A));
  }
  if (values.limited) {
    clipping(values.at_lower,
             fmt::format("{} readings repeat the smallest current, {:.6g} A, exactly",
                         values.at_lower.size(), values.lower_limit * scale.current_A));
  }
  if (!values.limited && !values.at_lower.empty()) {
    clipping(
        values.at_lower,
        fmt::format("{} readings stay at the smallest current while the voltage rises, and are "
                    "left out",
                    values.at_lower.size()));
  }
  if (!values.at_voltage_limit.empty()) {
    clipping(
        values.at_voltage_limit,
        fmt::format("{} readings repeat the largest voltage, {:.6g} V, while the current falls",
                    values.at_voltage_limit.size(), values.voltage_limit * scale.cells));
  }
  if (evidence->grid_step_A > 0) {
    evidence->findings.push_back(
        {"grid",
         fmt::format("all currents lie on a grid of {:.4g} A; the noise is {:.3g} A",
                     evidence->grid_step_A, MedianSigma(at.noise) * scale.current_A),
         {}});
  }
}

// Reports misfit, runs and correlation of the base model's residuals.
void AddResidualFindings(const Selection& selection, Evidence* evidence) {
  std::vector<Finding>& findings = evidence->findings;
  if (evidence->misfit_ratio > 1.1) {
    findings.push_back(
        {"misfit",
         fmt::format("the base model misses by {:.3g} times the noise", evidence->misfit_ratio),
         {}});
  }
  if (evidence->residuals.runs_p_value < 0.01) {
    findings.push_back(
        {"runs",
         fmt::format("residuals of one sign stand together: {} runs where {:.0f} are expected "
                     "(p = {:.2g})",
                     evidence->residuals.runs, evidence->residuals.expected_runs,
                     evidence->residuals.runs_p_value),
         {}});
  }
  if (selection.weighted.correlation > 0) {
    findings.push_back({"autocorrelation",
                        fmt::format("neighbouring noise is correlated by {:.2f}; the tests allow "
                                    "for it",
                                    selection.weighted.correlation),
                        {}});
  }
}

void AddFindings(const Selection& selection, const AtReadings& at, const ValueFindings& values,
                 Evidence* evidence) {
  AddValueFindings(at, values, evidence);
  AddResidualFindings(selection, evidence);
  AddIrradianceFinding(*at.weighted.readings, evidence);
  AddIdealityFinding(selection, evidence);
  const std::vector<double>& p = selection.extended.p;
  const double ohm = at.weighted.readings->scale.resistance_ohm();
  for (const auto& [value, name] : {std::pair{ohm / p[kRsh], "1/Rsh"}, {p[kRs] / ohm, "Rs"}}) {
    if (value > 1e-9) continue;
    evidence->findings.push_back({"bound", fmt::format("{} is pressed against 0", name), {}});
  }
}

}  // namespace

double Whiteness(const WeightedData& weighted, const LawFit& fit) {
  constexpr int kLags = 8;
  const std::vector<Reading>& points = weighted.readings->points;
  const int count = static_cast<int>(points.size());
  Eigen::VectorXd r(count);
  for (int k = 0; k < count; ++k) r[k] = fit.current[k] - points[k].current;
  r = Whiten(weighted, r);
  const double total = r.squaredNorm();
  if (count < 3 * kLags || !(total > 0) || !std::isfinite(total)) return 1;
  double statistic = 0;
  for (int lag = 1; lag <= kLags; ++lag) {
    double product = 0;
    for (int k = lag; k < count; ++k) {
      if (points[k].segment == points[k - lag].segment) product += r[k] * r[k - lag];
    }
    const double correlation = product / total;
    statistic += correlation * correlation / (count - lag);
  }
  statistic *= static_cast<double>(count) * (count + 2);
  return ChiSquaredTail(statistic, kLags);
}

std::string KindOfData(const Readings& readings) {
  const DataTraits& t = readings.traits;
  std::string text;
  if (t.only_dark) {
    text = "dark only";
  } else if (t.single) {
    text = t.up_down ? "one curve, up and down" : "one sweep";
  } else if (t.dark && t.curves == 2) {
    text = "a lit and a dark curve";
  } else {
    text = fmt::format("{} curves over {} irradiances and {} temperatures", t.curves,
                       t.irradiance_levels, t.temperature_levels);
    if (t.dark) text += ", with a dark one";
  }
  if (t.suns_voc) text += ", and Suns-Voc";
  if (t.reverse) text += fmt::format(", reverse bias to {:.3g} V", t.lowest_voltage * t.cells);
  if (t.beyond_voc) text += ", beyond open circuit";
  if (t.up_down && !readings.scale.times) text += ", without times";
  return text;
}

Evidence DescribeEvidence(const Selection& selection, const AtReadings& at,
                          const ValueFindings& values, const Autocorrelation& autocorrelation) {
  const WeightedData& weighted = selection.base_weighted;
  const Readings& readings = *at.weighted.readings;
  const double scale = readings.scale.current_A;
  Evidence evidence;
  evidence.kind = KindOfData(readings);
  evidence.noise_constant_A = at.noise.lit.constant * scale;
  evidence.noise_voltage_V = at.noise.lit.voltage * readings.scale.cells;
  evidence.noise_relative = at.noise.lit.relative;
  evidence.noise_path_A = selection.weighted.path * scale;
  if (readings.traits.dark || readings.traits.only_dark) {
    evidence.noise_dark_A = at.noise.dark.constant * scale;
  }
  evidence.misfit_ratio = MisfitRatio(weighted, selection.base, at);
  evidence.autocorrelation = autocorrelation.value;
  evidence.grid_step_A = std::max(values.grids.lit, values.grids.dark) * scale;
  std::vector<double> voltages;
  for (const Reading& r : readings.points) voltages.push_back(r.voltage * readings.scale.cells);
  evidence.grid_step_V = FindGrid(voltages);
  evidence.clipped_points = static_cast<int>(values.clipped.size());
  evidence.clip_level_A = values.clip_level * scale;
  evidence.residuals = StatisticsOf(at, weighted.used);
  AddFindings(selection, at, values, &evidence);
  return evidence;
}

namespace {

Cause Metadata(const char* evidence, double probability) {
  const Effect& effect = *FindEffect("temperature_or_cells");
  Cause cause = MakeCause(effect, evidence, probability);
  cause.separate_by = {effect.separate_by};
  return cause;
}

// The stated number of cells requires a higher voltage per cell than a junction gives.
Cause WrongCells(const Selection& selection) {
  const DataTraits& traits = selection.weighted.readings->traits;
  const double cells = traits.cells * Ideality(selection.extended);
  Cause cause = Metadata("values", 1);
  cause.strength = {{"Ns", "cells_for_n_1_to_1.5", "", cells / 1.2, cells / 1.5, cells, false}};
  cause.sentence = fmt::format(
      "{} stated cells would each give {:.3g} V, more than a junction can; {:.0f} to {:.0f} cells "
      "make n plausible (1 to 1.5)",
      traits.stated_cells, traits.open_circuit * traits.cells / traits.stated_cells,
      std::ceil(cells / 1.5), std::floor(cells));
  cause.in_words = {cause.sentence};
  return cause;
}

// Whether n is plausible if one bypass group without voltage is not counted.
bool LacksAGroup(const DataTraits& traits, double n) {
  constexpr double kLeast = 0.97, kMost = 1.5;
  const int groups = SubstringsOf(traits);
  if (!traits.cells_known || groups < 2) return false;
  const double without = n * groups / (groups - 1);
  return without >= kLeast && without <= kMost;
}

// For one curve a shorted group is as plausible as a wrong number of cells or temperature: they
// share the probability of `metadata`. Where the number of groups is assumed, the group stands
// behind.
Cause ShortedGroup(const DataTraits& traits, double n, const Cause& metadata) {
  constexpr double kPartIfStated = 0.85, kPartIfAssumed = 0.4;
  const Effect& effect = *FindEffect("bypass_short");
  const int groups = SubstringsOf(traits);
  const double all = metadata.probability;
  const double group = all * (traits.bypass_known ? kPartIfStated : kPartIfAssumed);
  const std::string words = fmt::format("1 of {}{} bypass groups gives no voltage", groups,
                                        traits.bypass_known ? "" : " (assumed)");
  const std::string sentence = fmt::format(
      "a group of cells is shorted, or the number of cells or the temperature is wrong: {}; "
      "n = {:.2f} at {} cells, {:.2f} without that group",
      words, n, traits.stated_cells, n * groups / (groups - 1));
  Cause cause = metadata;
  Alternative other = {effect.id, effect.title, group};
  if (traits.bypass_known) {
    cause = MakeCause(effect, metadata.evidence.c_str(), group);
    cause.alternatives = metadata.alternatives;
    cause.strength = {{"w", "share", "", 1.0 / groups, kUnknown, kUnknown, false},
                      metadata.strength.front()};
    cause.in_words = {words};
    other = {metadata.id, metadata.title, all - group};
  }
  cause.probability = all - other.probability;
  cause.alternatives.insert(cause.alternatives.begin(), other);
  cause.equivalents = {other.id};
  cause.separate_by = {effect.separate_by, metadata.separate_by.front()};
  cause.sentence = sentence;
  return cause;
}

}  // namespace

double LeastIdeality(const WeightedData& weighted) {
  constexpr double kBent = 0.9, kStraight = 0.97;
  return weighted.path > 0 ? kBent : kStraight;
}

std::vector<Cause> CheckTemperatureAndCells(const Selection& selection, bool shorted) {
  // Above 3, the number of cells is rather wrong than the junction.
  constexpr double kLargest = 3, kSure = 1e-4, kSureAlone = 0.01;
  const double smallest = LeastIdeality(selection.weighted);
  const LawFit& fit = selection.extended;
  const WeightedData& weighted = selection.weighted;
  const Readings& readings = *weighted.readings;
  const DataTraits& traits = readings.traits;
  if (traits.cells_known && traits.stated_cells != traits.cells) return {WrongCells(selection)};
  // Beside another cause n may be a consequence of what that cause leaves. Before the knee it is
  // not determined.
  if (!selection.causes.empty() || !ReachesPastKnee(readings)) return {};
  const double n = Ideality(fit);
  if (n >= smallest && n <= kLargest) return {};
  const Plausible plausible = PlausibleConditions(readings, n);
  if (!plausible.temperature && plausible.cells == 0) return {};
  const std::vector<double> errors = StandardErrors(Linearize(weighted, fit));
  const double error = errors[IdealityIndex(0)] * std::sqrt(SquarePerDegree(weighted, fit));
  if (!(error > 0)) return {};
  const double distance = (n < smallest ? smallest - n : n - kLargest) / error;
  const double p = NormalTail(distance);
  // Unlike cells lower n as well: what else may act shares the probability.
  const double probability = (1 - p) * (weighted.path > 0 ? selection.none : 1);
  const bool alone = p < kSureAlone && probability > 0.8;
  if (!alone && !(p < kSure && probability > 0.5)) return {};
  Cause cause = Metadata("fit", probability);
  if (weighted.path > 0) cause.alternatives = TriedAlone(selection);
  const double z = StudentT95(Degrees(weighted, fit.law)) * error;
  cause.strength = {{"n", "n", "", n, n - z, n + z, false}};
  std::vector<std::string> needs;
  if (plausible.temperature) {
    const double kelvin = readings.reference_temperature_K * n;
    cause.strength.push_back({"T", "temperature_for_n_1_to_1.25", "C",
                              kelvin / 1.1 - kZeroCelsius_K, plausible.coldest_C,
                              plausible.warmest_C, false});
    needs.push_back(fmt::format("{:.0f} to {:.0f} C instead of {:.1f}", plausible.coldest_C,
                                plausible.warmest_C,
                                readings.reference_temperature_K - kZeroCelsius_K));
  }
  if (plausible.cells > 0) {
    const double cells = plausible.cells;
    cause.strength.push_back({"Ns", "cells_for_n_1_to_1.25", "", cells, cells, cells, false});
    needs.push_back(fmt::format("{} cells instead of {}", plausible.cells, readings.scale.cells));
  }
  cause.in_words = {
      fmt::format("n = {:.2f}, where a junction needs {}", n, fmt::join(needs, ", or "))};
  cause.sentence += "; " + cause.in_words.front();
  if (shorted && LacksAGroup(traits, n)) return {ShortedGroup(traits, n, cause)};
  return {cause};
}

}  // namespace lyrefit

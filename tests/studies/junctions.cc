#include "studies/junctions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/seconds.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/two_junctions.h"
#include "lyrefit/report/document.h"
#include "lyrefit/report/text_layout.h"
#include "synthetic/draw.h"

namespace lyrefit {
namespace {

constexpr double kTandemTemperature_K = 298.15;

// Ranges of a junction: current density in mA/cm2, open-circuit voltage in V, ideality, shunt in
// ohm cm2.
struct JunctionRange {
  double low_current, high_current;
  double low_voltage, high_voltage;
  double low_n, high_n;
  double low_shunt, high_shunt;
};

// Top and bottom junction of perovskite on silicon, then of GaInP on GaAs: ranges around the
// currents and voltages of good cells, chosen for this study.
constexpr JunctionRange kRanges[2][2] = {
    {{18, 21, 1.05, 1.22, 1.2, 1.9, 800, 20000}, {18, 21, 0.65, 0.74, 1.0, 1.4, 1000, 50000}},
    {{13, 15, 1.33, 1.46, 1.0, 1.7, 2000, 50000}, {13, 15, 0.98, 1.06, 1.0, 1.6, 2000, 50000}}};

void DrawJunction(const JunctionRange& range, double area_cm2, int j, RandomStream* random,
                  std::vector<double>* p) {
  const double thermal_V = ThermalVoltage(kTandemTemperature_K);
  const double current = 1e-3 * area_cm2 * Between(random, range.low_current, range.high_current);
  const double voltage = Between(random, range.low_voltage, range.high_voltage);
  const double n = Between(random, range.low_n, range.high_n);
  (*p)[JunctionPhotocurrent(j)] = current;
  (*p)[JunctionSaturation(j)] = SaturationCurrent(current, voltage, n * thermal_V);
  (*p)[JunctionIdeality(j)] = n;
  (*p)[JunctionShunt(j)] = LogUniform(random, range.low_shunt, range.high_shunt) / area_cm2;
}

IvCurve SimulateIn(const JunctionsOptions& options, std::vector<double> p, const char* name,
                   double top, double bottom, RandomStream* random) {
  IvCurve curve;
  curve.name = name;
  curve.conditions.cell_temperature_K = kTandemTemperature_K;
  curve.conditions.cells_in_series = 2;
  curve.notes.light_top = top;
  curve.notes.light_bottom = bottom;
  p[JunctionPhotocurrent(0)] *= top;
  p[JunctionPhotocurrent(1)] *= bottom;
  const double thermal_V = ThermalVoltage(kTandemTemperature_K);
  const double voc = TwoJunctionVoltage(thermal_V, p.data(), 0);
  const double isc = TwoJunctionCurrent(thermal_V, p.data(), 0);
  for (int k = 0; k < options.points; ++k) {
    const double voltage = -0.1 + (1.02 * voc + 0.1) * k / (options.points - 1);
    curve.voltage_V.push_back(voltage);
    curve.current_A.push_back(TwoJunctionCurrent(thermal_V, p.data(), voltage) +
                              options.noise_relative * isc * random->Normal());
  }
  return curve;
}

struct FittedTandem {
  bool usable = false;
  bool above = false;
  std::vector<Estimate> estimates;
  std::vector<double> truth;
};

FittedTandem FitOne(const JunctionsOptions& options, int s) {
  const SimulatedTandem tandem = DrawTandem(options, s);
  TwoJunctionOptions how;
  how.threads = 1;
  FittedTandem fitted;
  const auto report = FitTwoJunctions(tandem.set, how);
  fitted.usable = report && report->usable;
  if (!fitted.usable) return fitted;
  double sum = 0, count = 0;
  for (std::size_t c = 0; c < tandem.set.curves.size(); ++c) {
    const IvCurve& curve = tandem.set.curves[c];
    std::vector<double> p = tandem.truth;
    p[JunctionPhotocurrent(0)] *= tandem.light[c].top;
    p[JunctionPhotocurrent(1)] *= tandem.light[c].bottom;
    for (std::size_t k = 0; k < curve.size(); ++k) {
      const double miss =
          TwoJunctionCurrent(ThermalVoltage(kTandemTemperature_K), p.data(), curve.voltage_V[k]) -
          curve.current_A[k];
      sum += miss * miss;
      count += 1;
    }
  }
  fitted.above = report->rmse.refined.solved_current_A > std::sqrt(sum / count);
  fitted.estimates = report->estimates;
  for (const Estimate& e : fitted.estimates) {
    fitted.truth.push_back(TruthOf(tandem, *report, e.info));
  }
  return fitted;
}

void Count(const FittedTandem& fitted, std::vector<std::vector<double>>* widths,
           JunctionsReport* report) {
  for (std::size_t i = 0; i < fitted.estimates.size(); ++i) {
    const Estimate& e = fitted.estimates[i];
    if (report->parameters.size() <= i) {
      report->parameters.emplace_back();
      report->parameters.back().info = e.info;
      widths->emplace_back();
    }
    ParameterCoverage& p = report->parameters[i];
    ++p.fitted;
    if (!e.identifiable) ++p.not_identifiable;
    if (!e.identifiable || std::isnan(e.low_95) || std::isnan(fitted.truth[i])) continue;
    ++p.counted;
    p.covered += e.low_95 <= fitted.truth[i] && fitted.truth[i] <= e.high_95 ? 1 : 0;
    (*widths)[i].push_back(0.5 * (e.high_95 - e.low_95) / fitted.truth[i]);
  }
}

}  // namespace

SimulatedTandem DrawTandem(const JunctionsOptions& options, int s) {
  RandomStream random(options.seed, static_cast<std::uint64_t>(s));
  const double area_cm2 = LogUniform(&random, 0.1, 20);
  SimulatedTandem tandem;
  tandem.set.name = "tandem " + std::to_string(s);
  tandem.truth.resize(kTwoJunctionParameters);
  for (int j = 0; j < 2; ++j) {
    DrawJunction(kRanges[s % 2][j], area_cm2, j, &random, &tandem.truth);
  }
  tandem.truth[kTwoJunctionSeries] = Between(&random, 0.5, 5) / area_cm2;
  const double red = Between(&random, 0.05, 0.2), blue = Between(&random, 0.05, 0.2);
  const auto add = [&](const char* name, double top, double bottom) {
    tandem.set.curves.push_back(SimulateIn(options, tandem.truth, name, top, bottom, &random));
  };
  add("reference", 1, 1);
  tandem.light = {{1, 1}};
  if (options.spectra == Spectra::kOne) return tandem;
  add("red-rich", 1 - red, 1 + red);
  add("blue-rich", 1 + blue, 1 - blue);
  tandem.light = {{1, 1}, {1 - red, 1 + red}, {1 + blue, 1 - blue}};
  if (options.spectra == Spectra::kBias) {
    add("top alone", 1, 0);
    add("bottom alone", 0, 1);
    tandem.light.insert(tandem.light.end(), {{1, 0}, {0, 1}});
  }
  if (options.spectra == Spectra::kUnknown) {
    for (std::size_t c = 1; c < 3; ++c) tandem.set.curves[c].notes.light_bottom.reset();
  }
  return tandem;
}

double TruthOf(const SimulatedTandem& tandem, const TwoJunctionReport& report,
               const ParameterInfo& info) {
  std::vector<double> truth = tandem.truth;
  const double one = truth[JunctionPhotocurrent(0)], two = truth[JunctionPhotocurrent(1)];
  if (report.interchangeable) {
    if (one > two) std::swap_ranges(truth.begin(), truth.begin() + 4, truth.begin() + 4);
    truth[JunctionPhotocurrent(1)] = std::max(one, two) / std::min(one, two) - 1;
  }
  for (int i = 0; i < kTwoJunctionParameters; ++i) {
    if (report.estimates[i].info.symbol == info.symbol) return truth[i];
  }
  for (std::size_t c = 0; c < tandem.set.curves.size(); ++c) {
    if (info.symbol == "Iph2[" + tandem.set.curves[c].name + "]") {
      return two * tandem.light[c].bottom;
    }
  }
  return kUnknown;
}

JunctionsReport CountJunctions(const JunctionsOptions& options, const Observer& observer) {
  const Instant begin = Now();
  std::vector<FittedTandem> fits(options.sets);
  const ProgressReporter progress(observer, "junctions", options.sets);
  std::vector<char> done(options.sets, 0);
  ParallelFor(options.sets, options.threads, [&](int s) {
    if (progress.stop().requested()) return;
    fits[s] = FitOne(options, s);
    done[s] = 1;
    progress.Step();
  });
  JunctionsReport report;
  std::vector<std::vector<double>> widths;
  for (int s = 0; s < options.sets; ++s) {
    if (done[s] == 0) continue;
    ++report.sets;
    report.failed += fits[s].usable ? 0 : 1;
    report.above += fits[s].above ? 1 : 0;
    Count(fits[s], &widths, &report);
  }
  for (std::size_t i = 0; i < report.parameters.size(); ++i) {
    ParameterCoverage& p = report.parameters[i];
    const Share share = WilsonInterval(p.covered, p.counted);
    p.low_95 = share.low_95;
    p.high_95 = share.high_95;
    if (p.counted == 0) continue;
    p.coverage = static_cast<double>(p.covered) / p.counted;
    std::sort(widths[i].begin(), widths[i].end());
    p.median_half_width = widths[i][widths[i].size() / 2];
  }
  report.seconds = SecondsSince(begin);
  return report;
}

std::string JunctionsText(const JunctionsOptions& options, const JunctionsReport& report) {
  Document document;
  Section& head = document.head;
  head.heading =
      fmt::format("coverage of the 95 % intervals of two junctions, {} tandems", report.sets);
  AddField("curves",
           fmt::format("{} of {} points each, noise {:g} of Isc, seed {}", ToText(options.spectra),
                       options.points, options.noise_relative, options.seed),
           &head);
  AddField("failed", std::to_string(report.failed), &head);
  AddField("RMSE above that of the truth", std::to_string(report.above), &head);
  AddField("time", Duration(report.seconds), &head);
  block::Table table = {
      "lrlrrr",
      {{"parameter", "coverage", "95 % range", "counted", "half-width", "not identifiable"}}};
  for (const ParameterCoverage& p : report.parameters) {
    table.rows.push_back({p.info.symbol, fmt::format("{:.1f} %", 100 * p.coverage),
                          fmt::format("{:.1f} .. {:.1f} %", 100 * p.low_95, 100 * p.high_95),
                          std::to_string(p.counted),
                          fmt::format("{:.2g} %", 100 * p.median_half_width),
                          fmt::format("{:.1f} %", 100.0 * p.not_identifiable / p.fitted)});
  }
  AddSections({{"", {table}}}, &document);
  return DrawText(document);
}

}  // namespace lyrefit

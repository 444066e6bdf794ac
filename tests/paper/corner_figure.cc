#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "lyrefit/model/device.h"
#include "paper/corner_page.h"

namespace lyrefit {
namespace {

constexpr char kOptimum[] = "two diodes, the optimum";
constexpr char kLiterature[] = "one diode, which the literature reports for two";

// Right-hand side minus measured current at the readings, in mA.
Series Residuals(const FitReport& report, const char* name, Look look) {
  Series series{SeriesKind::kLineAndPoints, look, 1.5};
  series.name = name;
  const IvCurve& curve = report.curve;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const double current = ExplicitCurrent(report.device, report.refined.data(), curve.voltage_V[k],
                                           curve.current_A[k]);
    series.Add(curve.voltage_V[k], 1e3 * (current - curve.current_A[k]));
  }
  return series;
}

Panel ResidualPanel(const CornerStudy& study) {
  Panel panel{"What they leave of the readings"};
  panel.x = {"Voltage (V)"};
  panel.y = {"Right-hand side - measured (mA)"};
  panel.zero_line = true;
  panel.series = {Residuals(study.one, kLiterature, {kVermilion, 1, 9}),
                  Residuals(study.two, kOptimum, {kBlue, 1, 7})};
  panel.height = 330;
  return panel;
}

// Three strips per search: final RMSE of the search, after one bounded solve, and after all starts.
struct Strip {
  const char* name;
  double RunRecord::*end_A;
  Look look;
};

const Strip kStrips[] = {{"search alone", &RunRecord::searched_A, {kGrey, 1, 7}},
                         {"and one bounded solve", &RunRecord::plain_polished_A, {kOrange, 1, 7}},
                         {"and all starts", &RunRecord::polished_A, {kBlue, 1, 7}}};

// Offset of a run within its strip, so that equal RMSE values of several runs stay visible.
double PlaceInStrip(int run) {
  constexpr double kGoldenRatio = 0.6180339887498949;
  constexpr double kWidth = 0.22;
  const double turn = run * kGoldenRatio;
  return kWidth * (turn - std::floor(turn) - 0.5);
}

constexpr double kLowest_A = 1e-3;
constexpr double kHighest_A = 1;

// Label above a horizontal line, at its right end.
Note LineNote(const char* text, double rmse_A, const char* colour) {
  constexpr double kAboveLine = 0.028;
  const double height = std::log(rmse_A / kLowest_A) / std::log(kHighest_A / kLowest_A);
  return {text, colour, 0.99, height + kAboveLine, "right"};
}

Panel StripPanel(const CornerStudy& study, std::int64_t budget) {
  Panel panel{fmt::format("Where every run of {} evaluations ends", budget)};
  panel.y = {"RMSE (A, measured-current)", kLowest_A, kHighest_A};
  panel.y.log = true;
  panel.rules = {{study.literature_A(), kVermilion, 2, 1.5}, {study.optimum_A(), kBlue, 2, 1.5}};
  for (const Strip& strip : kStrips) {
    Series series{SeriesKind::kPoints, strip.look};
    series.size = 0.6;
    series.name = strip.name;
    panel.series.push_back(std::move(series));
  }
  double place = 0;
  for (const AlgorithmResult& compared : study.comparison.problems.at(0).algorithms) {
    if (compared.name != compared.algorithm + "@" + std::to_string(budget)) continue;
    ++place;
    panel.x.ticks.push_back({compared.algorithm, place});
    for (int s = 0; s < 3; ++s) {
      for (const RunRecord& run : compared.runs) {
        const double x = place + 0.27 * (s - 1) + PlaceInStrip(run.run);
        panel.series[s].Add(x, run.*kStrips[s].end_A);
      }
    }
  }
  panel.x.low = 0.4;
  panel.x.high = place + 1.7;  // space for the line labels
  panel.notes = {LineNote("the literature's figure", study.literature_A(), kVermilion),
                 LineNote("the optimum", study.optimum_A(), kBlue)};
  panel.height = 330;
  return panel;
}

}  // namespace

Figure CornerFigure(const CornerStudy& study) {
  const std::vector<std::int64_t>& budgets = study.options.budgets;
  const std::int64_t budget = budgets[budgets.size() > 1 ? budgets.size() - 2 : 0];
  Figure figure{
      fmt::format("Photowatt-PWP201, two diodes, the literature's bounds; {} runs of each",
                  study.options.runs)};
  figure.legend = {{kLiterature, {kVermilion, 1, 9}, LegendMark::kLineAndPoint},
                   {kOptimum, {kBlue, 1, 7}, LegendMark::kLineAndPoint}};
  for (const Strip& strip : kStrips) {
    figure.legend.push_back({strip.name, strip.look, LegendMark::kPoint});
  }
  figure.panels = {ResidualPanel(study), StripPanel(study, budget)};
  figure.columns = 1;
  return figure;
}

}  // namespace lyrefit

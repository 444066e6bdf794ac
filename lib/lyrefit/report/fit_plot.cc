#include "lyrefit/report/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/numbers.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/report/figure_parts.h"
#include "lyrefit/report/fit_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr int kModelPoints = 500;
constexpr std::size_t kSomePoints = 60;   // more points have smaller symbols
constexpr std::size_t kManyPoints = 150;  // more points have small pale symbols

// SI prefix that brings the largest number close to 1.
struct Prefix {
  const char* text;
  double factor;
};

Prefix PrefixFor(double largest) {
  if (largest >= 0.1 || !(largest > 0)) return {"", 1};
  if (largest >= 1e-4) return {"m", 1e3};
  if (largest >= 1e-7) return {"u", 1e6};
  return {"n", 1e9};
}

// Lowest and highest of some numbers and zero.
struct Span {
  double low = 0;
  double high = 0;
  double Largest() const { return std::max(-low, high); }
};

Span SpanOf(const std::vector<double>& values) {
  Span span;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    span.low = std::min(span.low, value);
    span.high = std::max(span.high, value);
  }
  return span;
}

std::vector<double> Product(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> product(std::min(a.size(), b.size()));
  for (std::size_t i = 0; i < product.size(); ++i) product[i] = a[i] * b[i];
  return product;
}

// Aligns the zeros of both axes, unless this squeezes either axis into a third of the panel.
// Returns whether it did.
bool AlignZeros(Span* a, Span* b) {
  if (!(a->high > 0 && b->high > 0)) return a->high == b->high;
  const double below_a = -a->low / a->high;
  const double below_b = -b->low / b->high;
  const double ratio = std::max(below_a, below_b);
  if (1 + std::min(below_a, below_b) < (1 + ratio) / 3) return false;
  a->low = -ratio * a->high;
  b->low = -ratio * b->high;
  return true;
}

// An axis with a margin, which starts at zero if no value is below.
Axis AxisOf(const Span& span, const Prefix& prefix, const std::string& label, const char* colour) {
  const double air = span.high > span.low ? 0.06 * (span.high - span.low) : 1;
  return {label, (span.low < 0 ? span.low - air : 0.0) * prefix.factor,
          (span.high + air) * prefix.factor, colour};
}

std::string Title(const FitReport& report) {
  const std::string model = ModelTitle(report.model) + PlusEffects(EffectsOf(report.device));
  const RmsePair& rmse = report.polished ? report.rmse.refined : report.rmse.searched;
  return fmt::format("{}, {} model{}: RMSE {:.4g} A {}{}", report.curve.name, model,
                     report.interrupted ? ", interrupted" : "", rmse.Of(report.objective),
                     ToText(report.objective), report.polished ? "" : ", not polished");
}

Axis VoltageAxis(const IvCurve& curve) {
  const auto [low, high] = std::minmax_element(curve.voltage_V.begin(), curve.voltage_V.end());
  const double air = *high > *low ? 0.03 * (*high - *low) : 1;
  return {"Voltage (V)", *low - air, *high + air};
}

Series Over(const std::vector<double>& x, const std::vector<double>& y, double factor,
            Series series) {
  for (std::size_t i = 0; i < x.size() && i < y.size(); ++i) series.Add(x[i], y[i] * factor);
  return series;
}

// Current on the left axis, power on the right axis; the models are drawn above all points.
Panel CurvePanel(const FitReport& report) {
  const std::vector<double>& voltage_V = report.curve.voltage_V;
  const std::vector<double>& current_A = report.curve.current_A;
  const std::vector<double> power_W = Product(voltage_V, current_A);
  const auto [low, high] = std::minmax_element(voltage_V.begin(), voltage_V.end());
  std::vector<double> model_V(kModelPoints);
  for (int i = 0; i < kModelPoints; ++i) {
    model_V[i] = *low + (*high - *low) * i / (kModelPoints - 1);
  }
  const std::vector<double> model_A = SolveCurrents(report.device, report.refined.data(), model_V);

  Span current = SpanOf(current_A);
  Span power = SpanOf(power_W);
  const bool one_zero = AlignZeros(&current, &power);
  const Prefix ampere = PrefixFor(current.Largest());
  const Prefix watt = PrefixFor(power.Largest());
  Panel panel{"Measured points and model", VoltageAxis(report.curve),
              AxisOf(current, ampere, fmt::format("Current ({}A)", ampere.text), kBlue),
              AxisOf(power, watt, fmt::format("Power ({}W)", watt.text), kVermilion)};
  panel.rules = {{0, "black", 1, 0.8}};
  // If the zeros are not aligned, that of the power is drawn too.
  if (!one_zero) panel.rules.push_back({0, kVermilion, 3, 0.8, /*right_axis=*/true});
  // Many points have small and pale symbols, so that the model remains visible.
  const std::size_t count = voltage_V.size();
  const bool many = count > kManyPoints;
  const double size = many ? 0.4 : count > kSomePoints ? 0.8 : 1.3;
  const auto measured = [&](const char* colour, int symbol, bool right_axis) {
    return Series{SeriesKind::kPoints, {colour, 1, symbol}, 1.3, size, right_axis};
  };
  const auto model = [](const char* colour, int dash, bool right_axis) {
    return Series{SeriesKind::kLine, {colour, dash}, 2, 1, right_axis};
  };
  panel.series = {
      Over(voltage_V, current_A, ampere.factor, measured(many ? kSkyBlue : kBlue, 6, false)),
      Over(voltage_V, power_W, watt.factor, measured(many ? kOrange : kVermilion, 8, true)),
      Over(model_V, model_A, ampere.factor, model(kBlue, 1, false)),
      Over(model_V, Product(model_V, model_A), watt.factor, model(kVermilion, 2, true))};
  panel.height = 365;
  return panel;
}

// Solved-current residuals with a band of +- their RMSE, in amperes and in % of the model's current
// at short circuit.
Panel ResidualPanel(const FitReport& report) {
  const RmsePair& refined = report.polished ? report.rmse.refined : report.rmse.searched;
  const double rmse = std::isfinite(refined.solved_current_A) ? refined.solved_current_A : 0;
  const double largest = std::max(SpanOf(report.residual_A).Largest(), rmse);
  const double half = largest > 0 ? 1.15 * largest : 1;
  const Prefix prefix = PrefixFor(largest);
  const bool many = report.curve.size() > kManyPoints;
  Panel panel{fmt::format("Residuals, solved-current; band: ± RMSE, {:.3g} {}A",
                          rmse * prefix.factor, prefix.text),
              VoltageAxis(report.curve),
              {fmt::format("Model - measured ({}A)", prefix.text), -half * prefix.factor,
               half * prefix.factor}};
  const std::vector<double> at_V = {0};
  const double isc_A = SolveCurrents(report.device, report.refined.data(), at_V).front();
  const double percent = 100 * half / isc_A;
  if (isc_A > half) panel.right = Axis{"% of Isc", -percent, percent};
  panel.rules = {{0}};
  panel.bands = {{false, -rmse * prefix.factor, rmse * prefix.factor}};
  const auto residuals = [&](Series series) {
    return Over(report.curve.voltage_V, report.residual_A, prefix.factor, std::move(series));
  };
  panel.series = {residuals({SeriesKind::kStems, {many ? kSkyBlue : kBlue}, many ? 0.3 : 1.2}),
                  residuals({SeriesKind::kPoints, {kBlue, 1, 7}, 1, many ? 0.4 : 0.8})};
  panel.height = 197;
  return panel;
}

}  // namespace

Figure FitFigure(const FitReport& report) {
  Figure figure{Title(report),
                {{"I measured", {kBlue, 1, 6}, LegendMark::kPoint},
                 {"I model", {kBlue}, LegendMark::kLine},
                 {"P measured", {kVermilion, 1, 8}, LegendMark::kPoint},
                 {"P model", {kVermilion, 2}, LegendMark::kLine}}};
  figure.panels = {CurvePanel(report), ResidualPanel(report)};
  figure.panel_width = 684;
  return figure;
}

Expected<void> PlotFit(const FitReport& report, const std::string& path, PlotPoints points) {
  return DrawFigure(FitFigure(report), path, points);
}

namespace {

constexpr std::size_t kMostReadings = 500;  // rows of a table for reading

block::Table FitReadings(const FitReport& report) {
  const IvCurve& curve = report.curve;
  block::Table table = {
      "rrrrr",
      {{"voltage (V)", "measured (A)", "model (A)", "model - measured (A)", "measured (W)"}}};
  table.caption = "Readings, and the model's current at their voltages.";
  for (const std::size_t i : RowsShown(curve.voltage_V, curve.current_A, &table.caption)) {
    const double residual_A = i < report.residual_A.size() ? report.residual_A[i] : kUnknown;
    table.rows.push_back({Significant(curve.voltage_V[i], kReadingDigits),
                          Significant(curve.current_A[i], kReadingDigits),
                          Significant(curve.current_A[i] + residual_A, kReadingDigits),
                          Significant(residual_A, kResidualDigits),
                          Significant(curve.voltage_V[i] * curve.current_A[i], kReadingDigits)});
  }
  return table;
}

}  // namespace

std::vector<std::size_t> RowsShown(const std::vector<double>& voltage_V,
                                   const std::vector<double>& current_A, std::string* caption) {
  const std::size_t all = std::min(voltage_V.size(), current_A.size());
  std::vector<std::size_t> shown = MarksToDraw(voltage_V, current_A, kMostReadings);
  if (shown.size() < all) {
    *caption += fmt::format(" {} of {} readings; the others are in the data of the page.",
                            shown.size(), all);
  }
  return shown;
}

block::Figure FigureBlock(const FitReport& report) {
  block::Figure shown;
  if (report.curve.voltage_V.empty() || report.refined.empty()) return shown;
  shown.caption = fmt::format(
      "Measured current and power and the {} model over voltage; below, model minus measured "
      "current with a band of one solved-current RMSE either way. The largest error is {} A at {} "
      "V.",
      ModelTitle(report.model), Significant(report.residuals.largest_A, 3),
      Significant(report.residuals.largest_at_V, 4));
  shown.figure = FitFigure(report);
  shown.readings = FitReadings(report);
  return shown;
}

}  // namespace lyrefit

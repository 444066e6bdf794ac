#include "lyrefit/report/plot_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lyrefit/law/kernel.h"
#include "lyrefit/report/text_parts.h"
#include "lyrefit/report/thin_marks.h"

namespace lyrefit {
namespace {

constexpr int kModelPoints = 500;
constexpr std::size_t kManyPoints = 150;  // from here on small pale symbols

// Colours of Okabe and Ito, which the colour-blind tell apart too.
constexpr char kBlue[] = "#0072B2";
constexpr char kVermilion[] = "#D55E00";
constexpr char kSkyBlue[] = "#56B4E9";
constexpr char kOrange[] = "#E69F00";

// In gnuplot's single quotes; control characters become blanks.
std::string Quote(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') quoted += '\'';
    quoted += static_cast<unsigned char>(c) < 32 ? ' ' : c;
  }
  return quoted + "'";
}

// A prefix under which the largest number has its first digit around the point.
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

// Gives both axes their zero at one height, where neither is squeezed into a third of the panel.
// Whether it did.
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

std::string AxisRange(const Span& span, double factor) {
  const double air = span.high > span.low ? 0.06 * (span.high - span.low) : 1;
  return fmt::format("[{}:{}]", (span.low < 0 ? span.low - air : 0.0) * factor,
                     (span.high + air) * factor);
}

std::vector<double> At(const std::vector<std::size_t>& places, const std::vector<double>& values) {
  std::vector<double> some;
  for (const std::size_t place : places) {
    if (place < values.size()) some.push_back(values[place]);
  }
  return some;
}

void AppendBlock(const char* name, const std::vector<double>& x, const std::vector<double>& y,
                 std::string* script) {
  *script += fmt::format("${} << END_OF_DATA\n", name);
  for (std::size_t i = 0; i < x.size() && i < y.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) continue;
    fmt::format_to(std::back_inserter(*script), "{} {}\n", x[i], y[i]);
  }
  *script += "END_OF_DATA\n";
}

// Points, as many as can be told apart.
void AppendMarks(const char* name, const std::vector<double>& x, const std::vector<double>& y,
                 std::string* script) {
  const std::vector<std::size_t> places = MarksToDraw(x, y);
  AppendBlock(name, At(places, x), At(places, y), script);
}

std::string Title(const FitReport& report) {
  const std::string model = ModelTitle(report.model) + PlusEffects(EffectsOf(report.device));
  const RmsePair& rmse = report.polished ? report.rmse.refined : report.rmse.searched;
  return fmt::format("{}, {} model{}: RMSE {:.4g} A {}{}", report.curve.name, model,
                     report.interrupted ? ", interrupted" : "", rmse.Of(report.objective),
                     ToText(report.objective), report.polished ? "" : ", not polished");
}

std::string Preamble(const FitReport& report, const std::string& terminal, const Span& voltage) {
  const double air = voltage.high > voltage.low ? 0.03 * (voltage.high - voltage.low) : 1;
  const char* const settings =
      terminal == "svg"
          ? "svg size 900,760 noenhanced font 'DejaVu Sans,14' background '#ffffff'"
          : "pngcairo size 1350,1140 noenhanced font 'DejaVu Sans,13' fontscale 1.5 linewidth 1.5";
  return fmt::format(
      "set encoding utf8\n"
      "set terminal {}\n"
      "set multiplot title {} offset 0,-0.2\n"
      "set lmargin at screen 0.12\nset rmargin at screen 0.88\n"
      "set grid back lt 1 lw 0.7 lc rgb '#cccccc'\nset border lw 0.8\nset xrange [{}:{}]\n",
      settings, Quote(Title(report)), voltage.low - air, voltage.high + air);
}

// Current on the left axis, power on the right one.
std::string UpperPanel(const IvCurve& curve, double symbol_size) {
  Span current = SpanOf(curve.current_A);
  Span power = SpanOf(Product(curve.voltage_V, curve.current_A));
  // Where the power has a zero of its own it is drawn too.
  const char* const zero =
      AlignZeros(&current, &power)
          ? ""
          : " 0 axes x1y2 with lines lw 0.8 dt 3 lc rgb '#D55E00' notitle, \\\n";
  const bool many = curve.size() > kManyPoints;
  const Prefix ampere = PrefixFor(current.Largest());
  const Prefix watt = PrefixFor(power.Largest());
  return fmt::format(
      "set tmargin at screen 0.90\nset bmargin at screen 0.42\n"
      "set key at screen 0.5,0.925 center horizontal maxrows 1 samplen 2 font ',11'\n"
      "set yrange {}\nset y2range {}\n"
      "set ylabel 'Current ({}A)' textcolor rgb '{blue}'\n"
      "set y2label 'Power ({}W)' textcolor rgb '{red}'\n"
      "set ytics nomirror\nset y2tics\nset format x ''\n"
      "plot 0 with lines lw 0.8 lc rgb 'black' notitle, \\\n{zero}"
      " $measured using 1:($2*{f}) axes x1y1 with points pt 6 ps {size} lw 1.3 lc rgb '{i_colour}' "
      "title 'I measured', \\\n"
      " $model using 1:($2*{f}) axes x1y1 with lines lw 2 lc rgb '{blue}' title 'I model', \\\n"
      " $measured using 1:($1*$2*{p}) axes x1y2 with points pt 8 ps {size} lw 1.3 lc rgb "
      "'{p_colour}' "
      "title 'P measured', \\\n"
      " $model using 1:($1*$2*{p}) axes x1y2 with lines lw 2 dt 2 lc rgb '{red}' title 'P model'\n",
      AxisRange(current, ampere.factor), AxisRange(power, watt.factor), ampere.text, watt.text,
      fmt::arg("zero", zero), fmt::arg("blue", kBlue), fmt::arg("red", kVermilion),
      fmt::arg("f", ampere.factor), fmt::arg("p", watt.factor),
      fmt::arg("size", symbol_size * (many ? 0.4 : 1.3)),
      fmt::arg("i_colour", many ? kSkyBlue : kBlue),
      fmt::arg("p_colour", many ? kOrange : kVermilion));
}

// Solved-current residuals with a band of +- their RMSE.
std::string LowerPanel(const FitReport& report, double symbol_size) {
  const RmsePair& refined = report.polished ? report.rmse.refined : report.rmse.searched;
  const double rmse = std::isfinite(refined.solved_current_A) ? refined.solved_current_A : 0;
  const double largest = std::max(SpanOf(report.residual_A).Largest(), rmse);
  const double half = largest > 0 ? 1.15 * largest : 1;
  const Prefix prefix = PrefixFor(largest);
  const bool many = report.curve.size() > kManyPoints;
  return fmt::format(
      "set tmargin at screen 0.355\nset bmargin at screen 0.095\n"
      "set key at screen 0.5,0.38 center horizontal maxrows 1 samplen 2 font ',11'\n"
      "unset y2label\nunset y2tics\nset ytics mirror\nset format x '%g'\n"
      "set xlabel 'Voltage (V)'\nset ylabel 'Model - measured ({u}A)' textcolor rgb 'black'\n"
      "set yrange [{low}:{high}]\n"
      "set object 1 rectangle from graph 0, first -{band} to graph 1, first {band} "
      "fc rgb '{sky}' fs transparent solid 0.25 noborder behind\n"
      "plot 0 with lines lw 1 lc rgb 'black' notitle, \\\n"
      " $residual using 1:($2*{f}) with impulses lw {stem} lc rgb '{stem_colour}' notitle, \\\n"
      " $residual using 1:($2*{f}) with points pt 7 ps {size} lc rgb '{blue}' "
      "title 'residuals, solved-current', \\\n"
      " NaN with filledcurves fs transparent solid 0.25 fc rgb '{sky}' "
      "title '± RMSE, {shown:.3g} {u}A'\n",
      fmt::arg("u", prefix.text), fmt::arg("low", -half * prefix.factor),
      fmt::arg("high", half * prefix.factor), fmt::arg("band", rmse * prefix.factor),
      fmt::arg("sky", kSkyBlue), fmt::arg("blue", kBlue), fmt::arg("f", prefix.factor),
      fmt::arg("shown", rmse * prefix.factor), fmt::arg("size", symbol_size * (many ? 0.4 : 0.8)),
      fmt::arg("stem", many ? 0.3 : 1.2), fmt::arg("stem_colour", many ? kSkyBlue : kBlue));
}

}  // namespace

std::string PlotScript(const FitReport& report, const std::string& terminal) {
  const IvCurve& curve = report.curve;
  Span voltage{curve.voltage_V.front(), curve.voltage_V.front()};
  for (const double v : curve.voltage_V) {
    voltage = {std::min(voltage.low, v), std::max(voltage.high, v)};
  }
  std::vector<double> model_V(kModelPoints);
  for (int i = 0; i < kModelPoints; ++i) {
    model_V[i] = voltage.low + (voltage.high - voltage.low) * i / (kModelPoints - 1);
  }
  std::string script;
  AppendMarks("measured", curve.voltage_V, curve.current_A, &script);
  AppendBlock("model", model_V, SolveCurrents(report.device, report.refined.data(), model_V),
              &script);
  AppendMarks("residual", curve.voltage_V, report.residual_A, &script);
  const double symbol_size = terminal == "svg" ? 0.6 : 1;  // svg draws the same size larger
  return script + Preamble(report, terminal, voltage) + UpperPanel(curve, symbol_size) +
         LowerPanel(report, symbol_size) + "unset multiplot\n";
}

}  // namespace lyrefit

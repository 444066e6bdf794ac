#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/constants.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/devices/fit_two_junctions.h"
#include "lyrefit/model/two_junctions.h"
#include "lyrefit/report/fit_parts.h"
#include "lyrefit/report/json_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr int kJunctionSearchedDigits = 5;
constexpr int kJunctionRmseDigits = 7;

std::string ShareText(double share) {
  return std::isnan(share) ? "not stated" : fmt::format("{:.4g}", share);
}

Section TwoJunctionHead(const TwoJunctionReport& report) {
  Section head = {
      fmt::format("lyrefit {}: two junctions in series behind {}", report.version, report.name)};
  AddField("set",
           fmt::format("{}, {:.6g} C", Plural(report.curves.size(), "curve"),
                       report.temperature_K - kZeroCelsius_K),
           &head);
  AddField("junctions",
           report.interchangeable
               ? "the data do not tell top from bottom: junction 1 is the one with the lower "
                 "photocurrent, Iph2 = Iph1 (1 + x2)"
               : "1 is the top one, 2 the bottom one; Iph1 and Iph2 under the reference light",
           &head);
  AddField("objective",
           fmt::format("solved-current; constants {}; seed {}", ToText(report.constants),
                       report.search_options.seed),
           &head);
  return head;
}

Section TwoJunctionParameters(const TwoJunctionReport& report) {
  Section section = {"Parameters"};
  AddTable(EstimateTable(report.estimates,
                         {SearchedColumn(), RefinedColumn(), ErrorColumn(), IntervalColumn()}),
           &section);
  AddUnidentifiable(report.estimates, &section);
  if (!report.correlations.empty()) {
    AddSentence("Correlations above 0.9: " + CorrelationsText(report.correlations), &section);
  }
  return section;
}

// A stated light, and what it is found to be if it is uncertain.
std::string LightText(double share, double error) {
  return error == 0 ? ShareText(share)
                    : fmt::format("{} (found {:.4g})", ShareText(share), share * (1 + error));
}

Section CurveSection(const TwoJunctionReport& report) {
  block::Table table = {"lrrrrrrrr",
                        {{"curve", "light of 1", "light of 2", "limits", "Iph1 (A)", "Iph2 (A)",
                          "Voc (V)", "Pmp (W)", "RMSE (A)"}}};
  for (const TwoJunctionCurveReport& one : report.curves) {
    table.rows.push_back(
        {one.curve.name, LightText(one.light.top, one.light_error[0]),
         LightText(one.light.bottom, one.light_error[1]), std::to_string(one.limiting),
         Significant(one.parameters[JunctionPhotocurrent(0)], kJunctionSearchedDigits),
         Significant(one.parameters[JunctionPhotocurrent(1)], kJunctionSearchedDigits),
         Significant(one.simulated.open_circuit_voltage_V, kJunctionSearchedDigits),
         Significant(one.simulated.max_power_W, kJunctionSearchedDigits),
         Scientific(one.rmse_A, 3)});
  }
  return {"Curves (solved-current)", {table}};
}

// The test of the fit, and the errors of the lights.
Section TestSection(const TwoJunctionReport& report) {
  Section section = {"Test of the fit"};
  const auto say = [&](const char* label, const JunctionTest& test) {
    if (std::isnan(test.rmse_over_noise)) return;
    AddField(
        label,
        fmt::format("residuals {} times the noise of {} A that neighbouring readings show (p {})",
                    Significant(test.rmse_over_noise, 3), Significant(test.noise_A, 2),
                    test.p_value < 1e-4 ? "< 0.0001" : fmt::format("{:.2g}", test.p_value)),
        &section);
  };
  say(report.light_part > 0 ? "exact lights" : "test", report.test);
  if (!(report.light_part > 0)) {
    if (std::isnan(report.exact_lights_p)) return section;
    AddField("lights",
             fmt::format("taken as exact (p {:.2g} against errors of the stated ones); "
                         "--light-accuracy 2% allows for errors that do not show",
                         report.exact_lights_p),
             &section);
    return section;
  }
  say("with errors", report.test_of_rest);
  AddField(
      "lights",
      fmt::format("stated ones but 1:1 have an error of {:.2g} % each; the table of curves has "
                  "what they are found to be",
                  100 * report.light_part),
      &section);
  return section;
}

Section RmseSection(const TwoJunctionReport& report) {
  block::Table table = {"lr", {{"", "solved-current *"}}};
  table.rows = {{"searched (best candidate)",
                 Scientific(report.rmse.searched.solved_current_A, kJunctionRmseDigits)},
                {"refined (best of all starts)",
                 Scientific(report.rmse.refined.solved_current_A, kJunctionRmseDigits)}};
  return {"RMSE in A", {table}};
}

std::string TwoJunctionVerdict(const TwoJunctionReport& report) {
  std::string open;
  for (const Estimate& e : report.estimates) {
    if (!e.identifiable) open += (open.empty() ? "" : ", ") + e.info.symbol;
  }
  return fmt::format(
      "RMSE {} A (solved-current); {}", Scientific(report.rmse.refined.solved_current_A, 4),
      open.empty() ? "every parameter is identifiable" : "not identifiable: " + open);
}

}  // namespace

Document TwoJunctionDocument(const TwoJunctionReport& report) {
  Document document;
  document.banners = Banners(report.interrupted, report.usable, report.not_usable_because, {});
  document.verdict = TwoJunctionVerdict(report);
  document.head = TwoJunctionHead(report);
  AddFigure({"Measured points and model of each curve; residuals below them.", "",
             TwoJunctionFigure(report)},
            &document.head);
  AddSections({{"", {block::Conclusion{document.verdict}}},
               TwoJunctionParameters(report),
               TestSection(report),
               ListSection("What would decide", report.decided_by),
               RmseSection(report),
               WarningSection(report.warnings),
               Further(CurveSection(report)),
               Further(CourseSection(report))},
              &document);
  return document;
}

std::string TwoJunctionText(const TwoJunctionReport& report, Length length) {
  return DrawText(TwoJunctionDocument(report), length);
}

std::string BriefTwoJunctions(const TwoJunctionReport& report) {
  return fmt::format("{}: two junctions, {}{}\n", report.name, TwoJunctionVerdict(report),
                     BriefMarks(report.interrupted, report.usable, report.warnings.size(),
                                report.not_usable_because));
}

namespace {

constexpr int kJunctionModelPoints = 300;

Series ModelLine(const TwoJunctionReport& report, const TwoJunctionCurveReport& one,
                 const Look& look) {
  Series line{SeriesKind::kLine, look, 1.5};
  line.name = one.curve.name;
  const std::vector<double>& voltage = one.curve.voltage_V;
  const auto [low, high] = std::minmax_element(voltage.begin(), voltage.end());
  const double thermal_V = ThermalVoltage(report.temperature_K, report.constants);
  for (int k = 0; k < kJunctionModelPoints; ++k) {
    const double at = *low + (*high - *low) * k / (kJunctionModelPoints - 1);
    line.Add(at, TwoJunctionCurrent(thermal_V, one.parameters.data(), at));
  }
  return line;
}

}  // namespace

Figure TwoJunctionFigure(const TwoJunctionReport& report) {
  Figure figure;
  figure.title = fmt::format("{}, two junctions: RMSE {:.4g} A solved-current", report.name,
                             report.rmse.refined.solved_current_A);
  Panel curves{"Measured points and model", {"Voltage (V)"}, {"Current (A)"}};
  Panel residuals{"Residuals, solved-current", {"Voltage (V)"}, {"Model - measured (A)"}};
  curves.zero_line = residuals.zero_line = true;
  residuals.height = 200;
  std::vector<std::string> names;
  for (std::size_t c = 0; c < report.curves.size(); ++c) {
    const TwoJunctionCurveReport& one = report.curves[c];
    const Look look = LookOf(static_cast<int>(c));
    names.push_back(one.curve.name);
    Series points{SeriesKind::kPoints, look, 1, 0.7};
    Series misfit{SeriesKind::kLineAndPoints, look, 0.7, 0.5};
    points.name = misfit.name = one.curve.name;
    for (std::size_t k = 0; k < one.curve.size(); ++k) {
      points.Add(one.curve.voltage_V[k], one.curve.current_A[k]);
      misfit.Add(one.curve.voltage_V[k], one.model_A[k] - one.curve.current_A[k]);
    }
    curves.series.push_back(std::move(points));
    curves.series.push_back(ModelLine(report, one, look));
    residuals.series.push_back(std::move(misfit));
  }
  figure.legend = LegendOf(names, LegendMark::kLineAndPoint);
  figure.panels = {std::move(curves), std::move(residuals)};
  figure.panel_width = 684;
  return figure;
}

Expected<void> PlotTwoJunctions(const TwoJunctionReport& report, const std::string& path,
                                PlotPoints points) {
  return DrawFigure(TwoJunctionFigure(report), path, points);
}

void to_json(Json& j, const StatedLight& light) {
  j = {{"top", light.top}, {"bottom", light.bottom}};
}

LYREFIT_JSON_FIELDS(JunctionTest, noise_A, rmse_over_noise, p_value)

LYREFIT_JSON_FIELDS(ExchangedLights, first, second, rmse_A)

void to_json(Json& j, const TwoJunctionCurveReport& one) {
  Json parameters = Json::object();
  const std::vector<ParameterInfo> infos = TwoJunctionInfos();
  for (std::size_t i = 0; i < infos.size(); ++i) parameters[infos[i].name] = one.parameters[i];
  std::vector<double> residual_A(one.model_A.size());
  std::transform(one.model_A.begin(), one.model_A.end(), one.curve.current_A.begin(),
                 residual_A.begin(),
                 [](double model, double measured) { return model - measured; });
  j = {{"id", one.curve.name},
       {"curve", one.curve},
       {"light", one.light},
       {"light_error", {{"top", one.light_error[0]}, {"bottom", one.light_error[1]}}},
       {"limiting", one.limiting},
       {"parameters", parameters},
       {"rmse", RmsePair{kUnknown, one.rmse_A}},
       {"key_points", {{"measured", one.measured}, {"simulated", one.simulated}}},
       {"data",
        {{"voltage_V", one.curve.voltage_V},
         {"current_A", one.curve.current_A},
         {"model_current_A", one.model_A},
         {"residual_A", residual_A}}}};
}

std::string TwoJunctionJson(const TwoJunctionReport& report) {
  Json parameters = Json::object();
  for (const Estimate& e : report.estimates) parameters[ParameterKey(e.info)] = e;
  Json j = {{"lyrefit_version", report.version},
            {"name", report.name},
            {"junctions", 2},
            {"objective", ToText(Objective::kSolvedCurrent)},
            {"constants", report.constants},
            {"cell_temperature_C", RoundCelsius(report.temperature_K - kZeroCelsius_K)},
            {"interchangeable", report.interchangeable},
            {"parameters", parameters},
            {"decided_by", report.decided_by},
            {"test", report.test},
            {"test_of_rest", report.test_of_rest},
            {"exact_lights_p", report.exact_lights_p},
            {"light_part", report.light_part},
            {"exchanged", report.exchanged},
            {"rmse", {{"searched", report.rmse.searched}, {"refined", report.rmse.refined}}},
            {"curves", report.curves}};
  j.update(CourseJson(report));
  j.update(Json({{"options", report.non_default_options},
                 {"usable", report.usable},
                 {"not_usable_because", report.not_usable_because},
                 {"interrupted", report.interrupted},
                 {"warnings", report.warnings}}));
  return Dump(j);
}

}  // namespace lyrefit

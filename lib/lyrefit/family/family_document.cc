#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/family/family_documents.h"
#include "lyrefit/family/family_parts.h"
#include "lyrefit/report/fit_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

// How well a fit of key points gives the power of the conditions.
std::string KeyPointWords(const KeyPointSummary& found) {
  const auto percent = [](double part) { return Significant(100 * part, 2); };
  std::string words = fmt::format(": Pmp within {} % of nominal power (rms)",
                                  percent(found.max_power_of_reference));
  if (found.held_out > 0) {
    words += fmt::format(", {} % where a condition is held out",
                         percent(found.held_out_max_power_of_reference));
  }
  return words;
}

}  // namespace

std::string FamilyVerdict(const FamilyReport& report) {
  if (!report.usable) return "Not to be used: the fit came to no device that could be one.";
  const TranslationSpec& spec = report.translation.spec;
  const double rmse_A = report.rmse.refined.solved_current_A;
  std::size_t outliers = 0;
  for (const FamilyCurve& curve : report.curves) outliers += curve.outlier ? 1 : 0;
  std::string text =
      OneByOne(report)
          ? fmt::format("Every curve has a {} model of its own", ModelTitle(spec.model))
          : fmt::format("One {} device by the law of {} explains the {}", ModelTitle(spec.model),
                        LawTitle(spec.law), report.key_points ? "key points" : "curves");
  text += report.key_points
              ? KeyPointWords(*report.key_points)
              : fmt::format(": solved-current RMSE {} A{}", Scientific(rmse_A, 3),
                            PartOfIsc(rmse_A, report.reference.short_circuit_current_A));
  if (outliers > 0) {
    text += report.key_points
                ? fmt::format("; a value of {} looks wrong", Plural(outliers, "condition"))
                : fmt::format("; {} look{} like another device", Plural(outliers, "curve"),
                              outliers == 1 ? "s" : "");
  }
  return FullSentence(text);
}

namespace {

constexpr int kFamilyValueDigits = 6;
constexpr int kFamilyRmseDigits = 7;

std::size_t Count(const FamilyReport& report, CurveRole role) {
  return static_cast<std::size_t>(
      std::count_if(report.curves.begin(), report.curves.end(),
                    [role](const FamilyCurve& curve) { return curve.role == role; }));
}

// "50 fitted, 3 held out, 1 left out, 2 rejected"
std::string Counts(const FamilyReport& report) {
  return fmt::format("{} fitted, {} held out, {} left out, {} rejected",
                     Count(report, CurveRole::kFitted), Count(report, CurveRole::kHeldOut),
                     Count(report, CurveRole::kLeftOut), report.rejected.size());
}

// "irradiance 98 to 1006 W/m2, cell temperature 15 to 65 C"
std::string RangeText(const FamilyReport& report) {
  if (report.curves.empty()) return "";
  const auto by_irradiance = [](const FamilyCurve& a, const FamilyCurve& b) {
    return a.irradiance_W_m2 < b.irradiance_W_m2;
  };
  const auto by_temperature = [](const FamilyCurve& a, const FamilyCurve& b) {
    return a.temperature_C < b.temperature_C;
  };
  const auto [dim, bright] =
      std::minmax_element(report.curves.begin(), report.curves.end(), by_irradiance);
  const auto [cold, hot] =
      std::minmax_element(report.curves.begin(), report.curves.end(), by_temperature);
  return fmt::format("irradiance {:.5g} to {:.5g} W/m2, cell temperature {:.4g} to {:.4g} C",
                     dim->irradiance_W_m2, bright->irradiance_W_m2, cold->temperature_C,
                     hot->temperature_C);
}

std::string LawText(const FamilyReport& report) {
  const TranslationSpec& spec = report.translation.spec;
  return fmt::format("{}, shunt {}{}", ToText(spec.law), ToText(spec.shunt),
                     spec.recombination ? ", recombination in the i-layer" : "");
}

Section FamilyHead(const FamilyReport& report) {
  const TranslationSpec& spec = report.translation.spec;
  const std::string model = ModelTitle(spec.model);
  Section head;
  head.heading = fmt::format("lyrefit {}: ", report.version) +
                 (OneByOne(report)
                      ? fmt::format("{} model of every curve of {} on its own", model, report.name)
                      : fmt::format("one {} device by the law of {} behind the curves of {}", model,
                                    LawTitle(spec.law), report.name));
  AddField("set",
           fmt::format("{}, {}{}", report.name, Plural(report.curves.size(), "curve"),
                       report.source.empty() ? "" : " (" + report.source + ")"),
           &head);
  AddField("curves", Counts(report), &head);
  AddField(
      "conditions",
      fmt::format("{}; {} in series", RangeText(report), Plural(report.cells_in_series, "cell")),
      &head);
  if (!OneByOne(report)) AddField("law", LawText(report), &head);
  if (!report.with.empty()) AddField("effects", EffectTitles(report.with), &head);
  const std::string objective =
      report.key_points
          ? fmt::format("key points (Isc, Voc, Vmp, Pmp); search: {}", ToText(report.objective))
          : ToText(report.objective);
  AddFurtherField("objective",
                  fmt::format("{}; constants {}; seed {}", objective, ToText(spec.constants),
                              report.search_options.seed),
                  &head);
  return head;
}

Section CandidateSection(const FamilyReport& report) {
  Section section = {"Choice of the law"};
  if (report.candidates.empty()) return section;
  block::Table table = {"llrrrrrr",
                        {{"", "", "RMSE (A)", "RMSE (A)", "held out", "median", "behind", ""},
                         {"law", "model", "measured-current", "solved-current", "solved-current",
                          "solved-current", "best (SE)", "free"}}};
  for (const FamilyCandidate& c : report.candidates) {
    table.rows.push_back({ToText(c.law), ToText(c.model) + (c.chosen ? " <-" : ""),
                          Scientific(c.rmse.measured_current_A, 4),
                          Scientific(c.rmse.solved_current_A, 4), Scientific(c.held_out_rmse_A, 4),
                          Scientific(c.held_out_median_A, 4),
                          std::isnan(c.behind_best) ? "-" : fmt::format("{:.1f}", c.behind_best),
                          std::to_string(c.free_parameters)});
  }
  AddTable(std::move(table), &section);
  AddSentence(
      "Held out: on whole curves that the fit did not see. Behind: the mean square beyond that of "
      "the best, in standard errors of the difference from curve to curve. Chosen is the law with "
      "the fewest free parameters that is less than one behind.",
      &section);
  return section;
}

bool Known(const Interval& interval) { return !std::isnan(interval.value); }

// "-0.31 K, 95 % -0.35 .. -0.27"
std::string WithRange(const Interval& interval, const std::string& unit) {
  std::string text = Significant(interval.value, 4) + " " + unit;
  if (!std::isnan(interval.low_95)) {
    text += fmt::format(", 95 % {}", Range(interval.low_95, interval.high_95));
  }
  return text;
}

std::string Percent(double part) { return Significant(100 * part, 2) + " %"; }

// Weights of the curves, and the reason for them.
std::string WeightsText(const FamilyReport& report) {
  const bool relative = report.weights == FamilyWeights::kIsc;
  std::string used = relative ? "relative to the Isc of each curve" : "every point alike";
  if (!report.weights_gain) return used;
  if (std::isnan(*report.weights_gain)) return used + ": the residuals are more than noise";
  return fmt::format("{}: the residuals speak for errors {} (2 ln likelihood {:+.1f})", used,
                     relative ? "in proportion to Isc" : "of one size over all curves",
                     std::fabs(*report.weights_gain));
}

// The sizes and correlations of the errors, and the curves that they are based on.
std::string FamilyErrorText(const FamilyErrors& errors) {
  const std::string by =
      errors.judge == FamilyErrorJudge::kHeldOut
          ? fmt::format("{} that were not fitted say", Plural(errors.tested_curves, "curve"))
      : errors.judge == FamilyErrorJudge::kHalves
          ? fmt::format("{}, each half under the errors of the other half, say",
                        Plural(errors.tested_curves, "curve"))
          : "the fitted curves say";
  if (errors.kind == FamilyErrorKind::kIndependent) {
    return fmt::format("Errors of the readings: {} that they are independent of each other.", by);
  }
  const FamilyErrorSizes& sizes = errors.sizes;
  std::string shared = fmt::format(
      "a path of {} of Isc along the brightest curve (light that wanders, or what the model "
      "misses; {} light)",
      Percent(sizes.readings.path),
      errors.path_power == 1     ? "in proportion to"
      : errors.path_power == 0.5 ? "growing with the root of the"
                                 : "of one size at every");
  if (errors.kind == FamilyErrorKind::kCurves) {
    shared += fmt::format(", the stated light of a curve wrong by {}, its temperature by {} K",
                          Percent(sizes.irradiance), Significant(sizes.temperature_K, 2));
  }
  return fmt::format(
      "Errors of the readings: {} A of a current, {} V of a voltage at Voc, and beside these {}; "
      "{} so. Believe intervals of points with these errors, or of whole curves, not those of "
      "independent points.",
      Significant(sizes.readings.current_A, 2), Significant(sizes.readings.voltage_V, 2), shared,
      by);
}

// Adds intervals of the shared parameters by other methods than independent points.
void AddOtherIntervals(const FamilyReport& report, Section* section) {
  const std::size_t count = report.estimates.size();
  const bool jackknife = report.jackknife.size() == count;
  const bool under = report.under_errors.size() == count;
  if (!jackknife && !under) return;
  const auto row = [&](const std::string& label, const std::string& points,
                       const std::string& with_errors, const std::string& curves) {
    std::vector<std::string> cells = {label, points};
    if (under) cells.push_back(with_errors);
    if (jackknife) cells.push_back(curves);
    return cells;
  };
  const auto range = [](const std::vector<Interval>& intervals, std::size_t i) {
    return i < intervals.size() ? Range(intervals[i].low_95, intervals[i].high_95) : "";
  };
  block::Table table = {under && jackknife ? "llll" : "lll",
                        {row("", "points", "points with errors", "whole curves")}};
  for (std::size_t i = 0; i < count; ++i) {
    const Estimate& e = report.estimates[i];
    if (e.fixed) continue;
    table.rows.push_back(row(LabelWithUnit(e.info), Range(e.low_95, e.high_95),
                             range(report.under_errors, i), range(report.jackknife, i)));
  }
  AddSentence(std::string("95 % intervals, with independent points") +
                  (under ? ", points with the errors below" : "") +
                  (jackknife ? " and whole curves (each left out in turn)" : "") +
                  " as what varies:",
              section);
  AddTable(std::move(table), section);
}

Section SharedSection(const FamilyReport& report) {
  Section section = {"Shared parameters at 1000 W/m2 and 25 C"};
  if (OneByOne(report)) return section;
  const EstimateColumn name = {"name", 'l', [](const Estimate& e) { return e.info.name; }};
  AddTable(EstimateTable(report.estimates, {name, SearchedColumn(),
                                            RefinedColumn(kFamilyValueDigits), IntervalColumn()}),
           &section);
  AddUnidentifiable(report.estimates, &section);
  return section;
}

Section IntervalSection(const FamilyReport& report) {
  Section section = {"Intervals"};
  if (OneByOne(report)) return section;
  AddOtherIntervals(report, &section);
  if (report.errors) AddSentence(FamilyErrorText(*report.errors), &section);
  const std::string correlations = CorrelationsText(report.correlations);
  if (!correlations.empty()) AddField("correlations", correlations + " (above 0.9)", &section);
  return section;
}

Section SensorSection(const FamilyReport& report) {
  const Interval& irradiance = report.irradiance_offset_W_m2;
  const Interval& temperature = report.temperature_offset_K;
  Section section = {"Error of the sensors, common to all curves (true = reading + offset)"};
  if (Known(irradiance)) AddField("irradiance", WithRange(irradiance, "W/m2"), &section);
  if (Known(temperature)) AddField("temperature", WithRange(temperature, "K"), &section);
  return section;
}

Section ReferenceSection(const FamilyReport& report) {
  Section section = {"The model at 1000 W/m2 and 25 C"};
  if (OneByOne(report)) return section;
  const KeyPoints& k = report.reference;
  AddField(
      "key points",
      fmt::format("Isc {} A, Voc {} V, Imp {} A, Vmp {} V, Pmp {} W, fill factor {}",
                  Significant(k.short_circuit_current_A, kFamilyValueDigits),
                  Significant(k.open_circuit_voltage_V, kFamilyValueDigits),
                  Significant(k.max_power_current_A, kFamilyValueDigits),
                  Significant(k.max_power_voltage_V, kFamilyValueDigits),
                  Significant(k.max_power_W, kFamilyValueDigits), Significant(k.fill_factor, 4)),
      &section);
  if (!report.with.empty()) {
    AddSentence("Temperature coefficients, without the effects:", &section);
  }
  for (const Coefficient& c : report.coefficients) {
    AddField(c.name, WithRange(c.value, c.unit), &section);
  }
  return section;
}

Section FamilyRmseSection(const FamilyReport& report) {
  const bool key_points = report.key_points.has_value();
  Section section = {key_points ? "RMSE in A of the readings that key points give (not fitted)"
                                : "RMSE in A   (* the objective that was fitted)"};
  if (OneByOne(report)) return section;
  const auto label = [&](Objective objective) {
    return ToText(objective) + (objective == report.objective && !key_points ? " *" : "");
  };
  block::Table table = {
      "lrrl", {{"", label(Objective::kMeasuredCurrent), label(Objective::kSolvedCurrent), "over"}}};
  const auto add = [&](const char* name, const RmsePair& rmse, const std::string& over) {
    table.rows.push_back({name, Scientific(rmse.measured_current_A, kFamilyRmseDigits),
                          Scientific(rmse.solved_current_A, kFamilyRmseDigits), over});
  };
  const std::string seen =
      fmt::format("the {} of the search", Plural(report.search_ids.size(), "curve"));
  const std::string all =
      fmt::format("all {} fitted", Plural(Count(report, CurveRole::kFitted), "curve"));
  add("random points, as many", report.rmse.random_baseline, seen);
  add("searched (best candidate)", report.rmse.searched, seen);
  add("searched (best candidate)", report.searched_all, all);
  add("refined", report.rmse.refined, all);
  AddTable(std::move(table), &section);
  if (!std::isnan(report.noise_A) && !key_points) {
    AddFurtherField("noise", Significant(report.noise_A, 4) + " A, residual standard deviation",
                    &section);
    AddFurtherField("weights", WeightsText(report), &section);
  }
  return section;
}

Section FamilySearchSection(const FamilyReport& report) {
  std::vector<std::pair<std::string, std::string>> times;
  if (report.individual_seconds > 0) {
    times.emplace_back("one by one", Duration(report.individual_seconds));
  }
  times.emplace_back("time", Duration(report.seconds));
  if (!OneByOne(report)) return CourseSection(report, times);
  Section section = {"How it was found"};
  for (const auto& [name, text] : times) AddField(name, text, &section);
  AddField("options", OptionsText(report.non_default_options), &section);
  return section;
}

}  // namespace

Document FamilyDocument(const FamilyReport& report, const CurveSet& set) {
  Document document = FamilyDocument(report);
  AddFigure(FigureBlock(report, set), &document.head);
  return document;
}

Document FamilyDocument(const FamilyReport& report) {
  Document document = {Banners(report.interrupted, report.usable, {}, report.doubts),
                       FamilyHead(report)};
  document.verdict = FamilyVerdict(report);
  AddSections({{"", {block::Conclusion{document.verdict}}},
               CandidateSection(report),
               SharedSection(report),
               SensorSection(report),
               ReferenceSection(report)},
              &document);
  AddSections(KeyPointSections(report), &document);
  AddSections({FamilyRmseSection(report), Further(IntervalSection(report))}, &document);
  AddSections(FamilyCurveSections(report), &document);
  AddSections(
      {Further(FamilySearchSection(report)),
       Further(ListSection("Assumptions", report.assumptions)), WarningSection(report.warnings)},
      &document);
  return document;
}

std::string FamilyText(const FamilyReport& report, Length length) {
  return DrawText(FamilyDocument(report), length);
}

std::string BriefFamily(const FamilyReport& report) {
  const TranslationSpec& spec = report.translation.spec;
  const RmsePair& rmse = report.rmse.refined;
  std::string text =
      fmt::format("{}: {} {}, {}, RMSE {} A measured-current, {} A solved-current (fitted: {})",
                  report.name, OneByOne(report) ? "free" : ToText(spec.law), ToText(spec.model),
                  Counts(report), Scientific(rmse.measured_current_A, 6),
                  Scientific(rmse.solved_current_A, 6), ToText(report.objective));
  for (const Estimate& e : report.estimates) {
    text += fmt::format(", {} {}{}{}", e.info.symbol, Significant(e.refined, 6),
                        e.info.unit.empty() ? "" : " ", e.info.unit);
  }
  text += BriefMarks(report.interrupted, report.usable, report.warnings.size());
  return text + "\n";
}

}  // namespace lyrefit

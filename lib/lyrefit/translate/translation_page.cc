#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/report/figure_parts.h"
#include "lyrefit/report/fit_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"
#include "lyrefit/translate/field_inputs.h"
#include "lyrefit/translate/key_point_noise.h"
#include "lyrefit/translate/translation_documents.h"
#include "lyrefit/translate/translation_parts.h"
#include "lyrefit/translate/translation_report.h"

namespace lyrefit {
namespace {

constexpr int kReadingDigits = 6;
constexpr std::size_t kMostReadings = 500;  // rows of a table for reading

const char* Words(TemperatureSource source) {
  switch (source) {
    case TemperatureSource::kBackOfModule:
      return "by a sensor on the back";
    case TemperatureSource::kVoc:
      return "from Voc (IEC 60904-5)";
    case TemperatureSource::kLaboratory:
      return "in equilibrium, in a laboratory";
    case TemperatureSource::kNotStated:
      break;
  }
  return "nobody stated by what";
}

std::string LightText(const TranslationReport& report) {
  const IvCurve& curve = report.curve;
  const std::string value = Significant(curve.conditions.irradiance_W_m2, 4) + " W/m2";
  if (!curve.irradiance_known) return value + " assumed: nobody stated it";
  return fmt::format("{} {}; {:.2g} % (k = 2)", value,
                     LightClassOf(report.uncertainty.light_source).by,
                     IrradianceSize_percent(report.uncertainty));
}

std::string TemperatureText(const TranslationReport& report) {
  const IvCurve& curve = report.curve;
  const std::string value = fmt::format("{:.1f} C", report.read_temperature_C);
  if (!curve.temperature_known) return value + " assumed: nobody stated it";
  const double offset_K = CellOffsetSize_K(report.uncertainty, curve.conditions.irradiance_W_m2);
  std::string text =
      fmt::format("{} {}; {:.2g} K (k = 2)", value, Words(report.uncertainty.temperature_source),
                  TemperatureSize_K(report.uncertainty));
  const double warmer_K = report.inputs.cell_correction_K;
  if (warmer_K != 0) {
    text += fmt::format("; cells {:+.2f} K ({:.2g} K, k = 2): {:.1f} C used", warmer_K, offset_K,
                        report.inputs.values.temperature_C);
  } else if (offset_K > 0) {
    text += fmt::format(", {:.2g} K more as cells are warmer", offset_K);
  }
  return text;
}

std::string InstrumentText(const FieldNotes& notes) {
  std::string text = notes.tracer;
  const auto add = [&text](const char* what, const std::string& value) {
    if (!value.empty()) text += (text.empty() ? "" : ", ") + (what + value);
  };
  add("serial ", notes.serial);
  add("calibration: ", notes.calibration);
  return text.empty() ? "not stated; calibration not stated" : text;
}

std::string Watts(double value) { return fmt::format("{:.0f} W", value); }

// A line such as "Fail: 4650 W at standard conditions ..."
std::string PowerLine(const TranslationReport& report) {
  const FieldTest& test = *report.field_test;
  std::string zone = ToText(test.zone);
  zone.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(zone.front())));
  if (test.zone == Zone::kDoubtful) return FullSentence(zone + ": " + test.doubt);
  return fmt::format(
      "{}: {} at 1000 W/m2 and 25 C ({:.0f} .. {}, k = 2), allowed are {} or more ({} rated, {}). "
      "The probability of conformity is {}.",
      zone, Watts(test.standard_W), test.standard_low_W, Watts(test.standard_high_W),
      Watts(test.lowest_W), Watts(test.rated_W), test.tolerance, ConformityText(test));
}

block::Table CurveTable(const TranslationReport& report, const TranslatedResult& best) {
  block::Table table = {"rrrr",
                        {{"measured (V)", "measured (A)", "translated (V)", "translated (A)"}}};
  table.caption = "Readings, and the curve by " + best.title + ".";
  const auto shown = MarksToDraw(report.curve.voltage_V, report.curve.current_A, kMostReadings);
  const auto there = MarksToDraw(best.curve.voltage_V, best.curve.current_A, kMostReadings);
  table.rows.resize(std::max(shown.size(), there.size()));
  const auto fill = [&table](const std::vector<std::size_t>& places, std::size_t column,
                             const std::vector<double>& voltage_V,
                             const std::vector<double>& current_A) {
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      const bool has = r < places.size();
      table.rows[r].resize(4);
      table.rows[r][column] = has ? Significant(voltage_V[places[r]], kReadingDigits) : "";
      table.rows[r][column + 1] = has ? Significant(current_A[places[r]], kReadingDigits) : "";
    }
  };
  fill(shown, 0, report.curve.voltage_V, report.curve.current_A);
  fill(there, 2, best.curve.voltage_V, best.curve.current_A);
  return table;
}

}  // namespace

void AddMeasurement(const TranslationReport& report, Section* section) {
  AddCurve(report.curve, section);
  const FieldNotes& notes = report.notes;
  const std::string& date = report.curve.notes.date;
  AddFurtherField("taken", date.empty() ? "time not stated" : date, section);
  AddField("irradiance", LightText(report), section);
  AddField("temperature", TemperatureText(report), section);
  AddFurtherField("instrument", InstrumentText(notes), section);
  if (!notes.operated_by.empty()) AddFurtherField("measured by", notes.operated_by, section);
  if (!notes.remark.empty()) AddFurtherField("remark", notes.remark, section);
}

std::string TranslationVerdict(const TranslationReport& report) {
  const TranslatedResult* best = report.Recommended();
  if (best == nullptr) return FullSentence(report.reason);
  std::string text;
  if (report.field_test) {
    const FieldTest& test = *report.field_test;
    text = PowerLine(report) + "\n";
    if (std::isfinite(test.performance_factor)) {
      text += fmt::format(
          "Performance factor {:.3f} ({:.3f} .. {:.3f}, k = 2): {} measured, {} expected at {:.0f} "
          "W/m2 and {:.1f} C.\n",
          test.performance_factor, test.performance_low, test.performance_high,
          Watts(test.measured_W), Watts(test.predicted_W), report.inputs.values.irradiance_W_m2,
          report.inputs.values.temperature_C);
    }
  } else if (best->budget.outputs.size() > kMaxPowerOutput) {
    const UncertainOutput& power = best->budget.outputs[kMaxPowerOutput];
    text = fmt::format("Pmax {} W at {:g} W/m2 and {:g} C ({} W, k = 2).\n",
                       Significant(power.value, 4), report.target.irradiance_W_m2,
                       report.target.temperature_C, Range(power.low(), power.high()));
  }
  if (!report.diagnosis) return text;
  const Verdict& found = report.diagnosis->verdict;
  const bool fails = report.field_test && IsFail(report.field_test->zone);
  const bool silent = report.diagnosis->device_findings.empty();
  if (fails && !found.found && !found.unexplained && silent) {
    text +=
        "Cause: the shape of the curve shows none. What acts on all cells alike leaves no trace in "
        "it: dirt, a wrong sensor of light or temperature, missing modules, a lower class.\n"
        "To be sure: compare Isc and Voc with those of the neighbours, clean the light sensor and "
        "check its tilt, count the modules, clean one of them and measure again.\n";
    return text;
  }
  text += found.found || found.unexplained || !silent ? FullSentence("Cause: " + found.sentence)
                                                      : std::string("Cause: none seen.");
  if (found.found && !found.causes.front().in_words.empty()) {
    std::string size = found.causes.front().in_words.front();
    text += " " + FullSentence(size);
  }
  text += "\n";
  if (!found.causes.empty() && !found.causes.front().separate_by.empty()) {
    text += FullSentence("To be sure: " + found.causes.front().separate_by.front()) + "\n";
  }
  return text;
}

block::Figure FigureBlock(const TranslationReport& report) {
  block::Figure shown;
  const TranslatedResult* best = report.Recommended();
  if (best == nullptr) return shown;
  shown.caption = fmt::format(
      "Readings at {:.0f} W/m2 and {:.1f} C, and what the procedures make of them at {:g} W/m2 and "
      "{:g} C, the recommended one ({}) thick; black, the points of maximum power.",
      report.inputs.values.irradiance_W_m2, report.inputs.values.temperature_C,
      report.target.irradiance_W_m2, report.target.temperature_C, best->title);
  if (report.diagnosis && report.diagnosis->verdict.found) {
    shown.caption += " Marked is where the cause acts on the readings.";
  }
  shown.figure = TranslationFigure(report);
  shown.readings = CurveTable(report, *best);
  return shown;
}

}  // namespace lyrefit

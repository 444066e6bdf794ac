#include "look.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/read_cell.h"
#include "lyrefit/read/read_curve_set.h"
#include "lyrefit/read/read_module.h"
#include "lyrefit/report/figure.h"
#include "lyrefit/translate/translate_options.h"

namespace lyrefit {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMostCurves = 30;
constexpr std::size_t kFewPoints = 400;  // of a curve whose points are marked
constexpr std::size_t kFewCurves = 6;    // of a picture with a legend

ordered_json CurveJson(const IvCurve& curve) {
  const auto known = [](bool is, double value) {
    return is ? ordered_json(value) : ordered_json();
  };
  ordered_json json;
  json["name"] = curve.name;
  json["readings"] = curve.size();
  json["cells"] = known(curve.cells_known, curve.conditions.cells_in_series);
  json["temperature_C"] =
      known(curve.temperature_known, curve.conditions.cell_temperature_K - kZeroCelsius_K);
  json["irradiance_Wm2"] = known(curve.irradiance_known, curve.conditions.irradiance_W_m2);
  return json;
}

// A page with a picture of the readings and nothing else.
std::string PicturePage(const std::vector<IvCurve>& curves) {
  Panel panel = {"", {"Voltage (V)"}, {"Current (A)"}};
  block::Figure shown;
  std::size_t readings = 0;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const IvCurve& curve = curves[c];
    const bool few = curve.size() <= kFewPoints;
    Series series = {few ? SeriesKind::kLineAndPoints : SeriesKind::kLine,
                     LookOf(static_cast<int>(c)), 1, 0.6};
    series.name = curve.name;
    for (std::size_t i = 0; i < curve.size(); ++i) {
      series.Add(curve.voltage_V[i], curve.current_A[i]);
    }
    readings += curve.size();
    const bool named = curves.size() > 1 && curves.size() <= kFewCurves;
    if (named) shown.figure.legend.push_back({curve.name, series.look, LegendMark::kLine});
    panel.series.push_back(std::move(series));
  }
  panel.zero_line = true;
  panel.height = 250;
  shown.figure.title = "Readings";
  shown.figure.panels = {std::move(panel)};
  shown.caption = fmt::format("{} readings of {} curve{}.", readings, curves.size(),
                              curves.size() == 1 ? "" : "s");
  Document document;
  document.head.heading = "Readings";
  AddFigure(std::move(shown), &document.head);
  return DrawPage(document, "", InPage());
}

ordered_json ColumnsJson(const std::string& file, const ReadOptions& reading) {
  ordered_json json = ordered_json::array();
  const auto columns = ListColumns(file, reading);
  if (!columns) return json;  // not a table: the reader gives the error
  for (const ColumnNote& column : *columns) {
    json.push_back({{"place", column.place}, {"name", column.name}, {"use", column.use}});
  }
  return json;
}

// A file that is read only beside the others of its cell: the Suns-Voc trace in suns.
Expected<CurveSet> ReadBeside(const PageRequest& request, const ReadingForm& form) {
  std::vector<std::string> files;
  for (const std::string& file : request.files) {
    if (file != request.file && ReadMeasurement(file, form.reading)) files.push_back(file);
  }
  if (files.empty()) return Fail("no file of the same cell");
  TRY(const CurveSet others, ReadCell(files, form.reading));
  files.push_back(request.file);
  TRY(CurveSet set, ReadCell(files, form.reading));
  const auto own = set.curves.begin() + static_cast<std::ptrdiff_t>(others.curves.size());
  set.curves.erase(set.curves.begin(), own);
  TRY(ApplyStated(form, request.file, &set));
  return set;
}

// What the sheet of a module says; null for any other file.
ordered_json ModuleJson(const std::string& file) {
  TranslateOptions options;
  const bool module = ReadModule(file, &options).has_value();
  const Expected<ModuleSheet> sheet = ReadModuleSheet(file);
  const bool holds = HoldsModule(file).value_or(false);
  if (!module && !holds) return nullptr;
  ordered_json json = {{"module", module}, {"sheet", sheet.has_value()}};
  json["assumptions"] = ordered_json::array();
  for (const OptionEcho& said : NonDefaults(options, kTranslateOptionTable)) {
    json["assumptions"].push_back(said.name + ": " + said.value);
  }
  if (options.layout.modules_in_series) {
    json["assumptions"].push_back(fmt::format("modules: {}", *options.layout.modules_in_series));
  }
  if (!module && !sheet) json["error"] = sheet.error().ToString();
  return json;
}

}  // namespace

Expected<void> ApplyStated(const ReadingForm& form, const std::string& file, CurveSet* set) {
  if (form.conditions.irradiance_W_m2 && set->curves.size() > 1) {
    return Fail(
        fmt::format("irradiance-Wm2 is for one curve, this measurement has {}", set->curves.size()),
        file);
  }
  return ApplyConditions(form.conditions, set);
}

Expected<CurveSet> ReadStated(const std::string& file, const ReadingForm& form) {
  TRY(CurveSet set, ReadMeasurement(file, form.reading));
  TRY(ApplyStated(form, file, &set));
  return set;
}

PageOptions InPage() {
  PageOptions options;
  options.stills = false;
  return options;
}

std::string StemOf(const std::string& file) { return std::filesystem::path(file).stem().string(); }

Expected<ordered_json> LookAt(const PageRequest& request) {
  TRY(const ReadingForm form, ReadLookForm(request.form));
  ordered_json json;
  json["columns"] = ColumnsJson(request.file, form.reading);
  json["curves"] = ordered_json::array();
  json["assumptions"] = ordered_json::array();
  Expected<CurveSet> set = ReadStated(request.file, form);
  if (!set) {
    if (ordered_json module = ModuleJson(request.file); !module.is_null()) {
      json.update(module);
      return json;
    }
    if (Expected<CurveSet> beside = ReadBeside(request, form)) set = std::move(beside);
  }
  if (!set) {
    Error error = set.error();
    if (error.file.empty()) error.file = request.file;
    json.update(ErrorJson(error));
    return json;
  }
  json["count"] = set->curves.size();
  const std::size_t count = std::min(kMostCurves, set->curves.size());
  const std::vector<IvCurve> shown(set->curves.begin(),
                                   set->curves.begin() + static_cast<std::ptrdiff_t>(count));
  for (const IvCurve& curve : shown) json["curves"].push_back(CurveJson(curve));
  json["picture_html"] = PicturePage(shown);
  std::vector<std::string> sentences = SentencesOf(set->assumptions);
  if (set->curves.size() == 1) sentences = SentencesOf(set->curves.front().assumptions);
  for (const RejectedCurve& bad : set->rejected) sentences.push_back(bad.error.ToString());
  json["assumptions"] = sentences;
  return json;
}

}  // namespace lyrefit

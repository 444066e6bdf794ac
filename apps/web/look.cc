#include "look.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/try.h"
#include "lyrefit/diagnose/diagnose.h"

namespace lyrefit {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMostPoints = 1000;  // of a curve shown before its fit
constexpr std::size_t kMostCurves = 30;

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
  const std::size_t step = std::max<std::size_t>(1, (curve.size() + kMostPoints - 1) / kMostPoints);
  std::vector<double> voltage_V, current_A;
  for (std::size_t i = 0; i < curve.size(); i += step) {
    voltage_V.push_back(curve.voltage_V[i]);
    current_A.push_back(curve.current_A[i]);
  }
  json["voltage_V"] = voltage_V;
  json["current_A"] = current_A;
  return json;
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

}  // namespace

Expected<CurveSet> ReadStated(const std::string& file, const ReadingForm& form) {
  TRY(CurveSet set, ReadMeasurement(file, form.reading));
  if (form.conditions.irradiance_W_m2 && set.curves.size() > 1) {
    return Fail(
        fmt::format("irradiance-Wm2 is for one curve, this measurement has {}", set.curves.size()),
        file);
  }
  TRY(ApplyConditions(form.conditions, &set));
  return set;
}

std::string StemOf(const std::string& file) { return std::filesystem::path(file).stem().string(); }

Expected<ordered_json> LookAt(const PageRequest& request) {
  TRY(const ReadingForm form, ReadLookForm(request.form));
  ordered_json json;
  json["columns"] = ColumnsJson(request.file, form.reading);
  json["curves"] = ordered_json::array();
  json["assumptions"] = ordered_json::array();
  const Expected<CurveSet> set = ReadStated(request.file, form);
  if (!set) {
    Error error = set.error();
    if (error.file.empty()) error.file = request.file;
    json["error"] = error.ToString();
    json["line"] = error.line;
    return json;
  }
  json["count"] = set->curves.size();
  for (std::size_t i = 0; i < std::min(kMostCurves, set->curves.size()); ++i) {
    json["curves"].push_back(CurveJson(set->curves[i]));
  }
  std::vector<std::string> sentences = SentencesOf(set->assumptions);
  if (set->curves.size() == 1) sentences = SentencesOf(set->curves.front().assumptions);
  for (const RejectedCurve& bad : set->rejected) sentences.push_back(bad.error.ToString());
  json["assumptions"] = sentences;
  return json;
}

}  // namespace lyrefit

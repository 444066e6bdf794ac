#include "lyrefit/read/read_curve_set.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cases.h"
#include "lyrefit/curve/date_time.h"
#include "lyrefit/read/json_curves.h"
#include "lyrefit/read/key_point_table.h"
#include "lyrefit/read/operating_points.h"
#include "lyrefit/read/sidecar.h"
#include "read/told.h"

namespace lyrefit {
namespace {

std::string Told(const JsonCurves& found) {
  std::string text;
  for (const RawCurve& raw : found.curves) {
    ToldValues told;
    told.Add("curve", raw.curve.name);
    if (raw.per_area) told.Add(std::string("per cm2"));
    told.Add(Told(raw.stated));
    told.Add(ToldReadings(raw.curve));
    text += (text.empty() ? "" : "\n  ") + told.Text();
  }
  for (const RejectedCurve& one : found.rejected) {
    text += "\n  rejected '" + one.id + "': " + one.error.ToString();
  }
  return text;
}

TEST(ReadCurveSetTest, ReadsSetsTheirSidecarsMatricesAndJson) {
  const auto sidecar = [](SidecarOf of) {
    return [of](const std::string& text) {
      return OfFiles("a.json | a.json: " + text, [&](const std::string& path, const ReadOptions&) {
        return ToldOrError(ReadSidecar(path, 1 << 20, of));
      });
    };
  };
  CheckCases("read_sets",
             {{"set",
               [](const std::string& given) {
                 return OfFiles(given, [](const std::string& path, const ReadOptions& options) {
                   return ToldOrError(ReadCurveSet(path, options));
                 });
               }},
              {"curve",
               [](const std::string& given) {
                 return OfFiles(given, [](const std::string& path, const ReadOptions& options) {
                   return ToldOrError(ReadCurve(path, options));
                 });
               }},
              {"holds a set",
               [](const std::string& given) {
                 return OfFiles(given, [](const std::string& path, const ReadOptions&) {
                   return HoldsCurveSet(path) ? "yes" : "no";
                 });
               }},
              {"sidecar", sidecar(SidecarOf::kCurve)},
              {"sidecar of a set", sidecar(SidecarOf::kSet)},
              {"matrix",
               [](const std::string& given) {
                 const auto [text, options] = WithOptions(given);
                 return (HoldsKeyPoints(text, "f") ? "" : "no matrix; ") +
                        ToldOrError(ReadKeyPoints({text, ""}, "f", "", options));
               }},
              {"operating table",
               [](const std::string& given) {
                 const auto [text, options] = WithOptions(given);
                 const TempFolder folder;
                 const auto points =
                     ReadOperatingTable(folder.Write("a.csv", text), 1 << 20, options.column);
                 if (!points) {
                   Error error = points.error();
                   error.file = "f";
                   return "error " + error.ToString();
                 }
                 std::string told;
                 for (const OperatingReading& at : *points) {
                   told += fmt::format("{}{}, {:.8g} W/m2, {:.8g} C, {:.8g} V, {:.8g} A",
                                       told.empty() ? "" : "\n", DateTimeText(at.time_s),
                                       at.irradiance_W_m2, at.temperature_C, at.voltage_V,
                                       at.current_A);
                 }
                 return told;
               }},
              {"json", [](const std::string& given) {
                 const auto [text, options] = WithOptions(given);
                 const auto found = FindJsonCurves(nlohmann::json::parse(text), "f", options);
                 return found ? Told(*found) : "error " + found.error().ToString();
               }}});
}

}  // namespace
}  // namespace lyrefit

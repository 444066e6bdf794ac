#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/read/read_table.h"
#include "lyrefit/read/sidecar.h"
#include "temp_folder.h"

// What a reader took, in words, for the cases in tests/golden.
namespace lyrefit {

inline std::string Joined(const std::vector<std::string>& parts, const std::string& between) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : between) + part;
  return text;
}

template <class Number>
std::string Numbers(const std::vector<Number>& values) {
  std::string text;
  for (const Number value : values) {
    text += fmt::format("{}{:.8g}", text.empty() ? "" : " ", static_cast<double>(value));
  }
  return text;
}

inline std::string Told(const std::vector<Assumption>& assumptions) {
  return Joined(SentencesOf(assumptions), " / ");
}

// The values that are set, with their names.
class ToldValues {
 public:
  template <class T>
  void Add(const char* name, const std::optional<T>& value) {
    if (value) parts_.push_back(fmt::format("{} {:.8g}", name, static_cast<double>(*value)));
  }
  void Add(const char* name, const std::string& text) {
    if (!text.empty()) parts_.push_back(std::string(name) + " '" + text + "'");
  }
  void Add(const std::string& part) {
    if (!part.empty()) parts_.push_back(part);
  }
  std::string Text() const { return Joined(parts_, "; "); }

 private:
  std::vector<std::string> parts_;
};

inline std::string Told(const DeviceNotes& notes) {
  ToldValues told;
  if (notes.setup != Setup::kUnknown) told.Add("setup " + ToText(notes.setup));
  told.Add("technology", notes.technology);
  told.Add("bypass diodes", notes.bypass_diodes);
  told.Add("modules", notes.modules_in_series);
  told.Add("gap", notes.bandgap_eV);
  told.Add("its slope", notes.bandgap_slope_per_K);
  told.Add("alpha per K", notes.isc_tempco_per_K);
  told.Add("alpha A/K", notes.isc_tempco_A_per_K);
  told.Add("noise A", notes.current_noise_constant_A);
  told.Add("noise relative", notes.current_noise_relative);
  told.Add("resolution A", notes.current_resolution_A);
  told.Add("area cm2", notes.area_cm2);
  told.Add("compliance A", notes.compliance_A);
  told.Add("lux", notes.illuminance_lux);
  told.Add("date", notes.date);
  return told.Text();
}

inline std::string Told(const Sidecar& sidecar) {
  ToldValues told;
  told.Add("name", sidecar.name);
  told.Add("cells", sidecar.cells_in_series);
  told.Add("strings", sidecar.strings_in_parallel);
  told.Add("C", sidecar.temperature_C);
  told.Add("W/m2", sidecar.irradiance_W_m2);
  told.Add("light", sidecar.light);
  told.Add(Told(sidecar.notes));
  told.Add("setup by", sidecar.stated_in.setup);
  told.Add(Told(sidecar.assumptions));
  return told.Text();
}

// The readings alone, and what was said of them.
inline std::string ToldReadings(const IvCurve& curve) {
  ToldValues told;
  const auto add = [&](const char* name, const auto& values) {
    if (!values.empty()) told.Add(name + (" " + Numbers(values)));
  };
  add("V", curve.voltage_V);
  add("I", curve.current_A);
  add("sigma", curve.sigma_A);
  add("time", curve.time_s);
  add("sweep", curve.sweep);
  add("W/m2", curve.irradiance_W_m2);
  add("C", curve.temperature_C);
  if (!curve.voltage_unit_known) told.Add(std::string("V?"));
  if (!curve.current_unit_known) told.Add(std::string("A?"));
  told.Add("Suns-Voc", curve.suns_voc_A);
  told.Add(Told(curve.assumptions));
  return told.Text();
}

inline std::string Told(const Table& table) {
  if (table.error) return "error " + table.error->ToString();
  ToldValues told;
  told.Add("measurement", table.name);
  if (table.holds_curves) told.Add(std::string("curves"));
  if (table.per_area) told.Add(std::string("per cm2"));
  told.Add(Told(table.head));
  told.Add(ToldReadings(table.curve));
  return told.Text();
}

// A whole curve with its conditions; "?" marks those that were assumed.
inline std::string Told(const IvCurve& curve) {
  const Conditions& at = curve.conditions;
  ToldValues told;
  told.Add("curve", curve.name);
  told.Add("of", curve.source);
  told.Add(fmt::format("cells {}{}, strings {}, {:.8g} C{}, {:.8g} W/m2{}", at.cells_in_series,
                       curve.cells_known ? "" : "?", at.strings_in_parallel,
                       at.cell_temperature_K - 273.15, curve.temperature_known ? "" : "?",
                       at.irradiance_W_m2, curve.irradiance_known ? "" : "?"));
  told.Add(Told(curve.notes));
  if (curve.key_points) {
    const KeyPoints& key = *curve.key_points;
    told.Add("key points " +
             Numbers(std::vector<double>{key.short_circuit_current_A, key.open_circuit_voltage_V,
                                         key.max_power_current_A, key.max_power_voltage_V,
                                         key.max_power_W}));
  }
  told.Add(ToldReadings(curve));
  return told.Text();
}

inline std::string Told(const CurveSet& set) {
  std::string text = "set '" + set.name + "' of " + set.source;
  if (!set.assumptions.empty()) text += ": " + Told(set.assumptions);
  for (const IvCurve& curve : set.curves) text += "\n  " + Told(curve);
  for (const RejectedCurve& one : set.rejected) {
    text += "\n  rejected '" + one.id + "': " + one.error.ToString();
  }
  return text;
}

template <class T>
std::string Told(const std::vector<T>& all) {
  std::string text;
  for (const T& one : all) text += (text.empty() ? "" : "\n  ") + Told(one);
  return text;
}

// What was read, or the error.
template <class T>
std::string ToldOrError(const Expected<T>& result) {
  return result ? Told(*result) : "error " + result.error().ToString();
}

// Splits "[column: 2] V1,I1,V2,I2": options, then the text.
inline std::pair<std::string, ReadOptions> WithOptions(std::string text) {
  ReadOptions options;
  const std::size_t end = text.find("] ");
  if (text[0] != '[' || end == std::string::npos || text.find(": ") > end) return {text, options};
  std::string list = text.substr(1, end - 1) + "; ";
  text = text.substr(end + 2);
  for (std::size_t next; (next = list.find("; ")) != std::string::npos;
       list = list.substr(next + 2)) {
    const std::size_t colon = list.find(": ");
    const std::string name = list.substr(0, colon),
                      value = list.substr(colon + 2, next - colon - 2);
    if (name == "voltage") options.voltage_column = value;
    if (name == "current") options.current_column = value;
    if (name == "column") options.column = value;
    if (name == "curve") options.curve = std::stoi(value);
    if (name == "missing") options.skip_missing = value == "skip";
    if (name == "isc") options.isc_A = std::stod(value);
  }
  return {text, options};
}

// Writes the files of a case "TEXT | FILE: CONTENT | FOLDER/:" and returns the text.
inline std::string WithFiles(const std::string& given, const TempFolder& folder) {
  const std::size_t end = given.find(" | ");
  for (std::size_t at = end; at != std::string::npos;) {
    const std::size_t next = given.find(" | ", at + 3), colon = given.find(": ", at);
    const std::string name = given.substr(at + 3, colon - at - 3);
    if (name.back() == '/') {
      std::filesystem::create_directories(folder.Path(name));
    } else {
      folder.Write(name,
                   given.substr(colon + 2, next == std::string::npos ? next : next - colon - 2));
    }
    at = next;
  }
  return given.substr(0, end);
}

// A text without the path of the folder.
inline std::string Without(const TempFolder& folder, std::string text) {
  for (const std::string& own : {folder.Path(""), folder.Path("").substr(1)}) {
    for (std::size_t at; (at = text.find(own)) != std::string::npos;) text.erase(at, own.size());
  }
  return text;
}

// Of a case "[curve: 5] PATH | FILE: CONTENT": what `read` tells of the path and the options.
template <class Read>
std::string OfFiles(const std::string& given, const Read& read) {
  const TempFolder folder;
  const auto [text, options] = WithOptions(given);
  return Without(folder, read(folder.Path(WithFiles(text, folder)), options));
}

}  // namespace lyrefit

#include "lyrefit/read/multi_flash.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "lyrefit/base/byte_input.h"
#include "lyrefit/base/file.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/read/join_sweeps.h"
#include "lyrefit/read/table_lines.h"

namespace lyrefit {
namespace {

constexpr std::string_view kLoads = "Averaged Data Out (VLoad Array)";
constexpr std::string_view kOpen = "Averaged Data Out (Voc Array)";
constexpr std::string_view kShort = "Averaged Data Out (Isc Array)";

struct Setting {
  std::string_view value;
  int line = 0;
};

// The settings of a file by their keys. A key that comes again counts as often as it comes.
struct Settings {
  const std::string& file;
  std::multimap<std::string, Setting, std::less<>> by_key;

  const Setting* Last(std::string_view key) const {
    const auto [begin, end] = by_key.equal_range(key);
    return begin == end ? nullptr : &std::prev(end)->second;
  }

  const Setting* First(std::string_view key) const {
    const auto found = by_key.find(key);
    return found == by_key.end() ? nullptr : &by_key.lower_bound(key)->second;
  }

  tl::unexpected<Error> Refuse(std::string message, int line) const {
    return Fail(std::move(message), file, line, line == 0 ? 0 : 1);
  }

  // A number other than 0 that the conversion needs.
  Expected<double> Constant(std::string_view key) const {
    const Setting* setting = First(key);
    if (setting == nullptr) {
      return Refuse(fmt::format("expected the constant \"{}\", found none", key), 0);
    }
    const auto number = ParseNumber(setting->value);
    if (number && std::isfinite(*number) && *number != 0) return *number;
    return Refuse(fmt::format("expected a number other than 0 in \"{}\", found {}", key,
                              Quoted(setting->value)),
                  setting->line);
  }

  std::optional<double> Number(const Setting* setting) const {
    const auto number = setting == nullptr ? std::nullopt : ParseNumber(setting->value);
    return number && std::isfinite(*number) ? number : std::nullopt;
  }

  // A whole number from 1 up.
  std::optional<int> Count(std::string_view key) const {
    constexpr double kMost = 1e6;
    const auto number = Number(First(key));
    const bool counts =
        number && *number >= 1 && *number <= kMost && *number == std::floor(*number);
    return counts ? std::optional<int>(static_cast<int>(*number)) : std::nullopt;
  }
};

Settings ReadSettings(std::string_view text, const std::string& file) {
  Settings settings{file, {}};
  LineReader lines(text);
  for (std::string_view line; lines.Next(&line);) {
    const std::size_t mark = line.find('=');
    if (mark == std::string_view::npos) continue;
    std::string_view value = TrimBlanks(line.substr(mark + 1));
    if (value.size() >= 2 && value.front() == '"' && value.back() == '"') {
      value = value.substr(1, value.size() - 2);
    }
    settings.by_key.emplace(TrimBlanks(line.substr(0, mark)), Setting{value, lines.number()});
  }
  return settings;
}

// An array as the file writes it, "<size(s)=2 3> 1 2 3 4 5 6".
struct Array {
  std::vector<std::size_t> sizes;
  std::vector<double> values;
  int line = 0;
};

// The next word of a text, cut off it; empty at its end.
std::string_view NextWord(std::string_view* text) {
  const std::size_t begin = text->find_first_not_of(" \t");
  if (begin == std::string_view::npos) return *text = {};
  const std::size_t end = std::min(text->find_first_of(" \t", begin), text->size());
  const std::string_view word = text->substr(begin, end - begin);
  text->remove_prefix(end);
  return word;
}

Expected<Array> ReadArray(const Settings& settings, std::string_view key) {
  constexpr std::string_view kSizes = "<size(s)=";
  constexpr double kLargest = 1e8;
  const Setting* setting = settings.First(key);
  if (setting == nullptr) {
    return settings.Refuse(fmt::format("expected the array \"{}\", found none", key), 0);
  }
  Array array;
  array.line = setting->line;
  std::string_view text = setting->value;
  const std::size_t end = text.find('>');
  const auto refuse = [&](const std::string& found) {
    return settings.Refuse(
        fmt::format("expected \"{}\" as <size(s)=...> and as many numbers, found {}", key, found),
        setting->line);
  };
  if (text.substr(0, kSizes.size()) != kSizes || end == std::string_view::npos) {
    return refuse(Quoted(text.substr(0, 30)));
  }
  std::string_view sizes = text.substr(kSizes.size(), end - kSizes.size());
  double expected = 1;
  for (std::string_view word; !(word = NextWord(&sizes)).empty();) {
    const auto size = ParseNumber(word);
    const bool fits = size && *size >= 0 && *size <= kLargest && *size == std::floor(*size);
    if (!fits) return refuse("the size " + Quoted(word));
    array.sizes.push_back(static_cast<std::size_t>(*size));
    expected *= *size;
  }
  text.remove_prefix(end + 1);
  for (std::string_view word; !(word = NextWord(&text)).empty();) {
    const auto number = ParseNumber(word);
    if (!number || !std::isfinite(*number)) {
      return refuse(fmt::format("{} at place {}", Quoted(word), array.values.size() + 1));
    }
    array.values.push_back(*number);
  }
  if (static_cast<double>(array.values.size()) != expected) {
    return refuse(fmt::format("{} numbers for {} by the sizes", array.values.size(), expected));
  }
  return array;
}

// What converts detector voltages.
struct Constants {
  double reference_V = 1;  // of the light, for a sun
  double voltage = 1;      // multiplies
  double current = 1;      // divides
};

Expected<Constants> ReadConstants(const Settings& settings) {
  Constants constants;
  TRY(constants.reference_V, settings.Constant("Reference Constant (V/sun)"));
  TRY(constants.voltage, settings.Constant("Voltage Transfer"));
  TRY(constants.current, settings.Constant("Current Transfer"));
  return constants;
}

struct FlashReading {
  double suns = 0;
  double voltage_V = 0;
  double current_A = 0;
};

// The readings of a flash, from its brightest on.
using Flash = std::vector<FlashReading>;

// A flash whose rows time, light, voltage, current, ... begin at `from`.
Flash FlashOf(const Array& array, std::size_t from, const Constants& constants) {
  enum Row { kLight = 1, kVoltage, kCurrent };
  const std::size_t length = array.sizes.back();
  const auto at = [&](Row row, std::size_t k) { return array.values[from + row * length + k]; };
  Flash flash;
  for (std::size_t k = 0; k < length; ++k) {
    flash.push_back({at(kLight, k) / constants.reference_V, at(kVoltage, k) * constants.voltage,
                     at(kCurrent, k) / constants.current});
  }
  const auto brightest = std::max_element(
      flash.begin(), flash.end(), [](const auto& a, const auto& b) { return a.suns < b.suns; });
  flash.erase(flash.begin(), brightest);
  return flash;
}

// Flashes of an array of `dimensions` 2 (one flash) or 3.
Expected<std::vector<Flash>> ReadFlashes(const Settings& settings, std::string_view key,
                                         std::size_t dimensions, const Constants& constants) {
  constexpr std::size_t kQuantities = 4;  // time, light, voltage, current; a temperature follows
  TRY(const Array array, ReadArray(settings, key));
  const auto& sizes = array.sizes;
  const bool fits = sizes.size() == dimensions && sizes[dimensions - 2] >= kQuantities;
  if (!fits) {
    return settings.Refuse(
        fmt::format(
            "expected \"{}\" in {} dimensions, with time, light, voltage and current in the "
            "last but one",
            key, dimensions),
        array.line);
  }
  const std::size_t one = sizes[dimensions - 2] * sizes[dimensions - 1];
  std::vector<Flash> flashes;
  for (std::size_t from = 0; from < array.values.size(); from += one) {
    if (StoppableReads::Stopped()) return FailAsStopped(settings.file);
    flashes.push_back(FlashOf(array, from, constants));
  }
  return flashes;
}

// The reading at the light `suns`, where the decay first passes it.
std::optional<FlashReading> ReadingAt(const Flash& flash, double suns) {
  for (std::size_t k = 0; k + 1 < flash.size(); ++k) {
    const FlashReading& a = flash[k];
    const FlashReading& b = flash[k + 1];
    if (!(a.suns >= suns && suns > b.suns)) continue;
    const double t = (a.suns - suns) / (a.suns - b.suns);
    return FlashReading{suns, a.voltage_V + t * (b.voltage_V - a.voltage_V),
                        a.current_A + t * (b.current_A - a.current_A)};
  }
  return std::nullopt;
}

// The conditions of all curves but their light.
Sidecar StatedIn(const Settings& settings) {
  Sidecar stated;
  TakeSetup(Setup::kFlash, "the format of the file", &stated);
  stated.cells_in_series = settings.Count("Number of Cells per String");
  stated.strings_in_parallel = settings.Count("Number of Strings");
  if (const Setting* date = settings.Last("Measurement Timestamp (ISO 8601 String)")) {
    stated.notes.date = std::string(date->value);
  }
  const std::string_view key = "Temperature (C)";  // first the wanted one, then the measured one
  if (settings.by_key.count(key) < 2) return stated;
  const auto measured = settings.Number(settings.Last(key));
  const double offset = settings.Number(settings.First("Temperature Offset (C)")).value_or(0);
  if (!measured) return stated;
  stated.temperature_C = *measured - offset;
  stated.assumptions.emplace_back(
      fmt::format(
          "cell temperature {:.4g} C: {:.4g} C measured, less the stated offset of {:.3g} C; "
          "the voltages are those at this temperature, not moved to another",
          *stated.temperature_C, *measured, offset),
      About::kTemperature);
  return stated;
}

// All flashes of a file.
struct AllFlashes {
  std::vector<Flash> flashes;  // at loads, and those at open and short circuit that it has
  Flash open;                  // that at open circuit
  std::size_t loads = 0;
};

Expected<AllFlashes> ReadAllFlashes(const Settings& settings, const Constants& constants) {
  AllFlashes all;
  TRY(all.flashes, ReadFlashes(settings, kLoads, 3, constants));
  all.loads = all.flashes.size();
  for (const std::string_view key : {kOpen, kShort}) {
    if (settings.First(key) == nullptr) continue;
    TRY(std::vector<Flash> one, ReadFlashes(settings, key, 2, constants));
    if (one.empty()) continue;
    if (key == kOpen) all.open = one.front();
    all.flashes.push_back(std::move(one.front()));
  }
  return all;
}

// The readings of all flashes that reach a light, by their voltages; nullopt if few reach it.
std::optional<IvCurve> CurveAt(const AllFlashes& all, double suns) {
  constexpr std::size_t kFewest = 6;
  constexpr double kMost = 0.8;  // of the flashes
  std::vector<FlashReading> readings;
  for (const Flash& flash : all.flashes) {
    if (const auto reading = ReadingAt(flash, suns)) readings.push_back(*reading);
  }
  const std::size_t missing = all.flashes.size() - readings.size();
  if (readings.size() < kFewest ||
      static_cast<double>(readings.size()) < kMost * static_cast<double>(all.flashes.size())) {
    return std::nullopt;
  }
  std::stable_sort(readings.begin(), readings.end(),
                   [](const auto& a, const auto& b) { return a.voltage_V < b.voltage_V; });
  IvCurve curve;
  curve.name = fmt::format("{:.4g} suns", suns);
  for (const FlashReading& reading : readings) {
    curve.voltage_V.push_back(reading.voltage_V);
    curve.current_A.push_back(reading.current_A);
  }
  if (missing > 0) {
    curve.assumptions.emplace_back(fmt::format("{} of {} flashes do not pass {:.4g} suns: left out",
                                               missing, all.flashes.size(), suns));
  }
  return curve;
}

// The decay at open circuit as a Suns-Voc trace, at lights in equal ratios; nullopt if it is short.
std::optional<IvCurve> TraceOf(const Flash& open, double target, const IvCurve& at_target) {
  constexpr int kReadings = 40;
  constexpr int kFewest = 5;
  constexpr double kBrightest = 1.2, kDarkest = 0.01;  // of the target
  const double isc =
      FindKeyPoints(at_target.voltage_V, at_target.current_A).short_circuit_current_A;
  IvCurve trace;
  trace.name = "Suns-Voc";
  for (int k = 0; k < kReadings; ++k) {
    const double part = static_cast<double>(k) / (kReadings - 1);
    const double suns = target * kBrightest * std::pow(kDarkest / kBrightest, part);
    const auto reading = ReadingAt(open, suns);
    if (!reading) continue;
    trace.voltage_V.push_back(reading->voltage_V);
    trace.current_A.push_back(suns);
  }
  if (trace.size() < kFewest || !(isc > 0)) return std::nullopt;
  if (!LightToCurrent(SunsVocColumns{}, isc / target, &trace)) return std::nullopt;
  return trace;
}

}  // namespace

bool IsMultiFlash(std::string_view text) {
  const std::size_t key = text.find(kLoads);
  return key != std::string_view::npos && (key == 0 || text[key - 1] == '\n');
}

Expected<MultiFlash> ReadMultiFlash(std::string_view text, const std::string& file) {
  constexpr double kSun_W_m2 = 1000;
  constexpr double kParts[] = {0.1, 0.2, 0.4, 0.6, 0.8, 1, 1.2};  // of the target light
  const Settings settings = ReadSettings(text, file);
  TRY(const Constants constants, ReadConstants(settings));
  TRY(const AllFlashes all, ReadAllFlashes(settings, constants));
  const double wanted = settings.Number(settings.First("Intensity (suns)")).value_or(1);
  const double target = wanted > 0 ? wanted : 1;
  const double sun = settings.Number(settings.First("Power per Sun (W/m2)")).value_or(kSun_W_m2);
  Sidecar stated = StatedIn(settings);
  stated.assumptions.emplace_back(fmt::format(
      "{} flashes at fixed loads, joined at equal light; detector voltages converted by the "
      "constants of the file: light / {:.6g} V a sun, voltage x {:.6g}, current / {:.6g}",
      all.loads, constants.reference_V, constants.voltage, constants.current));
  MultiFlash found;
  const auto add = [&](IvCurve curve, double suns) {
    curve.source = file;
    found.curves.push_back({std::move(curve), stated, false});
    found.curves.back().stated.irradiance_W_m2 = suns * sun;
  };
  for (const double part : kParts) {
    std::optional<IvCurve> curve = CurveAt(all, part * target);
    if (!curve) continue;
    if (part == 1) found.at_target = found.curves.size();
    add(std::move(*curve), part * target);
  }
  if (found.curves.empty()) {
    const Setting* loads = settings.First(kLoads);
    return settings.Refuse(
        fmt::format("expected flashes whose light passes {:.3g} to {:.3g} suns, found too few",
                    kParts[0] * target, kParts[6] * target),
        loads->line);
  }
  if (!found.at_target) return found;
  auto trace = TraceOf(all.open, target, found.curves[*found.at_target].curve);
  if (trace) add(std::move(*trace), 1);
  return found;
}

}  // namespace lyrefit

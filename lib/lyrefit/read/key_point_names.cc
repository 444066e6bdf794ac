#include "lyrefit/read/key_point_names.h"

#include <algorithm>
#include <utility>

#include "lyrefit/read/label.h"

namespace lyrefit {
namespace {

// Names in letters, also those of German (Ik, Uoc, Umpp), French (Icc, Vco) and Spanish (Icc, Vca,
// Ipmp) data sheets.
constexpr std::pair<std::string_view, KeyPoint> kPointNames[] = {
    {"isc", kIsc},  {"icc", kIsc},  {"ik", kIsc},   {"voc", kVoc},  {"uoc", kVoc},  {"vco", kVoc},
    {"uco", kVoc},  {"vca", kVoc},  {"imp", kImp},  {"impp", kImp}, {"ipm", kImp},  {"ipmp", kImp},
    {"im", kImp},   {"vmp", kVmp},  {"vmpp", kVmp}, {"ump", kVmp},  {"umpp", kVmp}, {"vpm", kVmp},
    {"upm", kVmp},  {"vpmp", kVmp}, {"vm", kVmp},   {"um", kVmp},   {"pmp", kPmp},  {"pmpp", kPmp},
    {"pmax", kPmp}, {"ppm", kPmp},  {"ppmp", kPmp}, {"pm", kPmp}};

// What a word says of a key point.
enum Meaning : unsigned {
  kNothing = 0,
  kCurrentWord = 1,
  kVoltageWord = 2,
  kPowerWord = 4,
  kShortWord = 8,
  kOpenWord = 16,
  kLargest = 32,
};

constexpr std::pair<std::string_view, unsigned> kWords[] = {
    {"current", kCurrentWord},  {"amperage", kCurrentWord},
    {"i", kCurrentWord},        {"voltage", kVoltageWord},
    {"v", kVoltageWord},        {"u", kVoltageWord},
    {"power", kPowerWord},      {"p", kPowerWord},
    {"short", kShortWord},      {"shortcircuit", kShortWord},
    {"sc", kShortWord},         {"open", kOpenWord},
    {"opencircuit", kOpenWord}, {"oc", kOpenWord},
    {"maximum", kLargest},      {"max", kLargest},
    {"peak", kLargest},         {"mpp", kLargest},
    {"mp", kLargest},           {"pmax", kLargest},
    {"pmpp", kLargest},         {"circuit", kNothing},
    {"point", kNothing},        {"at", kNothing},
    {"of", kNothing},           {"bei", kNothing},
};

// The key point that words name: a quantity and its place on the curve.
std::optional<KeyPoint> FromWords(const std::vector<LabelWord>& words, std::size_t count) {
  unsigned said = kNothing;
  for (std::size_t i = 0; i < count; ++i) {
    const auto* const word = std::find_if(std::begin(kWords), std::end(kWords),
                                          [&](const auto& w) { return w.first == words[i].text; });
    if (word == std::end(kWords)) return std::nullopt;
    said |= word->second;
  }
  const unsigned place = said & (kShortWord | kOpenWord | kLargest);
  const unsigned quantity = said & (kCurrentWord | kVoltageWord);
  if (place == kShortWord && quantity == kCurrentWord) return kIsc;
  if (place == kOpenWord && quantity == kVoltageWord) return kVoc;
  if (place != kLargest) return std::nullopt;
  if (quantity == kCurrentWord) return kImp;
  if (quantity == kVoltageWord) return kVmp;
  return quantity == kNothing && (said & kPowerWord) != 0 ? std::optional(kPmp) : std::nullopt;
}

std::optional<KeyPoint> Named(const std::vector<LabelWord>& words, std::size_t count) {
  const std::string name = JoinWords(words, 0, count);
  for (const auto& [text, point] : kPointNames) {
    if (text == name) return point;
  }
  return FromWords(words, count);
}

// Factor to watt, volt or ampere of a unit; 1 if there is none.
std::optional<double> FactorOf(KeyPoint point, const std::string& unit) {
  if (unit.empty()) return 1;
  if (point == kPmp) {
    if (unit == "w" || unit == "wp") return 1;
    if (unit == "mw") return 1e-3;
    return unit == "kw" ? std::optional(1e3) : std::nullopt;
  }
  const bool current = point == kIsc || point == kImp;
  const Unit* known = FindUnit(current ? ColumnKind::kCurrent : ColumnKind::kVoltage, unit);
  return known == nullptr ? std::nullopt : std::optional(known->factor);
}

}  // namespace

std::optional<KeyPointColumn> AsKeyPoint(std::string_view label) {
  const std::vector<LabelWord> words = SplitLabel(label);
  for (std::size_t count = words.size(); count > 0; --count) {
    const auto point = Named(words, count);
    if (!point) continue;
    const auto factor = FactorOf(*point, JoinWords(words, count, words.size()));
    if (factor) return KeyPointColumn{*point, *factor};
  }
  return std::nullopt;
}

std::optional<MatrixColumns> AsMatrix(const std::vector<std::string>& names) {
  constexpr int kFewestPoints = 3, kConditions = 2;
  if (names.size() < kFewestPoints + kConditions) return std::nullopt;
  MatrixColumns matrix;
  int points = 0;
  bool axis = false;
  for (const std::string& name : names) {
    matrix.points.push_back(AsKeyPoint(name));
    if (!matrix.points.back()) continue;
    ++points;
    axis = axis || matrix.points.back()->point == kIsc || matrix.points.back()->point == kVoc;
  }
  if (points < kFewestPoints || !axis) return std::nullopt;
  for (int i = 0; i < static_cast<int>(names.size()); ++i) {
    if (matrix.points[i]) continue;
    const Column column = RecogniseColumn(names[i]);
    if (!column.refusal.empty()) continue;
    if (IsElectrical(column.kind)) return std::nullopt;
    if (column.kind == ColumnKind::kIrradiance && matrix.irradiance_place == -1) {
      matrix.irradiance = column;
      matrix.irradiance_place = i;
    } else if (column.kind == ColumnKind::kTemperature && matrix.temperature_place == -1) {
      matrix.temperature = column;
      matrix.temperature_place = i;
    }
  }
  const bool conditions = matrix.irradiance_place != -1 && matrix.temperature_place != -1;
  return conditions ? std::optional(matrix) : std::nullopt;
}

}  // namespace lyrefit

#include "lyrefit/read/label.h"

#include <optional>
#include <utility>

namespace lyrefit {
namespace {

constexpr Unit kUnits[] = {
    {ColumnKind::kVoltage, "v", 1, 0, false},
    {ColumnKind::kVoltage, "volt", 1, 0, true},
    {ColumnKind::kVoltage, "volts", 1, 0, true},
    {ColumnKind::kVoltage, "mv", 1e-3, 0, true},
    {ColumnKind::kVoltage, "millivolts", 1e-3, 0, true},
    {ColumnKind::kVoltage, "uv", 1e-6, 0, true},
    {ColumnKind::kVoltage, "kv", 1e3, 0, true},
    {ColumnKind::kVoltage, "dv", 1e-1, 0, false},
    {ColumnKind::kVoltage, "cv", 1e-2, 0, false},
    {ColumnKind::kCurrent, "a", 1, 0, true},
    {ColumnKind::kCurrent, "amp", 1, 0, true},
    {ColumnKind::kCurrent, "amps", 1, 0, true},
    {ColumnKind::kCurrent, "ampere", 1, 0, true},
    {ColumnKind::kCurrent, "amperes", 1, 0, true},
    {ColumnKind::kCurrent, "ma", 1e-3, 0, true},
    {ColumnKind::kCurrent, "milliamps", 1e-3, 0, true},
    {ColumnKind::kCurrent, "ua", 1e-6, 0, true},
    {ColumnKind::kCurrent, "na", 1e-9, 0, true},
    {ColumnKind::kCurrent, "ka", 1e3, 0, true},
    {ColumnKind::kCurrent, "da", 1e-1, 0, false},
    {ColumnKind::kCurrent, "ca", 1e-2, 0, false},
    {ColumnKind::kCurrentDensity, "acm2", 1, 0, false},
    {ColumnKind::kCurrentDensity, "macm2", 1e-3, 0, false},
    {ColumnKind::kCurrentDensity, "uacm2", 1e-6, 0, false},
    {ColumnKind::kCurrentDensity, "nacm2", 1e-9, 0, false},
    {ColumnKind::kCurrentDensity, "am2", 1e-4, 0, false},
    {ColumnKind::kCurrentDensity, "mam2", 1e-7, 0, false},
    {ColumnKind::kTime, "s", 1, 0, false},
    {ColumnKind::kTime, "sec", 1, 0, false},
    {ColumnKind::kTime, "seconds", 1, 0, false},
    {ColumnKind::kTime, "ms", 1e-3, 0, false},
    {ColumnKind::kTime, "us", 1e-6, 0, false},
    {ColumnKind::kTime, "min", 60, 0, false},
    {ColumnKind::kIrradiance, "wm2", 1, 0, false},
    {ColumnKind::kIrradiance, "kwm2", 1e3, 0, false},
    {ColumnKind::kIrradiance, "mwcm2", 10, 0, false},
    {ColumnKind::kIrradiance, "sun", 1e3, 0, false},
    {ColumnKind::kIrradiance, "suns", 1e3, 0, false},
    {ColumnKind::kIrradiance, "percentsun", 10, 0, false},
    {ColumnKind::kIrradiance, "percentsuns", 10, 0, false},
    {ColumnKind::kIrradiance, "percentofsun", 10, 0, false},
    {ColumnKind::kIrradiance, "percentofonesun", 10, 0, false},
    {ColumnKind::kIrradiance, "percent1sun", 10, 0, false},
    {ColumnKind::kTemperature, "c", 1, 0, false},
    {ColumnKind::kTemperature, "degc", 1, 0, false},
    {ColumnKind::kTemperature, "celsius", 1, 0, false},
    {ColumnKind::kTemperature, "k", 1, -273.15, false},
    {ColumnKind::kTemperature, "kelvin", 1, -273.15, false},
    {ColumnKind::kArea, "cm2", 1, 0, false},
    {ColumnKind::kArea, "mm2", 1e-2, 0, false},
    {ColumnKind::kArea, "m2", 1e4, 0, false},
};

// Translates a non-ASCII character at the start of `text` that has a meaning in units; nullopt if
// there is none.
std::optional<std::pair<std::string_view, std::string_view>> Symbol(std::string_view text) {
  static constexpr std::pair<std::string_view, std::string_view> kSymbols[] = {
      {"\u00b5", "u"},   {"\u03bc", "u"},  {"\u00b2", "2"},  {"\u00b0", ""},  {"\u00ba", ""},
      {"\u03a9", "ohm"}, {"\u207b", ""},   {"\u2212", " "},  {"\u00a0", " "}, {"\u03c3", "sigma"},
      {"\u2103", "c"},   {"\u33a1", "m2"}, {"\u33a0", "cm2"}};
  for (const auto& symbol : kSymbols) {
    if (text.substr(0, symbol.first.size()) == symbol.first) return symbol;
  }
  return std::nullopt;
}

}  // namespace

std::vector<LabelWord> SplitLabel(std::string_view text) {
  constexpr std::size_t kLongestLabel = 300;
  std::vector<LabelWord> words;
  if (text.size() > kLongestLabel) return words;
  const std::string label = HalfWidth(text);
  bool inside = false;
  bool marked = false;
  const auto add = [&](std::string_view letters) {
    if (!inside) words.push_back({"", "", marked && !words.empty()});
    inside = true;
    for (const char c : letters) {
      const bool upper = c >= 'A' && c <= 'Z';
      words.back().text += upper ? static_cast<char>(c - 'A' + 'a') : c;
      words.back().original += c;
    }
  };
  for (std::size_t at = 0; at < label.size(); ++at) {
    const char c = label[at];
    const bool alnum = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (const auto symbol = Symbol(std::string_view(label).substr(at))) {
      if (symbol->second == " ") inside = false;
      if (symbol->second != " " && !symbol->second.empty()) add(symbol->second);
      at += symbol->first.size() - 1;
    } else if (alnum || static_cast<unsigned char>(c) >= 0x80) {
      add(std::string_view(label).substr(at, 1));
    } else {
      inside = false;
      if (c == '(' || c == '[' || c == '{' || c == '/' || c == ',') marked = true;
      if (c == '%') add("percent");
      if (c == '%') inside = false;
    }
  }
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i].text == "vs") words.resize(i);
  }
  Translate(&words);
  return words;
}

std::string JoinWords(const std::vector<LabelWord>& words, std::size_t from, std::size_t to) {
  std::string joined;
  for (std::size_t i = from; i < to; ++i) joined += words[i].text;
  return joined;
}

const Unit* FindUnit(ColumnKind kind, std::string_view text) {
  if (kind == ColumnKind::kSigma) kind = ColumnKind::kCurrent;
  for (const Unit& unit : kUnits) {
    if (unit.kind == kind && unit.text == text) return &unit;
  }
  return nullptr;
}

const Unit* FindUnitHeader(std::string_view text) {
  for (const Unit& unit : kUnits) {
    if (unit.is_a_header && unit.text == text) return &unit;
  }
  return nullptr;
}

std::string_view ExpectedUnits(ColumnKind kind) {
  switch (kind) {
    case ColumnKind::kVoltage:
      return "V, mV, uV or kV";
    case ColumnKind::kTime:
      return "s, ms, us or min";
    case ColumnKind::kIrradiance:
      return "W/m2, kW/m2, mW/cm2 or suns";
    case ColumnKind::kTemperature:
      return "C or K";
    case ColumnKind::kCurrentDensity:
      return "mA/cm2, A/cm2, uA/cm2 or A/m2";
    default:
      return "A, mA, uA, nA or kA";
  }
}

}  // namespace lyrefit

#include "lyrefit/curve/column.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "lyrefit/curve/number_text.h"

namespace lyrefit {
namespace {

struct Name {
  std::string_view text;  // letters and digits only, lower case
  ColumnKind kind;
};

constexpr Name kNames[] = {
    {"v", ColumnKind::kVoltage},
    {"u", ColumnKind::kVoltage},
    {"voltage", ColumnKind::kVoltage},
    {"voltages", ColumnKind::kVoltage},
    {"spannung", ColumnKind::kVoltage},
    {"i", ColumnKind::kCurrent},
    {"current", ColumnKind::kCurrent},
    {"currents", ColumnKind::kCurrent},
    {"strom", ColumnKind::kCurrent},
    {"sigma", ColumnKind::kSigma},
    {"sigmai", ColumnKind::kSigma},
    {"currentsigma", ColumnKind::kSigma},
    {"sigmacurrent", ColumnKind::kSigma},
    {"uncertainty", ColumnKind::kSigma},
    {"currentuncertainty", ColumnKind::kSigma},
    {"time", ColumnKind::kTime},
    {"elapsedtime", ColumnKind::kTime},
    {"t", ColumnKind::kTime},
    {"sweep", ColumnKind::kSweep},
    {"scan", ColumnKind::kSweep},
    {"curve", ColumnKind::kCurve},
    {"irradiance", ColumnKind::kIrradiance},
    {"g", ColumnKind::kIrradiance},
    {"poa", ColumnKind::kIrradiance},
    {"poairradiance", ColumnKind::kIrradiance},
    {"irradiancepoa", ColumnKind::kIrradiance},
    {"temperature", ColumnKind::kTemperature},
    {"temp", ColumnKind::kTemperature},
    {"tcell", ColumnKind::kTemperature},
    {"tmodule", ColumnKind::kTemperature},
    {"j", ColumnKind::kCurrentDensity},
    {"currentdensity", ColumnKind::kCurrentDensity},
};

struct Unit {
  ColumnKind kind;
  std::string_view text;
  double factor;
  double offset;
  bool is_a_header;  // stands alone as a header: "Volts", "mA"
};

constexpr Unit kUnits[] = {
    {ColumnKind::kVoltage, "v", 1, 0, false},
    {ColumnKind::kVoltage, "volt", 1, 0, true},
    {ColumnKind::kVoltage, "volts", 1, 0, true},
    {ColumnKind::kVoltage, "mv", 1e-3, 0, true},
    {ColumnKind::kVoltage, "millivolts", 1e-3, 0, true},
    {ColumnKind::kVoltage, "uv", 1e-6, 0, true},
    {ColumnKind::kVoltage, "kv", 1e3, 0, true},
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
    {ColumnKind::kTemperature, "c", 1, 0, false},
    {ColumnKind::kTemperature, "degc", 1, 0, false},
    {ColumnKind::kTemperature, "celsius", 1, 0, false},
    {ColumnKind::kTemperature, "k", 1, -273.15, false},
    {ColumnKind::kTemperature, "kelvin", 1, -273.15, false},
};

// Say where a quantity was taken, not what it is.
constexpr std::string_view kQualifiers[] = {"pv",       "module", "cell", "panel",  "array",
                                            "string",   "load",   "bias", "dut",    "device",
                                            "measured", "meas",   "dc",   "output", "in"};

// Not ours, but certainly units: "voltage_percent" is a voltage in percent, "voltage_set" is not.
constexpr std::string_view kForeignUnits[] = {"percent", "pct", "pu",  "w",         "mw", "kw",
                                              "ohm",     "db",  "f",   "degf",      "h",  "lux",
                                              "adc",     "raw", "bit", "fahrenheit"};

struct Token {
  std::string text;      // lower case
  std::string original;  // as written
  bool marked_as_unit;   // behind a bracket, slash or comma
};

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
    default:
      return "A, mA, uA, nA or kA";
  }
}

// The character beyond ASCII at the start of `text`, where it means something in a unit.
std::optional<std::pair<std::string_view, std::string_view>> Symbol(std::string_view text) {
  static constexpr std::pair<std::string_view, std::string_view> kSymbols[] = {
      {"\u00b5", "u"}, {"\u03bc", "u"}, {"\u00b2", "2"}, {"\u00b0", ""},     {"\u03a9", "ohm"},
      {"\u207b", ""},  {"\u2212", " "}, {"\u00a0", " "}, {"\u03c3", "sigma"}};
  for (const auto& symbol : kSymbols) {
    if (text.substr(0, symbol.first.size()) == symbol.first) return symbol;
  }
  return std::nullopt;
}

std::vector<Token> Tokenise(std::string_view label) {
  std::vector<Token> tokens;
  bool inside = false;
  bool marked = false;
  const auto add = [&](std::string_view letters) {
    if (!inside) tokens.push_back({"", "", marked && !tokens.empty()});
    inside = true;
    for (const char c : letters) {
      const bool upper = c >= 'A' && c <= 'Z';
      tokens.back().text += upper ? static_cast<char>(c - 'A' + 'a') : c;
      tokens.back().original += c;
    }
  };
  for (std::size_t at = 0; at < label.size(); ++at) {
    const char c = label[at];
    const bool alnum = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (const auto symbol = Symbol(label.substr(at))) {
      if (symbol->second == " ") inside = false;
      if (symbol->second != " " && !symbol->second.empty()) add(symbol->second);
      at += symbol->first.size() - 1;
    } else if (alnum || static_cast<unsigned char>(c) >= 0x80) {
      add(label.substr(at, 1));
    } else {
      inside = false;
      if (c == '(' || c == '[' || c == '{' || c == '/' || c == ',') marked = true;
      if (c == '%') add("percent");
      if (c == '%') inside = false;
    }
  }
  return tokens;
}

void DropQualifiers(std::vector<Token>* tokens) {
  if (tokens->size() < 2) return;
  std::vector<Token> kept;
  for (const Token& token : *tokens) {
    const bool qualifier = std::find(std::begin(kQualifiers), std::end(kQualifiers), token.text) !=
                           std::end(kQualifiers);
    if (!qualifier) kept.push_back(token);
  }
  if (!kept.empty()) *tokens = kept;
}

std::string Join(const std::vector<Token>& tokens, std::size_t from, std::size_t to) {
  std::string joined;
  for (std::size_t i = from; i < to; ++i) joined += tokens[i].text;
  return joined;
}

const Unit* FindUnit(ColumnKind kind, std::string_view text) {
  if (kind == ColumnKind::kSigma) kind = ColumnKind::kCurrent;
  for (const Unit& unit : kUnits) {
    if (unit.kind == kind && unit.text == text) return &unit;
  }
  return nullptr;
}

void TakeUnit(const Unit& unit, Column* column) {
  column->unit = unit.text;
  column->factor = unit.factor;
  column->offset = unit.offset;
}

bool IsPerArea(std::string_view unit) {
  return (unit.size() > 2 && unit.substr(unit.size() - 2) == "m2" && unit[0] != 'w');
}

// False if the words behind the name make it the name of something else.
bool TakeRest(const std::vector<Token>& tokens, std::size_t from, Column* column) {
  const std::string rest = Join(tokens, from, tokens.size());
  if (rest.empty()) return true;
  if (column->kind == ColumnKind::kCurrentDensity) return true;
  if (const Unit* unit = FindUnit(column->kind, rest)) {
    TakeUnit(*unit, column);
    return true;
  }
  if (column->kind == ColumnKind::kCurrent && IsPerArea(rest)) {
    column->kind = ColumnKind::kCurrentDensity;
    return true;
  }
  if (column->kind == ColumnKind::kSweep || column->kind == ColumnKind::kCurve) {
    return rest == "number" || rest == "index" || rest == "no" || rest == "id";
  }
  const bool foreign = std::find(std::begin(kForeignUnits), std::end(kForeignUnits), rest) !=
                       std::end(kForeignUnits);
  if (!foreign && !tokens[from].marked_as_unit) return false;
  column->unit = rest;
  column->refusal = fmt::format("column {} is in {}: expected {}", Quoted(column->label),
                                Quoted(rest), ExpectedUnits(column->kind));
  return true;
}

// A lone T is a temperature and a lone t a time, unless the unit says otherwise.
ColumnKind TimeOrTemperature(const std::vector<Token>& tokens) {
  const std::string unit = Join(tokens, 1, tokens.size());
  if (FindUnit(ColumnKind::kTime, unit) != nullptr) return ColumnKind::kTime;
  if (FindUnit(ColumnKind::kTemperature, unit) != nullptr) return ColumnKind::kTemperature;
  return tokens[0].original == "T" ? ColumnKind::kTemperature : ColumnKind::kTime;
}

}  // namespace

Column RecogniseColumn(std::string_view label) {
  Column column;
  column.label = std::string(label);
  std::vector<Token> tokens = Tokenise(label);
  DropQualifiers(&tokens);
  for (const Unit& unit : kUnits) {
    if (!unit.is_a_header || tokens.size() != 1 || unit.text != tokens[0].text) continue;
    column.kind = unit.kind;
    TakeUnit(unit, &column);
    return column;
  }
  for (std::size_t words = tokens.size(); words > 0; --words) {
    const std::string name = Join(tokens, 0, words);
    for (const Name& known : kNames) {
      if (known.text != name) continue;
      column.kind = name == "t" ? TimeOrTemperature(tokens) : known.kind;
      if (!TakeRest(tokens, words, &column)) column.kind = ColumnKind::kUnknown;
      if (column.kind == ColumnKind::kCurrentDensity) {
        column.refusal = fmt::format(
            "column {} is a current density: expected a current (multiply by the cell's area)",
            Quoted(column.label));
      }
      return column;
    }
  }
  return column;
}

}  // namespace lyrefit

#include "lyrefit/read/head_statement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "lyrefit/base/number_text.h"
#include "lyrefit/read/table_header.h"

namespace lyrefit {
namespace {

bool HasAny(const Statement& statement, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return statement.words.count(word) != 0; });
}

// Whether the statement concerns another plane, a limit or a standard condition.
bool IsAboutOtherThings(const Statement& statement) {
  return HasAny(
      statement,
      {"ghi",       "dni",         "dhi",    "horizontal", "diffuse", "stc",     "noct",
       "reference", "ref",         "min",    "max",        "minimum", "maximum", "threshold",
       "target",    "coefficient", "alpha",  "beta",       "gamma",   "tempco",  "tolerance",
       "error",     "deviation",   "std",    "stdev",      "power",   "ambient", "air",
       "back",      "parallel",    "modules"});
}

std::optional<double> Converted(const Statement& statement, ColumnKind kind) {
  if (statement.unit.empty()) return std::nullopt;
  const Unit* unit = FindUnit(kind, statement.unit);
  if (unit == nullptr) return std::nullopt;
  return statement.value * unit->factor + unit->offset;
}

// Power over area that falls on the device, whose name speaks of power as other statements do.
bool NamesPowerOfLight(const Statement& statement) {
  static const std::set<std::string> kNames = {"powerdensity",
                                               "incidentpower",
                                               "incidentpowerdensity",
                                               "inputpower",
                                               "inputpowerdensity",
                                               "lightpower",
                                               "lightpowerdensity",
                                               "opticalpower",
                                               "opticalpowerdensity",
                                               "pin",
                                               "pinc",
                                               "irradiancepower"};
  return kNames.count(statement.name) != 0;
}

std::optional<double> AsIrradiance(const Statement& statement) {
  const bool named = HasAny(statement, {"irradiance", "irr", "irrad", "poa", "insolation",
                                        "intensity", "light", "illumination", "illuminance", "lamp",
                                        "g", "e", "sun", "suns", "pyranometer"}) ||
                     NamesPowerOfLight(statement);
  static const std::set<std::string> kConcentrations = {
      "concentration",      "concentrationratio", "concentrationfactor", "geometricconcentration",
      "lightconcentration", "solarconcentration", "opticalconcentration"};
  const bool concentration = kConcentrations.count(statement.name) != 0;
  if (!named && !concentration) return std::nullopt;
  auto value = Converted(statement, ColumnKind::kIrradiance);
  const bool times = statement.unit == "x" || (concentration && statement.unit.empty());
  if (times && statement.value >= 1) value = 1000 * statement.value;
  const bool in_suns = statement.name == "suns" || statement.name == "sun";
  if (in_suns && statement.unit.empty()) value = 1000 * statement.value;
  const bool plain = HasAny(statement, {"irradiance", "irr", "irrad", "poa"});
  if (!value && statement.unit.empty() && plain && statement.value >= 20) value = statement.value;
  constexpr double kMostSuns_W_m2 = 1e7;  // of concentrators
  if (!value || !(*value >= 0 && *value <= kMostSuns_W_m2)) return std::nullopt;
  return value;
}

// Light in lux, whatever its name: no other quantity has that unit.
std::optional<double> AsIlluminance(const Statement& statement) {
  const bool lux = statement.unit == "lux" || statement.unit == "lx";
  const bool kilo = statement.unit == "klux" || statement.unit == "klx";
  if (!(lux || kilo) || !(statement.value >= 0)) return std::nullopt;
  return (kilo ? 1000 : 1) * statement.value;
}

std::optional<double> AsTemperature(const Statement& statement) {
  static const std::set<std::string> kWhole = {"tc",     "tcell",       "tmod",      "tmodule",
                                               "tpv",    "temperature", "temp",      "tmodul",
                                               "tzelle", "celltemp",    "moduletemp"};
  const bool whole = kWhole.count(statement.name) != 0;
  const bool temperature = HasAny(statement, {"temperature", "temp", "t"});
  const bool place = HasAny(statement, {"cell", "cells", "module", "mod", "pv", "panel", "device",
                                        "sample", "backsheet", "backside", "stage", "chuck"});
  if (!whole && !(temperature && place)) return std::nullopt;
  auto value = Converted(statement, ColumnKind::kTemperature);
  if (!value && statement.unit.empty()) value = statement.value;
  if (!value || !(*value >= -100 && *value <= 150)) return std::nullopt;
  return value;
}

std::optional<int> AsCells(const Statement& statement) {
  const bool count = HasAny(statement, {"number", "no", "num", "n", "count", "series", "in", "nr"});
  const bool named = statement.name == "cells" || statement.name == "ns" ||
                     statement.name == "ncells" || statement.name == "nscells" ||
                     (HasAny(statement, {"cells"}) && count);
  const bool whole = statement.value == std::floor(statement.value) && statement.value >= 1 &&
                     statement.value <= 10000;
  if (!named || !whole || !statement.unit.empty()) return std::nullopt;
  return static_cast<int>(statement.value);
}

std::optional<int> AsBypassDiodes(const Statement& statement) {
  const bool named = HasAny(statement, {"bypass"}) && HasAny(statement, {"diodes"});
  const bool whole = statement.value == std::floor(statement.value) && statement.value >= 0 &&
                     statement.value <= 1000;
  if (!named || !whole || !statement.unit.empty()) return std::nullopt;
  return static_cast<int>(statement.value);
}

std::optional<int> AsStrings(const Statement& statement) {
  const bool named = statement.name == "parallelstrings" || statement.name == "stringsinparallel";
  const bool whole = statement.value == std::floor(statement.value) && statement.value >= 1 &&
                     statement.value <= 10000;
  if (!named || !whole || !statement.unit.empty()) return std::nullopt;
  return static_cast<int>(statement.value);
}

std::optional<double> AsArea(const Statement& statement) {
  static const std::set<std::string> kSizes = {"size", "cellsize", "devicesize", "pixelsize"};
  const bool named = HasAny(statement, {"area", "aperture"}) || kSizes.count(statement.name) != 0;
  if (!named) return std::nullopt;
  const auto value = Converted(statement, ColumnKind::kArea);
  if (!value || !(*value > 0)) return std::nullopt;
  return value;
}

// `area_cm2`: of the cell, for a limit per area.
std::optional<double> AsCompliance(const Statement& statement, std::optional<double> area_cm2) {
  const bool named = HasAny(statement, {"compliance"}) ||
                     (HasAny(statement, {"limit"}) && HasAny(statement, {"current", "i"}));
  if (!named) return std::nullopt;
  auto value = Converted(statement, ColumnKind::kCurrent);
  const auto density = Converted(statement, ColumnKind::kCurrentDensity);
  if (!value && density && area_cm2) value = *density * *area_cm2;
  if (!value || !(*value > 0)) return std::nullopt;
  return value;
}

// Records a value of a quantity that has none yet. False if there is no value or an earlier one.
template <class T>
bool TakeFirst(const std::optional<T>& value, const Assumption& what, const char* unit,
               const std::string& source, std::optional<T>* target, TableHead* head) {
  if (!value || *target) return false;
  *target = value;
  head->assumptions.emplace_back(fmt::format("{} {:.6g}{} taken from {}", what.sentence,
                                             static_cast<double>(*value), unit, source),
                                 what.about);
  return true;
}

// Records a value of a condition.
template <class T>
bool TakeFirst(const std::optional<T>& value, About about, const char* unit,
               const std::string& source, std::optional<T>* target, TableHead* head) {
  return TakeFirst(value, Assumption(ToText(about), about), unit, source, target, head);
}

// Keeps a stated Isc or Jsc for the unit of the current column. It does not count as understood,
// since the readings determine it better.
void NoteShortCircuit(const Statement& statement, const std::string& source, TableHead* head) {
  const bool named = statement.name == "isc" || statement.name == "jsc";
  if (!named || head->short_circuit || statement.value == 0) return;
  if (statement.unit.empty() && statement.name == "jsc") {
    const Unit* const usual = FindUnit(ColumnKind::kCurrentDensity, "macm2");
    head->short_circuit = {statement.value, usual->kind, usual->factor, source};
  }
  for (const ColumnKind kind : {ColumnKind::kCurrent, ColumnKind::kCurrentDensity}) {
    const Unit* unit = FindUnit(kind, statement.unit);
    if (unit == nullptr) continue;
    head->short_circuit = {statement.value, kind, unit->factor, source};
  }
}

}  // namespace

bool TakeStatement(const Statement& statement, const std::string& source, TableHead* head) {
  Sidecar* said = &head->said;
  NoteShortCircuit(statement, source, head);
  if (TakeFirst(AsCompliance(statement, said->notes.area_cm2), "compliance", " A", source,
                &said->notes.compliance_A, head)) {
    return true;
  }
  if (TakeFirst(AsStrings(statement), "strings in parallel", "", source, &said->strings_in_parallel,
                head)) {
    return true;
  }
  if (TakeFirst(AsBypassDiodes(statement), "bypass diodes", "", source, &said->notes.bypass_diodes,
                head)) {
    return true;
  }
  if (!NamesPowerOfLight(statement) && IsAboutOtherThings(statement)) return false;
  if (TakeFirst(AsIlluminance(statement), "illuminance", " lux", source,
                &said->notes.illuminance_lux, head)) {
    return true;
  }
  return TakeFirst(AsIrradiance(statement), About::kIrradiance, " W/m2", source,
                   &said->irradiance_W_m2, head) ||
         TakeFirst(AsTemperature(statement), About::kTemperature, " C", source,
                   &said->temperature_C, head) ||
         TakeFirst(AsCells(statement), About::kCells, "", source, &said->cells_in_series, head) ||
         TakeFirst(AsArea(statement), "area", " cm2", source, &said->notes.area_cm2, head);
}

Statement Understand(const std::vector<LabelWord>& words, double value, std::string_view unit) {
  Statement statement;
  statement.value = value;
  std::size_t end = words.size();
  if (unit.empty()) {
    for (std::size_t from = 1; from < words.size() && end == words.size(); ++from) {
      const std::string text = JoinWords(words, from, words.size());
      for (const ColumnKind kind :
           {ColumnKind::kIrradiance, ColumnKind::kTemperature, ColumnKind::kArea,
            ColumnKind::kCurrent, ColumnKind::kCurrentDensity}) {
        if (FindUnit(kind, text) != nullptr) end = from;
      }
      if (end == from) statement.unit = text;
    }
    for (std::size_t i = 0; i < end; ++i) {
      if (words[i].marked_as_unit) end = i;
    }
    if (statement.unit.empty()) statement.unit = JoinWords(words, end, words.size());
  } else {
    const std::vector<LabelWord> unit_words = SplitLabel(unit);
    statement.unit = JoinWords(unit_words, 0, unit_words.size());
    const auto marked = [](const LabelWord& word) { return word.marked_as_unit; };
    end = std::find_if(words.begin(), words.end(), marked) - words.begin();
  }
  statement.name = JoinWords(words, 0, end);
  for (std::size_t i = 0; i < end; ++i) statement.words.insert(words[i].text);
  return statement;
}

bool IsRoomLight(std::string_view text) {
  Statement statement;
  for (const LabelWord& word : SplitLabel(text)) statement.words.insert(word.text);
  const bool alone = statement.words.size() == 1;
  return HasAny(statement, {"room", "roomlight", "ambient", "indoor", "indoors", "office"}) &&
         (alone || HasAny(statement, {"light", "lights", "lighting", "lamp", "lamps", "led",
                                      "roomlight", "illumination", "fluorescent"}));
}

bool NamesLight(std::string_view label) {
  Statement statement;
  for (const LabelWord& word : SplitLabel(label)) statement.words.insert(word.text);
  return HasAny(statement, {"light", "lightsource", "illumination", "lamp", "illuminance",
                            "irradiance", "lighting"});
}

bool MayStateTemperature(std::string_view label) {
  Statement statement;
  bool named = false;
  for (const LabelWord& word : SplitLabel(label)) {
    named = named || word.text.find("temp") != std::string::npos;
    statement.words.insert(word.text);
  }
  return named && !IsAboutOtherThings(statement) && !HasAny(statement, {"room", "coeff"});
}

}  // namespace lyrefit

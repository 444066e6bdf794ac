#include "lyrefit/read/table_head.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/number_text.h"

namespace lyrefit {

bool HasAny(const Statement& statement, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return statement.words.count(word) != 0; });
}

std::string PlaceOf(const std::string& source) { return source.substr(0, source.find(" '")); }

namespace {

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

// Whether all words of the statement are among `words`.
bool HasOnly(const Statement& statement, const std::set<std::string>& words) {
  return std::includes(words.begin(), words.end(), statement.words.begin(), statement.words.end());
}

std::optional<int> AsCount(const Statement& statement, int most) {
  const bool whole = statement.value == std::floor(statement.value) && statement.value >= 1 &&
                     statement.value <= most;
  if (!whole || !statement.unit.empty()) return std::nullopt;
  return static_cast<int>(statement.value);
}

// Modules in series. One module alone has a number too, "Module number: 7".
std::optional<int> AsModules(const Statement& statement) {
  static const std::set<std::string> kWords = {"connected", "count", "in",  "module", "modules",
                                               "n",         "no",    "num", "number", "of",
                                               "nos",       "per",   "pv",  "series", "string"};
  const bool several = HasAny(statement, {"modules"});
  const bool counted = HasAny(statement, {"in", "of", "per"}) &&
                       HasAny(statement, {"series", "number", "string"}) &&
                       HasAny(statement, {"module"});
  if (!(several || counted) || !HasOnly(statement, kWords)) return std::nullopt;
  return AsCount(statement, 1000);
}

std::optional<int> AsCellsOfAModule(const Statement& statement) {
  static const std::set<std::string> kWords = {"a",  "cells", "in",  "module", "modules", "number",
                                               "of", "panel", "per", "pv",     "series",  "solar"};
  const bool named = HasAny(statement, {"cells"}) && HasAny(statement, {"per"}) &&
                     HasAny(statement, {"module", "panel"});
  if (!named || !HasOnly(statement, kWords)) return std::nullopt;
  return AsCount(statement, 1000);
}

std::optional<int> AsCells(const Statement& statement) {
  const bool count = HasAny(statement, {"number", "no", "num", "n", "count", "series", "in", "nr"});
  const bool named = statement.name == "cells" || statement.name == "ns" ||
                     statement.name == "ncells" || statement.name == "nscells" ||
                     (HasAny(statement, {"cells"}) && count);
  return named ? AsCount(statement, 10000) : std::nullopt;
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
  return named ? AsCount(statement, 10000) : std::nullopt;
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

// Rate of a sweep in V/s: "Scan rate: 50 mV/s", "scan_rate_V_s".
std::optional<double> AsScanRate(const Statement& statement) {
  for (const char* const name : {"scanrate", "sweeprate", "scanspeed", "sweepspeed"}) {
    const std::string& found = statement.name;
    if (found.rfind(name, 0) != 0) continue;
    std::string unit = found.substr(std::string_view(name).size());
    if (unit.empty()) unit = statement.unit;
    const bool volt = unit == "vs" || unit == "vs1" || unit == "vpers";
    const bool milli = unit == "mvs" || unit == "mvs1" || unit == "mvpers";
    if ((volt || milli) && statement.value != 0) {
      return std::fabs(statement.value) * (milli ? 1e-3 : 1);
    }
  }
  return std::nullopt;
}

// Hours of operation or of light before the sweep: "Time: 24 h", "Light soaking (min): 10". A time in
// seconds must say of what it is, since the settings of a sweep are times too.
std::optional<double> AsElapsedHours(const Statement& statement) {
  static const std::set<std::string> kOperation = {
      "ageing",        "ageingtime",    "agingtime", "lightsoaking", "lightsoakingtime",
      "operatingtime", "operationtime", "soaking",   "soakingtime",  "stresstime"};
  const std::string& unit = statement.unit;
  double hours = 0;
  for (const auto& [text, factor] :
       {std::pair("h", 1.0), std::pair("hr", 1.0), std::pair("hrs", 1.0), std::pair("hour", 1.0),
        std::pair("hours", 1.0), std::pair("min", 1.0 / 60), std::pair("minutes", 1.0 / 60),
        std::pair("d", 24.0), std::pair("day", 24.0), std::pair("days", 24.0),
        std::pair("s", 1.0 / 3600), std::pair("seconds", 1.0 / 3600)}) {
    const bool bare = unit.empty() && statement.name == text && statement.name.size() > 3;
    if (unit == text || (bare && factor >= 1)) hours = factor;
  }
  const bool operation = kOperation.count(statement.name) != 0;
  const bool plain = statement.name == "time" || statement.name == "elapsedtime" || unit.empty();
  if (hours == 0 || !(operation || (plain && hours > 1e-3)) || !(statement.value >= 0)) {
    return std::nullopt;
  }
  return statement.value * hours;
}

// Records a value of a quantity that has none yet. False if there is no value or an earlier one.
template <class T>
bool TakeFirst(const std::optional<T>& value, const Assumption& what, const char* unit,
               const std::string& source, std::optional<T>* target, TableHead* head,
               std::string* stated_in = nullptr) {
  if (!value || *target) return false;
  *target = value;
  if (stated_in != nullptr) *stated_in = PlaceOf(source);
  head->assumptions.emplace_back(fmt::format("{} {:.6g}{} taken from {}", what.sentence,
                                             static_cast<double>(*value), unit, source),
                                 what.about);
  return true;
}

// Records a value of a condition.
template <class T>
bool TakeFirst(const std::optional<T>& value, About about, const char* unit,
               const std::string& source, std::optional<T>* target, TableHead* head,
               std::string* stated_in) {
  return TakeFirst(value, Assumption(ToText(about), about), unit, source, target, head, stated_in);
}

// Cells in series of modules and their cells. A number of cells too small for so many modules is that
// of one module.
void SettleModules(TableHead* head) {
  constexpr int kLeastOfAModule = 10;
  Sidecar* said = &head->said;
  const std::optional<int>& modules = said->notes.modules_in_series;
  std::optional<int>& cells = said->cells_in_series;
  std::optional<int>& of_module = head->module_cells;
  if (!of_module && modules && cells && *cells < kLeastOfAModule * *modules) {
    of_module = std::exchange(cells, std::nullopt);
    head->module_cells_in = said->stated_in.cells;
  }
  if (!of_module || (cells && said->stated_in.cells != head->module_cells_in)) return;
  cells = modules.value_or(1) * *of_module;
  said->stated_in.cells = head->module_cells_in;
  Forget(About::kCells, &head->assumptions);
  head->assumptions.emplace_back(fmt::format("cells in series {}: {} of {} taken from {}", *cells,
                                             Plural(modules.value_or(1), "module"),
                                             Plural(*of_module, "cell"), head->module_cells_in),
                                 About::kCells);
}

bool TakeModules(const Statement& statement, const std::string& source, TableHead* head) {
  std::optional<int>& modules = head->said.notes.modules_in_series;
  const bool taken =
      TakeFirst(AsModules(statement), "modules in series", "", source, &modules, head) ||
      TakeFirst(AsCellsOfAModule(statement), "cells of a module", "", source, &head->module_cells,
                head, &head->module_cells_in);
  if (taken) SettleModules(head);
  return taken;
}

bool TakeCells(const Statement& statement, const std::string& source, TableHead* head) {
  Sidecar* said = &head->said;
  if (!TakeFirst(AsCells(statement), About::kCells, "", source, &said->cells_in_series, head,
                 &said->stated_in.cells)) {
    return false;
  }
  SettleModules(head);
  return true;
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
  ConditionSources* in = &said->stated_in;
  if (TakeFirst(AsBypassDiodes(statement), About::kBypassDiodes, "", source,
                &said->notes.bypass_diodes, head, &in->bypass_diodes)) {
    return true;
  }
  if (TakeFirst(AsScanRate(statement), "scan rate", " V/s", source, &said->notes.scan_rate_V_s,
                head) ||
      TakeFirst(AsElapsedHours(statement), "time before the sweep", " h", source,
                &said->notes.elapsed_h, head)) {
    return true;
  }
  if (TakeModules(statement, source, head)) return true;
  if (!NamesPowerOfLight(statement) && IsAboutOtherThings(statement)) return false;
  if (TakeFirst(AsIlluminance(statement), "illuminance", " lux", source,
                &said->notes.illuminance_lux, head)) {
    return true;
  }
  return TakeFirst(AsIrradiance(statement), About::kIrradiance, " W/m2", source,
                   &said->irradiance_W_m2, head, &in->irradiance) ||
         TakeFirst(AsTemperature(statement), About::kTemperature, " C", source,
                   &said->temperature_C, head, &in->temperature) ||
         TakeCells(statement, source, head) ||
         TakeFirst(AsArea(statement), "area", " cm2", source, &said->notes.area_cm2, head);
}

bool TakeTemperatureBesideLight(const Statement& statement, const std::string& source,
                                TableHead* head) {
  const auto value = Converted(statement, ColumnKind::kTemperature);
  const bool beside = head->said.stated_in.irradiance == PlaceOf(source);
  if (!beside || !IsBareTemperature(statement) || !(*value >= -100 && *value <= 150)) return false;
  return TakeFirst(value, About::kTemperature, " C", source, &head->said.temperature_C, head,
                   &head->said.stated_in.temperature);
}

bool IsBareTemperature(const Statement& statement) {
  return statement.name == "t" && Converted(statement, ColumnKind::kTemperature).has_value();
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

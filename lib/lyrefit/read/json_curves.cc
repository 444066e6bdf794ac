#include "lyrefit/read/json_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "lyrefit/base/median.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/plausibility.h"
#include "lyrefit/curve/sweep_order.h"
#include "lyrefit/read/join_sweeps.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/read/label.h"
#include "lyrefit/read/records.h"
#include "lyrefit/read/rewrite_table.h"
#include "lyrefit/read/stated_results.h"
#include "lyrefit/read/table_columns.h"
#include "lyrefit/read/table_head.h"

namespace lyrefit {
namespace {

using nlohmann::json;

bool IsScalar(const json& value) {
  return value.is_number() || value.is_null() || value.is_string();
}

// Adds the units of NOMAD's schema to names that state none.
std::string LabelInNomad(const std::string& key) {
  if (key == "active_area") return key + " [cm2]";
  if (key == "light_intensity" || key == "intensity") return key + " [mW/cm2]";
  return key;
}

void AddValue(const json& value, Record* list) {
  if (value.is_number() && std::fabs(value.get<double>()) < kOverflowCode) {
    return list->values.push_back(value.get<double>());
  }
  const bool text = value.is_string();
  AddReading(text ? value.get_ref<const std::string&>() : OneLine(value), false, 0, list);
}

void AddList(const std::string& name, const json& values, Records* records) {
  records->lists.emplace_back();
  records->lists.back().name = name;
  for (const json& value : values) AddValue(value, &records->lists.back());
}

// Lists under names, {"v": [...], "i": [...]}. Lists may also be {"0": ..., "1": ...}, as pandas
// writes columns.
Records FromLists(const json& object) {
  Records records;
  for (const auto& [key, value] : object.items()) {
    const bool list = value.is_structured() && value.size() >= 2 &&
                      std::all_of(value.begin(), value.end(), IsScalar);
    if (list) AddList(key, value, &records);
  }
  return records;
}

// Objects, [{"v": 0, "i": 1}, ...], or {"0": {"v": 0, "i": 1}, ...}, as pandas writes rows.
Records FromObjects(const json& objects) {
  Records records;
  if (objects.size() < 2 || !objects.begin()->is_object()) return records;
  const bool all = std::all_of(objects.begin(), objects.end(),
                               [](const json& object) { return object.is_object(); });
  if (!all) return records;
  for (const auto& [key, value] : objects.begin()->items()) {
    if (!IsScalar(value)) continue;
    records.lists.emplace_back();
    records.lists.back().name = key;
    for (const json& object : objects) {
      const auto found = object.find(key);
      AddValue(found == object.end() ? json() : *found, &records.lists.back());
    }
  }
  return records;
}

// Split tables of pandas, {"columns": ["v", "i"], "data": [[0, 1], ...]}.
Records FromSplit(const json& object) {
  Records records;
  const auto names = object.find("columns");
  const auto data = object.find("data");
  if (names == object.end() || data == object.end()) return records;
  if (!names->is_array() || !data->is_array()) return records;
  for (const json& name : *names) {
    if (!name.is_string()) return {};
    records.lists.emplace_back();
    records.lists.back().name = name.get<std::string>();
  }
  for (const json& row : *data) {
    if (!row.is_array() || row.size() != records.lists.size()) return {};
    for (std::size_t i = 0; i < row.size(); ++i) AddValue(row[i], &records.lists[i]);
  }
  return records;
}

// Named lists, [{"row_name": "Voltage(V)", "data": [0, 1]}, ...], as PV_circuit_model writes them.
Records FromNamedLists(const json& lists) {
  Records records;
  for (const json& item : lists) {
    if (!item.is_object()) return {};
    const std::string* name = nullptr;
    const json* values = nullptr;
    for (const json& member : item) {
      if (member.is_string() && name == nullptr) name = &member.get_ref<const std::string&>();
      if (member.is_array()) values = values == nullptr ? &member : nullptr;
    }
    const bool list = name != nullptr && values != nullptr &&
                      std::all_of(values->begin(), values->end(), IsScalar);
    if (!list) return {};
    AddList(*name, *values, &records);
  }
  return records;
}

// Pairs of voltage and current, [[0, 8.5], [10, 8.4], ...].
Records FromPairs(const json& pairs) {
  constexpr std::size_t kFewest = 5;
  Records records;
  records.lists.resize(2);
  records.lists[0].name = "V";
  records.lists[1].name = "I";
  if (pairs.size() < kFewest) return {};
  for (const json& pair : pairs) {
    if (!pair.is_array() || pair.size() != 2) return {};
    for (std::size_t i = 0; i < 2; ++i) {
      if (!pair[i].is_number()) return {};
      AddValue(pair[i], &records.lists[i]);
    }
  }
  return records;
}

// The curves found so far in a document.
struct FoundCurves {
  const std::string& path;
  const ReadOptions& options;
  std::vector<RawCurve> curves;
  std::vector<SweepDirection> directions;  // of each curve, as its object states it
  std::vector<RejectedCurve> rejected;
  std::set<std::string> ids;
};

// An object on the way to a curve, and what the objects around it state.
struct Surroundings {
  std::string id;
  Sidecar stated;
  SweepDirection direction = SweepDirection::kUnknown;
  bool nomad = false;
  std::map<ColumnKind, double> scales = {};  // of voltages and currents: "voltage_scale": 0.1
  std::vector<StatedResult> results = {};    // that the innermost object with results states
};

// A flat list of registers with the scan of an inverter.
Records FromRegisters(const json& list) {
  std::vector<double> registers;
  for (const json& item : list) {
    if (!item.is_number_integer()) return {};
    registers.push_back(item.get<double>());
  }
  const auto scan = AsRegisterScan(registers);
  if (!scan) return {};
  Records records;
  records.setup = Setup::kInverter;
  records.lists.resize(1 + scan->currents.size());
  records.lists[0].name = "voltage";
  records.lists[0].values = scan->voltages;
  for (std::size_t i = 0; i < scan->currents.size(); ++i) {
    records.lists[i + 1].name = fmt::format("PV{} current", i + 1);
    records.lists[i + 1].values = scan->currents[i];
  }
  records.assumptions.emplace_back(
      "a list of registers, taken apart into voltages, which rise or fall all the way, and "
      "currents");
  return records;
}

std::vector<Records> RecordsOf(const json& node) {
  if (node.is_array()) {
    return {FromObjects(node), FromNamedLists(node), FromPairs(node), FromRegisters(node)};
  }
  if (node.is_object()) return {FromLists(node), FromSplit(node), FromObjects(node)};
  return {};
}

std::string TextOf(const json& node, const char* key) {
  const auto found = node.is_object() ? node.find(key) : node.end();
  return found != node.end() && found->is_string() ? found->get<std::string>() : "";
}

// The curve's name in the document, or else `otherwise`. A sweep of one direction is named by its
// sample and cell, without the direction: "a_for" of NOMAD is "a".
std::string NameOf(const json& node, const std::string& otherwise) {
  const std::string cell = TextOf(node, "cell_name");
  const ColumnTag tag = ReadTag(cell);
  if (tag.direction != SweepDirection::kUnknown && !tag.device.empty()) return tag.device;
  for (const std::string& name : {cell, TextOf(node, "name"), TextOf(node, "id")}) {
    if (!name.empty()) return name;
  }
  if (TextOf(node, "direction").empty()) return otherwise;
  std::string name;
  for (const char* key : {"sample", "sample_name", "pixel", "pin", "cell"}) {
    const std::string part = TextOf(node, key);
    if (!part.empty()) name += (name.empty() ? "" : " ") + part;
  }
  return name.empty() ? otherwise : name;
}

Sidecar StatedNumbers(const json& object, const std::string& id, bool nomad) {
  TableHead head;
  for (const auto& [key, value] : object.items()) {
    const auto number = value.is_structured() ? std::nullopt : NumberOrText(value);
    if (!number) continue;
    const std::string label = nomad ? LabelInNomad(key) : key;
    TakeStatement(label, *number, Quoted(MemberId(id, key)), &head);
  }
  head.said.assumptions = HeadSentences(head);
  return head.said;
}

// What the scalars of an object, and of objects of scalars in it, state.
Sidecar StatedIn(const json& object, const Surroundings& around) {
  Sidecar stated;
  for (const auto& [key, value] : object.items()) {
    if (!HoldsScalarsOnly(value)) continue;
    stated = Merge(std::move(stated), StatedNumbers(value, MemberId(around.id, key), around.nomad));
  }
  return Merge(std::move(stated), StatedNumbers(object, around.id, around.nomad));
}

// Sets the unit of a current that names none from a current density beside it. With the area of the
// cell, their ratio is that of ampere, milliampere or microampere.
void TakeUnitOfDensity(const Records& records, const Sidecar& around, const ReadOptions& options,
                       int current, std::vector<Column>* columns) {
  constexpr double kAgrees = 0.01;
  Column& column = (*columns)[current];
  const std::optional<double> area = options.area_cm2 ? options.area_cm2 : around.notes.area_cm2;
  const auto density = std::find_if(columns->begin(), columns->end(), [](const Column& other) {
    return other.kind == ColumnKind::kCurrentDensity && other.refusal.empty();
  });
  if (!column.unit.empty() || column.kind != ColumnKind::kCurrent || !area) return;
  if (density == columns->end()) return;
  const auto& densities = records.lists[density - columns->begin()].values;
  const auto& currents = records.lists[current].values;
  std::vector<double> ratios;
  for (std::size_t i = 0; i < currents.size() && i < densities.size(); ++i) {
    const double ratio = densities[i] * density->factor * *area / currents[i];
    if (std::isfinite(ratio)) ratios.push_back(ratio);
  }
  if (ratios.empty()) return;
  const double ratio = UpperMedian(ratios);
  for (const char* name : {"a", "ma", "ua"}) {
    const Unit* unit = FindUnit(ColumnKind::kCurrent, name);
    if (std::fabs(ratio / unit->factor - 1) > kAgrees) continue;
    column.unit = unit->text;
    column.factor = unit->factor;
  }
}

std::string UniqueId(FoundCurves* found, const std::string& id) {
  std::string unique = id;
  for (int i = 2; !found->ids.insert(unique).second; ++i) unique = fmt::format("{} ({})", id, i);
  return unique;
}

// Adds a curve in generator sign.
void TakeCurve(FoundCurves* found, RawCurve raw, const std::string& id,
               const Surroundings& around) {
  const bool again = around.direction != SweepDirection::kUnknown;
  raw.curve.name = again ? id : UniqueId(found, id);
  raw.curve.source = found->path;
  raw.curve.stated = around.results;
  TurnLoadSign(&raw.curve);
  found->curves.push_back(std::move(raw));
  found->directions.push_back(around.direction);
}

// Adds the curve of a Suns-Voc trace. False if the records are none.
Expected<bool> TakeSunsVoc(FoundCurves* found, const Records& records, std::vector<Column> columns,
                           const Surroundings& around) {
  std::vector<std::string> names;
  for (const Record& list : records.lists) names.push_back(list.name);
  const auto trace = FindSunsVoc(names);
  if (!trace) return false;
  for (Column& column : columns) column.kind = ColumnKind::kUnrecognised;
  columns[trace->voltage].factor = trace->voltage_factor;
  columns[trace->light].factor = 1;
  for (const int place : {trace->voltage, trace->light}) columns[place].unit = "stated";
  TRY(RawCurve raw, CurveOfRecords(records, columns, {trace->voltage, trace->light}, found->options,
                                   {found->path}));
  raw.stated = around.stated;
  const auto current = LightToCurrent(*trace, found->options.isc_A, &raw.curve);
  if (!current) return Fail(current.error().message, found->path);
  TakeCurve(found, std::move(raw), around.id, around);
  return true;
}

// Takes the scales that an object states for voltages and currents, and says so.
void TakeScales(const json& object, Surroundings* around) {
  for (const auto& [key, value] : object.items()) {
    const auto number = value.is_structured() ? std::nullopt : NumberOrText(value);
    if (!number) continue;
    const Column column = RecogniseColumn(fmt::format("{} {:g}", key, *number));
    if (!IsElectrical(column.kind) || !column.refusal.empty() || column.factor >= 1) continue;
    around->scales[column.kind] = column.factor;
    around->stated.assumptions.push_back(
        fmt::format("readings multiplied by {:g}, since the file states {} {:g}", column.factor,
                    Quoted(key), *number));
  }
}

void ApplyScales(const std::map<ColumnKind, double>& scales, std::vector<Column>* columns) {
  for (Column& column : *columns) {
    const auto scale = scales.find(column.kind);
    if (scale == scales.end() || column.factor != 1) continue;
    column.factor = scale->second;
    if (column.unit.empty()) column.unit = column.kind == ColumnKind::kVoltage ? "v" : "a";
  }
}

// Adds the curves of records. False if they have no pair of voltage and current.
Expected<bool> TakeRecords(FoundCurves* found, const Records& records, const Surroundings& around) {
  std::vector<Column> columns;
  for (const Record& list : records.lists) columns.push_back(RecogniseColumn(list.name));
  ApplyColumnWishes(found->options, &columns);
  ApplyScales(around.scales, &columns);
  const std::vector<Channel> channels = FindChannels(columns);
  if (channels.empty()) return TakeSunsVoc(found, records, columns, around);
  std::vector<Channel> chosen = channels;
  if (!found->options.column.empty()) {
    const Expected<Channel> one = ChooseChannel(columns, channels, found->options.column);
    if (!one) return Fail(one.error().message, found->path);
    chosen = {*one};
  }
  for (const Channel& channel : chosen) {
    TRY(ApplyUnitWishes(found->options, channel, &columns));
    TakeUnitOfDensity(records, around.stated, found->options, channel.current, &columns);
    const std::string own = MemberId(around.id, ChannelName(columns, channel));
    const std::string& id = channels.size() > 1 ? own : around.id;
    auto raw = CurveOfRecords(records, columns, channel, found->options, {found->path});
    if (!raw) {
      found->rejected.push_back({UniqueId(found, id), raw.error()});
      continue;
    }
    raw->stated = Merge(std::move(raw->stated), around.stated);
    TakeSetup(records.setup, "the layout of the file", &raw->stated);
    // Documents without units are taken in V and A, with a sentence but without the doubts about
    // unit and size that tables get, unless they hold whole numbers, as registers do.
    IvCurve& curve = raw->curve;
    curve.voltage_unit_known = curve.voltage_unit_known || !AreWholeNumbers(curve.voltage_V);
    curve.current_unit_known = curve.current_unit_known || !AreWholeNumbers(curve.current_A);
    TakeCurve(found, std::move(*raw), id, around);
  }
  return true;
}

Expected<void> FindCurvesIn(FoundCurves* found, const json& node, Surroundings around) {
  if (node.is_object()) {
    around.nomad = around.nomad || node.contains("jv_curve");
    around.stated = Merge(StatedIn(node, around), around.stated);
    if (around.nomad) TakeSetup(Setup::kLaboratory, "the format of the file", &around.stated);
    TakeScales(node, &around);
    if (auto results = ResultsIn(node, around.id); !results.empty()) around.results = results;
    SweepDirection direction = ReadTag(TextOf(node, "direction")).direction;
    if (direction == SweepDirection::kUnknown) {
      direction = ReadTag(TextOf(node, "cell_name")).direction;
    }
    if (direction != SweepDirection::kUnknown) around.direction = direction;
  }
  for (const Records& records : RecordsOf(node)) {
    TRY(const bool taken, TakeRecords(found, records, around));
    if (taken) return {};
  }
  if (!node.is_structured()) return {};
  const std::string id = around.id;
  std::size_t place = 0;
  for (auto item = node.begin(); item != node.end(); ++item, ++place) {
    if (!item->is_structured()) continue;
    const std::string key = node.is_object() ? item.key() : std::to_string(place);
    // The readings of one direction stand below the object that names it.
    const bool named = around.direction != SweepDirection::kUnknown && node.is_object();
    around.id = named ? id : NameOf(*item, MemberId(id, key));
    TRY(FindCurvesIn(found, *item, around));
  }
  return {};
}

// Joins curves of one name and opposite directions to one curve of several sweeps.
std::vector<RawCurve> JoinDirections(FoundCurves* found) {
  std::vector<RawCurve> joined;
  std::vector<std::set<SweepDirection>> taken;
  for (std::size_t i = 0; i < found->curves.size(); ++i) {
    RawCurve& raw = found->curves[i];
    const SweepDirection direction = found->directions[i];
    GiveDirection(direction, &raw.curve);
    std::size_t k = 0;
    while (k < joined.size() &&
           (joined[k].curve.name != raw.curve.name || taken[k].count(direction) != 0 ||
            taken[k].count(SweepDirection::kUnknown) != 0)) {
      ++k;
    }
    if (direction == SweepDirection::kUnknown || k == joined.size()) {
      if (direction != SweepDirection::kUnknown) raw.curve.name = UniqueId(found, raw.curve.name);
      joined.push_back(std::move(raw));
      taken.push_back({direction});
      continue;
    }
    AppendSweep(raw.curve, &joined[k].curve);
    taken[k].insert(direction);
    joined[k].curve.assumptions.push_back(fmt::format(
        "{} sweeps up and down at the same conditions read as one curve", taken[k].size()));
  }
  return joined;
}

}  // namespace

Expected<JsonCurves> FindJsonCurves(const json& document, const std::string& path,
                                    const ReadOptions& options) {
  FoundCurves found{path, options, {}, {}, {}, {}};
  Surroundings around;
  if (IsReport(document)) around.stated = ReportedConditions(document, path).value_or(Sidecar{});
  TRY(FindCurvesIn(&found, document, around));
  if (found.curves.empty() && !found.rejected.empty()) {
    return tl::unexpected(found.rejected.front().error);
  }
  if (found.curves.empty()) {
    return Fail(
        "expected an ivcurves file (a JSON object with the key \"IV Curves\") or lists of numbers "
        "under names of a voltage and a current, such as \"voltage_V\" and \"current_A\"",
        path);
  }
  return JsonCurves{JoinDirections(&found), std::move(found.rejected)};
}

}  // namespace lyrefit

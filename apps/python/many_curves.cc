#include "many_curves.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "curves.h"
#include "lyrefit/read/bare_curve.h"
#include "lyrefit/stream/batch_source.h"
#include "work.h"

namespace lyrefit::python {
namespace {

struct Condition {
  const char* keyword;
  Column column;
};
constexpr Condition kConditions[] = {{"cells_in_series", Column::kCells},
                                     {"temperature_C", Column::kTemperature},
                                     {"irradiance_Wm2", Column::kIrradiance}};

// Values of a condition: one for each curve, or one for all.
struct Told {
  const char* keyword;
  std::optional<double> common;
  std::vector<double> each;
};

struct Said {
  CurveKeywords common;  // without the values given for each curve
  std::vector<Told> told;
  std::vector<std::string> ids;
  py::object group = py::none();

  CurveKeywords Of(std::size_t i) const;
  std::string IdOf(std::size_t i) const { return i < ids.size() ? ids[i] : std::to_string(i); }
  bool Tells(std::string_view keyword) const;
  void CheckCount(std::size_t curves) const;
};

void Tell(const char* keyword, double value, ConditionOptions* told) {
  const std::string_view name(keyword);
  if (!std::isfinite(value)) return;  // unknown for this curve
  if (name == "cells_in_series") told->cells = static_cast<int>(value);
  if (name == "temperature_C") told->temperature_C = value;
  if (name == "irradiance_Wm2") told->irradiance_W_m2 = value;
}

CurveKeywords Said::Of(std::size_t i) const {
  CurveKeywords said = common;
  for (const Told& condition : told) {
    if (condition.common) Tell(condition.keyword, *condition.common, &said.told);
    if (!condition.each.empty()) Tell(condition.keyword, condition.each[i], &said.told);
  }
  return said;
}

bool Said::Tells(std::string_view keyword) const {
  return std::any_of(told.begin(), told.end(),
                     [keyword](const Told& one) { return one.keyword == keyword; });
}

void Said::CheckCount(std::size_t curves) const {
  const auto check = [curves](const std::string& keyword, std::size_t count) {
    if (count == 0 || count == curves) return;
    Raise({keyword + ": expected one for each of " + std::to_string(curves) + " curves, found " +
               std::to_string(count),
           {}});
  };
  check("ids", ids.size());
  for (const Told& condition : told) check(condition.keyword, condition.each.size());
}

Said ReadSaid(Keywords* keywords) {
  Said said;
  for (const auto& [keyword, column] : kConditions) {
    const auto value = keywords->Take(keyword);
    if (!value) continue;
    Told told{keyword, {}, {}};
    if (py::hasattr(*value, "__len__") && !IsPath(*value)) {
      told.each = NumbersOf(keyword, *value);
    } else {
      told.common = NumberOf(keyword, *value);
    }
    said.told.push_back(std::move(told));
  }
  if (const auto ids = keywords->Take("ids")) {
    for (const py::handle id : *ids) said.ids.push_back(py::str(id).cast<std::string>());
  }
  if (const auto group = keywords->Take("group")) said.group = *group;
  said.common = ReadCurveKeywords(keywords);
  return said;
}

// Converts lyrefit errors to a value, so that one bad curve does not stop the others.
template <class Function>
auto Caught(Function&& function) -> Expected<decltype(function())> {
  try {
    return function();
  } catch (py::error_already_set& error) {
    return tl::unexpected(ErrorOf(error));
  }
}

CurveToFit Ready(std::string id, std::string file, Expected<IvCurve> curve) {
  auto kept = std::make_shared<const Expected<IvCurve>>(std::move(curve));
  return {std::move(id), std::move(file), [kept] { return *kept; }};
}

CurveToFit OneOf(py::handle curve, std::string id, const CurveKeywords& said) {
  if (!IsPath(curve)) {
    Expected<IvCurve> taken = Caught([&] { return CurveOf(curve, py::none(), said); });
    const std::string file = taken ? taken->source : std::string();
    return Ready(std::move(id), file, std::move(taken));
  }
  std::string path = TextOf("curve", curve);
  const auto read = [path, said]() -> Expected<IvCurve> {
    Expected<IvCurve> taken = ReadCurve(path, said.reading);
    if (!taken) return taken;
    const Expected<void> applied = ApplyConditions(said.told, &*taken);
    if (!applied) return tl::unexpected(applied.error());
    return taken;
  };
  return {std::move(id), path, read};
}

std::vector<CurveToFit> FromList(py::handle curves, const Said& said) {
  std::vector<CurveToFit> list;
  std::vector<py::object> members;
  for (const py::handle curve : curves) {
    members.push_back(py::reinterpret_borrow<py::object>(curve));
  }
  said.CheckCount(members.size());
  for (std::size_t i = 0; i < members.size(); ++i) {
    const py::object& curve = members[i];
    std::string id = said.IdOf(i);
    if (said.ids.empty() && IsPath(curve)) id = TextOf("curve", curve);
    if (said.ids.empty() && py::isinstance<IvCurve>(curve)) id = curve.cast<IvCurve&>().name;
    CurveKeywords own = said.Of(i);
    if (!IsPath(curve) && !py::isinstance<IvCurve>(curve)) own.name = id;
    list.push_back(OneOf(curve, std::move(id), own));
  }
  return list;
}

std::vector<CurveToFit> FromMapping(py::handle curves, Said said) {
  py::list values;
  for (const auto& [id, curve] : py::reinterpret_borrow<py::dict>(curves)) {
    said.ids.push_back(py::str(id).cast<std::string>());
    values.append(curve);
  }
  return FromList(values, said);
}

py::array_t<double, py::array::c_style | py::array::forcecast> Rows(const char* name,
                                                                    py::handle values) {
  auto rows = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(values);
  if (!rows) PyErr_Clear();
  if (rows && (rows.ndim() == 1 || rows.ndim() == 2)) return rows;
  Raise({std::string(name) + ": expected an array of shape (m, n), a curve a row", {}});
}

// A curve from readings, optionally without the NaNs that pad them.
CurveToFit FromValues(std::vector<double> voltage_V, std::vector<double> current_A,
                      bool without_nan, const Said& said, std::size_t i) {
  if (without_nan) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < voltage_V.size(); ++k) {
      if (std::isnan(voltage_V[k]) || std::isnan(current_A[k])) continue;
      voltage_V[kept] = voltage_V[k];
      current_A[kept++] = current_A[k];
    }
    voltage_V.resize(kept);
    current_A.resize(kept);
  }
  IvCurve columns;
  columns.name = said.IdOf(i);
  columns.voltage_V = std::move(voltage_V);
  columns.current_A = std::move(current_A);
  IvCurve curve = BareCurve(std::move(columns));
  Expected<IvCurve> told = Caught([&] {
    ApplyTold(said.Of(i).told, &curve);
    return std::move(curve);
  });
  return Ready(said.IdOf(i), "", std::move(told));
}

std::vector<CurveToFit> FromArrays(py::handle voltages, py::handle currents, const Said& said) {
  const auto v = Rows("voltage", voltages);
  const auto i = Rows("current", currents);
  const bool common = v.ndim() == 1;
  const bool fits =
      i.ndim() == 2 && v.shape(v.ndim() - 1) == i.shape(1) && (common || v.shape(0) == i.shape(0));
  if (!fits) {
    Raise({"expected voltage of shape (m, n) or (n,) and current of shape (m, n), found " +
               py::str(v.attr("shape")).cast<std::string>() + " and " +
               py::str(i.attr("shape")).cast<std::string>(),
           {}});
  }
  const auto curves = static_cast<std::size_t>(i.shape(0));
  const auto points = static_cast<std::size_t>(i.shape(1));
  said.CheckCount(curves);
  std::vector<CurveToFit> list;
  for (std::size_t row = 0; row < curves; ++row) {
    const double* voltage = v.data() + (common ? 0 : row * points);
    const double* current = i.data() + row * points;
    list.push_back(
        FromValues({voltage, voltage + points}, {current, current + points}, true, said, row));
  }
  return list;
}

// The column, or list of columns, that names the curve of each row.
py::object GroupColumn(py::handle frame, const Said& said) {
  const py::object columns = frame.attr("columns");
  if (said.group.is_none()) {
    const py::object usual = ColumnOf(frame, Column::kCurve);
    if (!usual.is_none()) return usual.attr("name");
  } else {
    const bool several = py::isinstance<py::list>(said.group);
    const py::list named = several ? said.group : py::object(py::list(py::make_tuple(said.group)));
    const bool known = std::all_of(named.begin(), named.end(),
                                   [&](py::handle name) { return columns.contains(name); });
    if (known) return said.group;
  }
  Raise({"group: expected the column that names the curve of each row, found " +
             py::str(py::list(columns)).cast<std::string>(),
         {}});
}

// Rows of each curve in a long frame, in the order in which the curves appear.
struct Groups {
  std::vector<std::string> ids;
  std::vector<std::vector<std::size_t>> rows;
};

Groups GroupsOf(py::handle frame, const py::object& group) {
  const py::object place_of =
      frame.attr("groupby")(group, py::arg("sort") = false, py::arg("observed") = true)
          .attr("ngroup")()
          .attr("to_numpy")();
  const py::object named = frame[group];
  const bool several = py::hasattr(named, "columns");
  Groups groups;
  std::unordered_map<std::int64_t, std::size_t> curve_at;  // index by first appearance
  std::size_t row = 0;
  for (const std::int64_t place : place_of.cast<std::vector<std::int64_t>>()) {
    if (place < 0) Raise({"group: row " + std::to_string(row) + " names no curve", {}});
    const auto [curve, is_new] = curve_at.insert({place, groups.rows.size()});
    if (is_new) groups.rows.emplace_back();
    groups.rows[curve->second].push_back(row++);
  }
  for (const std::vector<std::size_t>& rows : groups.rows) {
    const py::object name = named.attr("iloc")[py::int_(rows.front())];
    std::string id;
    if (!several) id = py::str(name).cast<std::string>();
    for (const py::handle part : several ? py::list(name) : py::list()) {
      id += (id.empty() ? "" : "/") + py::str(part).cast<std::string>();
    }
    groups.ids.push_back(std::move(id));
  }
  return groups;
}

// The mean of each curve's rows; exact if all are equal.
std::vector<double> MeanOfEach(const Groups& groups, const std::vector<double>& values) {
  std::vector<double> means;
  for (const std::vector<std::size_t>& rows : groups.rows) {
    const double first = values[rows.front()];
    double beyond = 0;
    for (const std::size_t row : rows) beyond += values[row] - first;
    means.push_back(first + beyond / static_cast<double>(rows.size()));
  }
  return means;
}

std::vector<double> Picked(const std::vector<double>& values,
                           const std::vector<std::size_t>& rows) {
  std::vector<double> picked;
  picked.reserve(rows.size());
  for (const std::size_t row : rows) picked.push_back(values[row]);
  return picked;
}

std::vector<CurveToFit> FromFrame(py::handle frame, Said said) {
  const Groups groups = GroupsOf(frame, GroupColumn(frame, said));
  said.CheckCount(groups.ids.size());
  if (said.ids.empty()) said.ids = groups.ids;
  for (const auto& [keyword, column] : kConditions) {
    const py::object values = ColumnOf(frame, column);
    if (said.Tells(keyword) || values.is_none()) continue;
    said.told.push_back({keyword, {}, MeanOfEach(groups, NumbersOf(keyword, values))});
  }
  const IvCurve all = ReadingsOf(frame);
  std::vector<CurveToFit> list;
  for (std::size_t i = 0; i < groups.rows.size(); ++i) {
    const std::vector<std::size_t>& rows = groups.rows[i];
    list.push_back(FromValues(Picked(all.voltage_V, rows), Picked(all.current_A, rows),
                              said.common.reading.skip_missing, said, i));
  }
  return list;
}

// Reads a folder or file with many curves, as the command's batch does.
std::vector<CurveToFit> FromBatch(py::handle path, const Said& said) {
  BatchReadOptions options;
  options.reading = said.common.reading;
  const std::string file = TextOf("curves", path);
  auto opened = Must(Unlocked([&] { return OpenBatch({file}, options); }));
  const std::shared_ptr<BatchSource> source = std::move(opened);
  std::vector<CurveToFit> list;
  const ConditionOptions told = said.Of(0).told;
  while (auto item = Must(Unlocked([&] { return source->Next(); }))) {
    const auto kept = std::make_shared<const BatchItem>(*std::move(item));
    list.push_back({kept->id, "", [source, kept, told]() -> Expected<IvCurve> {
                      BatchCurve read = source->Read(*kept);
                      if (!read.curve) return std::move(read.curve);
                      const Expected<void> applied = ApplyConditions(told, &*read.curve);
                      if (!applied) return tl::unexpected(applied.error());
                      return std::move(read.curve);
                    }});
  }
  return list;
}

}  // namespace

std::vector<CurveToFit> TakeManyCurves(py::handle curves, py::handle current, Keywords* keywords) {
  const Said said = ReadSaid(keywords);
  if (!current.is_none()) return FromArrays(curves, current, said);
  if (IsPath(curves)) return FromBatch(curves, said);
  if (IsFrame(curves)) return FromFrame(curves, said);
  if (IsGroupBy(curves)) return FromMapping(FramesOf(curves), said);
  if (py::isinstance<py::dict>(curves)) return FromMapping(curves, said);
  if (!py::hasattr(curves, "__iter__")) {
    Raise({"curves: expected a list or mapping of curves, arrays, a DataFrame or a path", {}});
  }
  return FromList(curves, said);
}

void AppendManyNotes(std::vector<KeywordNote>* notes) {
  notes->push_back({"threads", "int", "0", "", "0: all cores; never changes a result"});
  notes->push_back({"group", "str | Sequence[str]", "None", "", ""});
  notes->push_back({"ids", "Sequence[str]", "None", "", ""});
  notes->push_back({"cells_in_series", "int | ArrayLike", "None", "", ""});
  notes->push_back({"temperature_C", "float | ArrayLike", "None", "", ""});
  notes->push_back({"irradiance_Wm2", "float | ArrayLike", "None", "", ""});
}

}  // namespace lyrefit::python

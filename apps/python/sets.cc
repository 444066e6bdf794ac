#include "sets.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/read/read_curve_set.h"
#include "work.h"

namespace lyrefit::python {
namespace {

bool IsList(py::handle value) {
  return py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value);
}
bool IsArray(py::handle value) {
  return IsList(value) || py::isinstance<py::array>(value) || py::hasattr(value, "iloc");
}

// Whether `value` can be one curve of a list.
bool IsCurve(py::handle value) {
  if (py::isinstance<IvCurve>(value) || IsPath(value) || IsTable(value)) return true;
  if (py::isinstance<py::array>(value)) return py::cast<py::array>(value).ndim() == 2;
  if (!IsList(value) || py::len(value) != 2) return false;
  const py::sequence pair = py::reinterpret_borrow<py::sequence>(value);
  return IsArray(pair[0]) && IsArray(pair[1]);
}

bool IsMapOfCurves(py::handle value) {
  if (!py::isinstance<py::dict>(value) || py::len(value) == 0) return false;
  for (const auto& [id, curve] : py::reinterpret_borrow<py::dict>(value)) {
    if (!IsCurve(curve)) return false;
  }
  return true;
}

void CheckEachOnce(const CurveKeywords& said, std::size_t curves) {
  if (said.told.irradiance_W_m2 && curves > 1) {
    Raise({"irradiance_Wm2 is for one curve, this measurement has " + std::to_string(curves), {}});
  }
}

// The curves of a long table, in the order in which they appear.
CurveSet FromRows(py::handle table, const CurveKeywords& said) {
  const py::list ids(ColumnOf(table, Column::kCurve));
  const IvCurve all = ReadingsOf(table);
  if (all.voltage_V.size() != py::len(ids) || all.current_A.size() != py::len(ids)) {
    Raise({"the columns are not of one length", {}});
  }
  std::vector<std::pair<std::string, std::vector<std::size_t>>> curves;
  std::map<std::string, std::size_t> places;
  for (std::size_t row = 0; row < all.size(); ++row) {
    const std::string id = py::str(ids[row]).cast<std::string>();
    const auto [place, fresh] = places.emplace(id, curves.size());
    if (fresh) curves.push_back({id, {}});
    curves[place->second].second.push_back(row);
  }
  CurveSet set;
  for (const auto& [id, rows] : curves) {
    CurveKeywords own = said;
    own.name = id;
    IvCurve curve = FromColumns(RowsOf(all, rows), own);
    ApplyTold(said.told, &curve);
    set.curves.push_back(std::move(curve));
  }
  return set;
}

void Append(IvCurve curve, CurveSet* set) {
  const bool taken = std::any_of(set->curves.begin(), set->curves.end(),
                                 [&](const IvCurve& other) { return other.name == curve.name; });
  if (taken) curve.name += " " + std::to_string(set->curves.size() + 1);
  set->curves.push_back(std::move(curve));
}

CurveSet FromPaths(const std::vector<std::string>& paths, const CurveKeywords& said) {
  CurveSet set = Must(Unlocked([&] {
    return paths.size() == 1 ? ReadMeasurement(paths.front(), said.reading)
                             : ReadMeasurement(paths, said.reading);
  }));
  CheckEachOnce(said, set.curves.size());
  const Expected<void> applied = ApplyConditions(said.told, &set);
  if (!applied) Raise(applied.error());
  if (!said.name.empty()) set.name = said.name;
  return set;
}

}  // namespace

bool IsSeveral(py::handle value) {
  if (IsMapOfCurves(value)) return true;
  if (!IsList(value) || py::len(value) == 0) return false;
  return std::all_of(value.begin(), value.end(), [](py::handle member) { return IsCurve(member); });
}

CurveSet SetOf(py::handle curves, py::handle current, const CurveKeywords& said) {
  if (!current.is_none()) return SetOfOne(CurveOf(curves, current, said));
  if (IsGroupBy(curves)) return SetOf(FramesOf(curves), current, said);
  const bool text =
      py::isinstance<py::str>(curves) && curves.cast<std::string>().find('\n') != std::string::npos;
  if (IsPath(curves) && !text) return FromPaths({TextOf("curve", curves)}, said);
  CurveSet set;
  if (IsMapOfCurves(curves)) {
    for (const auto& [id, curve] : py::reinterpret_borrow<py::dict>(curves)) {
      CurveKeywords own = said;
      own.name = py::str(id).cast<std::string>();
      Append(CurveOf(curve, py::none(), own), &set);
    }
  } else if (IsTable(curves) && !ColumnOf(curves, Column::kCurve).is_none()) {
    set = FromRows(curves, said);
  } else if (IsSeveral(curves)) {
    const bool paths =
        std::all_of(curves.begin(), curves.end(), [](py::handle member) { return IsPath(member); });
    if (paths) return FromPaths(TextsOf("curve", curves), said);
    for (const py::handle curve : curves) Append(CurveOf(curve, py::none(), said), &set);
  } else {
    return SetOfOne(CurveOf(curves, current, said));
  }
  CheckEachOnce(said, set.curves.size());
  set.name = said.name.empty() ? "curves" : said.name;
  return set;
}

std::vector<IvCurve> SweepsOf(py::handle value, const CurveKeywords& said) {
  if (!IsList(value) || !IsSeveral(value)) return SetOf(value, py::none(), said).curves;
  std::vector<IvCurve> sweeps;
  for (const py::handle member : value) {
    for (IvCurve& curve : SetOf(member, py::none(), said).curves) {
      sweeps.push_back(std::move(curve));
    }
  }
  return sweeps;
}

}  // namespace lyrefit::python

#include "curves.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fit.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/read/bare_curve.h"
#include "work.h"

namespace lyrefit::python {
namespace {

// Removes readings without a voltage or a current from all columns.
void LeaveOutMissing(IvCurve* curve) {
  const auto missing = [curve](std::size_t i) {
    const auto none = [](double value) {
      return !std::isfinite(value) || std::fabs(value) >= kOverflowCode;
    };
    return none(curve->voltage_V[i]) || none(curve->current_A[i]);
  };
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < curve->size(); ++i) {
    if (!missing(i)) rows.push_back(i);
  }
  const std::size_t left = curve->size() - rows.size();
  if (left == 0) return;
  *curve = RowsOf(*curve, rows);
  curve->assumptions.emplace_back(std::to_string(left) +
                                  " readings without a voltage or a current were left out");
}

IvCurve FromReadings(py::handle voltage, py::handle current, const CurveKeywords& said) {
  IvCurve columns;
  columns.voltage_V = NumbersOf("voltage", voltage);
  columns.current_A = NumbersOf("current", current);
  return FromColumns(std::move(columns), said);
}

// A curve from two rows, two columns, or a pair of arrays.
IvCurve FromPair(py::handle pair, const CurveKeywords& said) {
  const auto sequence = py::isinstance<py::sequence>(pair) && !py::isinstance<py::array>(pair);
  if (sequence && py::len(pair) == 2) {
    const py::sequence two = py::reinterpret_borrow<py::sequence>(pair);
    return FromReadings(two[0], two[1], said);
  }
  const py::array array = py::array::ensure(pair);
  if (array && array.ndim() == 2 && (array.shape(0) == 2 || array.shape(1) == 2)) {
    const py::object rows = array.shape(0) == 2 ? py::object(array) : array.attr("T");
    return FromReadings(rows[py::int_(0)], rows[py::int_(1)], said);
  }
  PyErr_Clear();
  Raise({"expected voltage and current, a Curve, a path, or a mapping or frame with both, found " +
             py::str(py::type::handle_of(pair).attr("__name__")).cast<std::string>(),
         {}});
}

IvCurve FromFile(py::handle path, const CurveKeywords& said) {
  std::string text = TextOf("curve", path);
  const bool table = py::isinstance<py::str>(path) && text.find('\n') != std::string::npos;
  return Must(Unlocked([&] {
    return table ? ReadCurveText(std::move(text), said.name.empty() ? "text" : said.name,
                                 said.reading)
                 : ReadCurve(text, said.reading);
  }));
}

// Masked readings of an array are NaN here.
void RefuseMissing(const IvCurve& columns) {
  for (const auto& [name, values] :
       {std::pair("voltage", &columns.voltage_V), std::pair("current", &columns.current_A)}) {
    const auto found = std::find_if(values->begin(), values->end(),
                                    [](double value) { return std::isnan(value); });
    if (found == values->end()) continue;
    Raise({std::string("expected a finite ") + name + " at point " +
               std::to_string(found - values->begin() + 1) +
               ", found nan or a masked value: leave such readings out with skip_missing=True",
           {}});
  }
}

}  // namespace

IvCurve FromColumns(IvCurve columns, const CurveKeywords& said) {
  for (const OptionEcho& echo : NonDefaults(said.reading, kReadOptionTable)) {
    if (echo.name == "skip-missing") continue;
    if (echo.name == "area-cm2" && said.area_of_device) continue;
    Raise({KeywordOf(echo.name) + ": is about a file; readings are taken in V and A", {}});
  }
  if (columns.voltage_V.size() != columns.current_A.size()) {
    Raise({"expected as many currents as voltages, found " +
               std::to_string(columns.voltage_V.size()) + " voltages and " +
               std::to_string(columns.current_A.size()) + " currents",
           {}});
  }
  if (said.reading.skip_missing) LeaveOutMissing(&columns);
  RefuseMissing(columns);
  columns.name = said.name.empty() ? "curve" : said.name;
  return BareCurve(std::move(columns));
}

bool IsPath(py::handle value) {
  return py::isinstance<py::str>(value) || py::hasattr(value, "__fspath__");
}

CurveKeywords ReadCurveKeywords(Keywords* keywords) {
  CurveKeywords said;
  keywords->Read(kConditionOptionTable, &said.told);
  keywords->Read(kReadOptionTable, &said.reading);
  if (const auto name = keywords->Take("name")) said.name = TextOf("name", *name);
  return said;
}

IvCurve CurveOf(py::handle curve, py::handle current, const CurveKeywords& said) {
  IvCurve taken;
  if (!current.is_none()) {
    taken = FromReadings(curve, current, said);
  } else if (py::isinstance<IvCurve>(curve)) {
    taken = curve.cast<const IvCurve&>();
  } else if (py::isinstance<FitResult>(curve)) {
    taken = curve.cast<const FitResult&>().report().curve;
  } else if (IsPath(curve)) {
    taken = FromFile(curve, said);
  } else {
    taken = IsTable(curve) ? FromColumns(ReadingsOf(curve), said) : FromPair(curve, said);
  }
  if (!said.name.empty()) taken.name = said.name;
  const bool as_is = taken.as_is;
  ApplyTold(said.told, &taken);
  taken.as_is = taken.as_is || as_is;
  return taken;
}

void ApplyTold(const ConditionOptions& told, IvCurve* curve) {
  const Expected<void> applied = ApplyConditions(told, curve);
  if (applied) return;
  const std::string& sentence = applied.error().message;
  const std::size_t end = sentence.find(':');
  Raise({KeywordOf(sentence.substr(0, end)) + sentence.substr(end), {}});
}

void AppendCurveNotes(std::vector<KeywordNote>* notes) {
  AppendNotes(kConditionOptionTable, ConditionOptions(), notes);
  AppendNotes(kReadOptionTable, ReadOptions(), notes);
  notes->push_back({"name", "str", "None", "Reading", "of the curve, in reports"});
}

}  // namespace lyrefit::python

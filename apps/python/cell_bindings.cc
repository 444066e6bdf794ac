#include <memory>

#include "bindings.h"
#include "docs.h"
#include "frames.h"
#include "lyrefit/devices/describe_cell.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/read/read_cell.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/plots.h"
#include "result.h"
#include "sets.h"
#include "work.h"

namespace lyrefit::python {
namespace {

using Cell = std::shared_ptr<const CellReport>;

Record RecordOf(const Cell& cell) {
  Record record;
  record.json = [cell](JsonPoints) { return CellJson(*cell); };
  record.text = [cell](Length length) { return CellText(*cell, length); };
  record.brief = [cell] { return BriefCell(*cell); };
  record.document = [cell] { return CellDocument(*cell); };
  record.csv = [cell] { return CellCsv(*cell); };
  record.plot = [cell](const std::string& file) { return PlotCell(*cell, file); };
  return record;
}

class CellResult : public Result {
 public:
  explicit CellResult(const Cell& cell) : Result(RecordOf(cell)) {}
};

bool AreFiles(py::handle curves) {
  if (py::isinstance<py::str>(curves)) {
    return curves.cast<std::string>().find('\n') == std::string::npos;
  }
  if (IsPath(curves)) return true;
  if (!py::isinstance<py::list>(curves) && !py::isinstance<py::tuple>(curves)) return false;
  if (py::len(curves) == 0) return false;
  for (const py::handle member : curves) {
    if (!IsPath(member)) return false;
  }
  return true;
}

// All measurements of the cell. Files are read as the command reads them.
CurveSet CellOf(py::handle curves, py::handle current, const CurveKeywords& said) {
  CurveSet set;
  if (current.is_none() && AreFiles(curves)) {
    const std::vector<std::string> files = IsPath(curves)
                                               ? std::vector<std::string>{TextOf("curves", curves)}
                                               : TextsOf("curves", curves);
    ConditionOptions told = said.told;
    set = Must(Unlocked([&] { return ReadCell(files, said.reading, told.irradiance_W_m2); }));
    if (set.curves.size() > 1) told.irradiance_W_m2.reset();  // of each that states none
    const Expected<void> applied = ApplyConditions(told, &set);
    if (!applied) Raise(applied.error());
    if (!said.name.empty()) set.name = said.name;
    return set;
  }
  set = SetOf(curves, current, said);
  for (IvCurve& curve : set.curves) {
    if (said.reading.area_cm2) curve.notes.area_cm2 = said.reading.area_cm2;
  }
  return set;
}

CellResult DescribeOne(py::handle curves, py::handle current, const py::kwargs& given) {
  Keywords keywords("cell", given);
  const py::object progress = keywords.Take("progress").value_or(py::none());
  CurveKeywords said = ReadCurveKeywords(&keywords);
  said.area_of_device = true;
  CellOptions options;
  keywords.Read(kCellOptionTable, &options);
  keywords.Finish();
  const CurveSet set = CellOf(curves, current, said);
  CellReport report = Must(Work(
      progress, [&](const Observer& observer) { return DescribeCell(set, options, observer); },
      options.threads));
  for (const CellSweep& sweep : report.sweeps) {
    if (!sweep.doubt.empty()) WarnOfDoubts({sweep.name + ": " + sweep.doubt});
  }
  return CellResult(std::make_shared<const CellReport>(std::move(report)));
}

constexpr char kCellDoc[] =
    "Describe the measurements of one laboratory cell.\n\n"
    "Efficiency, Jsc and slopes of each sweep, hysteresis, n from Voc over light and from the "
    "dark\n"
    "curve, Rs by several methods, losses of the fill factor, superposition.\n\n"
    "Parameters\n----------\n"
    "curves : path, list of paths, or as fit_family() takes curves\n"
    "    Sweeps up and down, lit and dark, at several lights, Suns-Voc traces (files only), in "
    "any\n"
    "    combination, all of one cell; or voltages in V of one curve, with `current`. A dark "
    "curve\n"
    "    states an irradiance of 0, by its Curve or in the column irradiance.\n"
    "current : array_like of shape (n,), optional\n"
    "    In A, positive where the device delivers.\n"
    "progress : callable, optional\n"
    "    Called at most ten times a second with a :class:`Progress`; False ends the work.\n";

constexpr char kCellEnd[] =
    "Returns\n-------\n"
    "CellResult\n"
    "    The content of --json: ``result['sweeps']``, ``result['hysteresis']``; `frame()` has a\n"
    "    row a sweep.\n\n"
    "Raises\n------\n"
    "lyrefit.Error\n"
    "    A broken file, several cells in one file, no sweep of five readings, options outside\n"
    "    their ranges.\n\n"
    "Examples\n--------\n"
    ">>> found = lyrefit.cell(['lit.csv', 'dark.csv'], area_cm2=0.16)\n"
    ">>> found['sweeps'][0]['efficiency'], found['superposition']['rms_percent']\n";

std::vector<KeywordNote> CellNotes() {
  std::vector<KeywordNote> notes;
  notes.push_back({"progress", "Callable[[Progress], object]", "None", "", ""});
  AppendNotes(kCellOptionTable, CellOptions(), &notes);
  AppendCurveNotes(&notes);
  return EachOnce(notes);
}

}  // namespace

void BindCell(py::module_* module) {
  py::class_<CellResult, Result>(*module, "CellResult",
                                 "What cell() found. Experimental: may change in a minor version.")
      .def(
          "frame", [](const CellResult& r) { return FrameOfCsv(r.record().csv()); },
          "frame($self)\n--\n\nA pandas.DataFrame with a row a sweep (--csv).");
  DefineVerb(module, {"cell", "curves, current=None", kCellDoc, kCellEnd, CellNotes()},
             &DescribeOne, py::arg("curves"), py::arg("current") = py::none());
}

}  // namespace lyrefit::python

#include <memory>

#include "bindings.h"
#include "curves.h"
#include "docs.h"
#include "frames.h"
#include "lyrefit/read/read_module.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/plots.h"
#include "lyrefit/trend/read_trend.h"
#include "lyrefit/trend/trend.h"
#include "lyrefit/trend/trend_documents.h"
#include "result.h"
#include "work.h"

namespace lyrefit::python {
namespace {

using Trend = std::shared_ptr<const TrendReport>;

Record RecordOf(const Trend& trend) {
  Record record;
  record.json = [trend](JsonPoints) { return TrendJson(*trend); };
  record.text = [trend](Length) { return TrendText(*trend); };
  record.brief = [trend] { return BriefTrend(*trend); };
  record.document = [trend] { return TrendDocument(*trend); };
  record.csv = [trend] { return TrendCsv(*trend); };
  record.plot = [trend](const std::string& file) { return PlotTrend(*trend, file); };
  return record;
}

class TrendResult : public Result {
 public:
  explicit TrendResult(const Trend& trend) : Result(RecordOf(trend)) {}
};

TrendSeries SeriesOf(const std::vector<std::string>& files, const TrendReadOptions& reading,
                     bool operating, const TrendOptions& options, const Observer& observer) {
  if (files.size() == 1 && IsTrendState(files.front())) return Must(ReadTrendState(files.front()));
  if (operating) return Must(ReadOperatingPoints(files, reading));
  return Must(ReadTrend(files, reading, options, observer));
}

TrendResult FindOne(py::handle sweeps, const py::kwargs& given) {
  Keywords keywords("trend", given);
  const py::object progress = keywords.Take("progress").value_or(py::none());
  const auto module = keywords.Take("module");
  const auto operating_given = keywords.Take("operating");
  const CurveKeywords said = ReadCurveKeywords(&keywords);
  TrendOptions options;
  keywords.Read(kTrendOptionTable, &options);
  keywords.Finish();
  const bool operating = operating_given && TruthOf("operating", *operating_given);
  TrendReadOptions reading;
  reading.reading.reading = said.reading;
  reading.prepare = [told = said.told](IvCurve* curve) { return ApplyConditions(told, curve); };
  if (module) {
    const NamedParameters law = Must(ReadModuleParameters(TextOf("module", *module)));
    const TrendSource source = operating ? TrendSource::kOperatingPoints : TrendSource::kSweeps;
    reading.law = Must(SeriesOfModule(law, source, said.told.bypass_diodes.value_or(0)));
  }
  const std::vector<std::string> files = IsPath(sweeps)
                                             ? std::vector<std::string>{TextOf("sweeps", sweeps)}
                                             : TextsOf("sweeps", sweeps);
  TrendReport report = Must(Work(
      progress,
      [&](const Observer& observer) {
        return FindTrend(SeriesOf(files, reading, operating, options, observer), options, observer);
      },
      options.threads));
  return TrendResult(std::make_shared<const TrendReport>(std::move(report)));
}

constexpr char kTrendDoc[] =
    "Say what changed in a device over time.\n\n"
    "Rates, steps and onsets of its parameters at standard conditions, and the power lost since "
    "the\n"
    "first days by light, series resistance, recombination, shunt and mismatch.\n\n"
    "Parameters\n----------\n"
    "sweeps : path or list of paths\n"
    "    Sweeps of one device, each with its time (date, timestamp), light and temperature, in "
    "any\n"
    "    shape that the command batch reads; or the state that `trend --append` keeps.\n"
    "module : path, optional\n"
    "    A file of pvlib, PVsyst or SAM: the law of the device; else that of its sweeps.\n"
    "operating : bool, optional\n"
    "    The files are tables of operating points: time, irradiance, temperature, vmp, imp.\n"
    "progress : callable, optional\n"
    "    Called at most ten times a second with a :class:`Progress`; False ends the work.\n";

constexpr char kTrendEnd[] =
    "Returns\n-------\n"
    "TrendResult\n"
    "    The content of --json: ``result['quantities']``, ``result['loss']``, "
    "``result['onsets']``;\n"
    "    `frame()` has a row a day.\n\n"
    "Raises\n------\n"
    "lyrefit.Error\n"
    "    A broken file, a sweep without a time, too few days, options outside their ranges.\n\n"
    "Examples\n--------\n"
    ">>> found = lyrefit.trend('module7.csv')\n"
    ">>> found['loss']['energy_percent']['total'], found['onsets']\n";

std::vector<KeywordNote> TrendNotes() {
  std::vector<KeywordNote> notes;
  notes.push_back({"module", "str | PathLike[str]", "None", "", ""});
  notes.push_back({"operating", "bool", "False", "", ""});
  notes.push_back({"progress", "Callable[[Progress], object]", "None", "", ""});
  AppendNotes(kTrendOptionTable, TrendOptions(), &notes);
  AppendCurveNotes(&notes);
  return EachOnce(notes);
}

}  // namespace

void BindTrend(py::module_* module) {
  py::class_<TrendResult, Result>(
      *module, "TrendResult", "What trend() found. Experimental: may change in a minor version.")
      .def(
          "frame", [](const TrendResult& r) { return FrameOfCsv(r.record().csv()); },
          "frame($self)\n--\n\nA pandas.DataFrame with a row a day (--csv).");
  DefineVerb(module, {"trend", "sweeps", kTrendDoc, kTrendEnd, TrendNotes()}, &FindOne,
             py::arg("sweeps"));
}

}  // namespace lyrefit::python

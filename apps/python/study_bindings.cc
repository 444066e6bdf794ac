#include <memory>

#include "bindings.h"
#include "docs.h"
#include "effects.h"
#include "frames.h"
#include "lyrefit/estimate/fit/bounds.h"
#include "lyrefit/study/algorithms.h"
#include "lyrefit/study/compare.h"
#include "lyrefit/study/report/compare_csv.h"
#include "lyrefit/study/report/compare_json.h"
#include "lyrefit/study/report/compare_plot.h"
#include "lyrefit/study/report/documents.h"
#include "result.h"
#include "searcher.h"
#include "sets.h"
#include "work.h"

namespace lyrefit::python {
namespace {

using Compared = std::shared_ptr<const Comparison>;

Record RecordOf(const Compared& comparison) {
  Record record;
  record.json = [comparison](JsonPoints) { return CompareJson(*comparison); };
  record.text = [comparison] { return CompareText(*comparison); };
  record.brief = [comparison] {
    return "comparison of " + std::to_string(comparison->problems.size()) + " problems, " +
           std::to_string(comparison->options.runs) + " runs each";
  };
  record.document = [comparison] { return CompareDocument(*comparison); };
  record.csv = [comparison] { return CompareCsv(*comparison); };
  record.plot = [comparison](const std::string& file) { return PlotBoxes(*comparison, file); };
  return record;
}

class CompareResult : public Result {
 public:
  explicit CompareResult(Compared comparison)
      : Result(RecordOf(comparison)), comparison_(std::move(comparison)) {}
  const Comparison& comparison() const { return *comparison_; }

 private:
  Compared comparison_;
};

struct CompareAsked {
  CompareOptions options;
  SearchOptions search;
  std::vector<ComparedAlgorithm> algorithms;
  std::string bounds = "physical";
  BoundsSpec box;
  BoundsSpec::Table ranges;
  OwnEffects own;
  Faults faults;
};

ComparedAlgorithm NamedAlgorithm(const std::string& name, const CompareAsked& asked) {
  for (const AlgorithmKind kind : {AlgorithmKind::kShape, AlgorithmKind::kDefault}) {
    if (name == ToText(kind)) return OwnAlgorithm(kind);
  }
  const std::optional<Algorithm> algorithm = FromText<Algorithm>(name);
  if (!algorithm) {
    Raise({"algorithms: expected a list of " + AllTexts<Algorithm>() +
               ", shape, default or functions, found '" + name + "'",
           {}});
  }
  return PlainAlgorithms({*algorithm}, asked.search).front();
}

ComparedAlgorithm OwnSearch(const std::string& name, py::handle search, CompareAsked* asked) {
  auto fault = std::make_shared<Fault>();
  ComparedAlgorithm compared;
  compared.name = name;
  compared.search = asked->search;
  compared.searcher = SearcherOf(py::reinterpret_borrow<py::object>(search), fault);
  asked->faults.Add(std::move(fault));
  return compared;
}

// Adds algorithms from names, functions, a dict of functions by name, or a list of these.
void AddAlgorithms(py::handle value, CompareAsked* asked) {
  if (py::isinstance<py::str>(value)) {
    const auto names = SplitList(value.cast<std::string>());
    if (!names) Raise({"algorithms: " + names.error().message, {}});
    for (const std::string& name : *names) {
      asked->algorithms.push_back(NamedAlgorithm(name, *asked));
    }
  } else if (py::isinstance<py::dict>(value)) {
    for (const auto& [name, search] : py::reinterpret_borrow<py::dict>(value)) {
      asked->algorithms.push_back(OwnSearch(TextOf("algorithms", name), search, asked));
    }
  } else if (PyCallable_Check(value.ptr()) != 0) {
    const std::string name = py::str(value.attr("__name__")).cast<std::string>();
    asked->algorithms.push_back(OwnSearch(name, value, asked));
  } else {
    for (const py::handle member : value) AddAlgorithms(member, asked);
  }
}

void ReadBoundsKeywords(Keywords* keywords, CompareAsked* asked) {
  const auto ranges = [](const char* keyword, py::handle value, BoundsSpec::Table* table) {
    for (const std::string& text : TextsOf(keyword, value)) {
      const auto range = ReadRange(text);
      if (!range) Raise({std::string(keyword) + ": " + range.error().ToString(), {}});
      (*table)[range->first] = range->second;
    }
  };
  if (const auto bounds = keywords->Take("bounds")) {
    if (py::isinstance<py::dict>(*bounds)) {
      asked->bounds = "given";
      ranges("bounds", *bounds, &asked->box.table);
    } else {
      asked->bounds = TextOf("bounds", *bounds);
    }
  }
  if (const auto bound = keywords->Take("bound")) ranges("bound", *bound, &asked->ranges);
}

CompareAsked ReadCompareKeywords(Keywords* keywords) {
  CompareAsked asked;
  CompareOptions& options = asked.options;
  asked.search.population = 100;
  asked.search.iterations = 1000;
  const py::object algorithms =
      keywords->Take("algorithms").value_or(py::str("lo,lo+mblss,lo+dmlss,mlo,de,random"));
  if (const auto journal = keywords->Take("resume")) options.journal = TextOf("resume", *journal);
  if (const auto with = keywords->Take("with_")) {
    EffectsAsked effects = EffectsOf(*with);
    options.with = std::move(effects.uses);
    asked.own = std::move(effects.own);
    if (!keywords->Given("objective")) options.objective = Objective::kSolvedCurrent;
  }
  ReadBoundsKeywords(keywords, &asked);
  keywords->Read(kCompareOptionTable, &options);
  keywords->Read(kSearchOptionTable, &asked.search);
  asked.faults = FaultsOf(asked.own);
  AddAlgorithms(algorithms, &asked);
  if (!asked.faults.empty()) options.threads = 1;
  return asked;
}

CompareCurve Subject(IvCurve curve, const std::string& file, const CompareAsked& asked) {
  BoundsSpec bounds = asked.box;
  bounds.name = asked.bounds;
  if (asked.bounds != "given") bounds = Must(NamedBounds(asked.bounds, file));
  for (const auto& [name, range] : asked.ranges) bounds.overrides[name] = range;
  return MakeSubject(std::move(curve), std::move(bounds));
}

std::vector<CompareCurve> Subjects(py::handle curves, const CurveKeywords& said,
                                   const CompareAsked& asked) {
  std::vector<CompareCurve> subjects;
  const auto add = [&](py::handle one, const CurveKeywords& own) {
    IvCurve curve = CurveOf(one, py::none(), own);
    const std::string file = IsPath(one) ? TextOf("curves", one) : curve.source;
    subjects.push_back(Subject(std::move(curve), file, asked));
  };
  if (!IsSeveral(curves)) {
    add(curves, said);
  } else if (py::isinstance<py::dict>(curves)) {
    for (const auto& [name, curve] : py::reinterpret_borrow<py::dict>(curves)) {
      CurveKeywords own = said;
      own.name = py::str(name).cast<std::string>();
      add(curve, own);
    }
  } else {
    for (const py::handle curve : curves) add(curve, said);
  }
  return subjects;
}

CompareResult CompareAll(py::handle curves, const py::kwargs& given) {
  Keywords keywords("compare", given);
  const py::object progress = keywords.Take("progress").value_or(py::none());
  const CompareAsked asked = ReadCompareKeywords(&keywords);
  const CurveKeywords said = ReadCurveKeywords(&keywords);
  keywords.Finish();
  const std::vector<CompareCurve> subjects = Subjects(curves, said, asked);
  Expected<Comparison> comparison = WorkWith(asked.faults, progress, [&](const Observer& observer) {
    return Compare(subjects, asked.algorithms, asked.options, observer);
  });
  return CompareResult(HoldWith(Must(std::move(comparison)), asked.own));
}

// A row for each compared algorithm on each problem.
py::object RankFrame(const CompareResult& result) {
  py::list rows;
  for (const ProblemResult& problem : result.comparison().problems) {
    for (std::size_t c = 0; c < problem.algorithms.size(); ++c) {
      const AlgorithmResult& compared = problem.algorithms[c];
      const auto rank = [c](const Ranking& ranking) -> py::object {
        const std::vector<double>& ranks = ranking.friedman.mean_rank;
        return c < ranks.size() ? py::object(py::float_(ranks[c])) : py::object(py::none());
      };
      py::dict row;
      row["curve"] = problem.curve_name;
      row["model"] = ToText(problem.model);
      row["algorithm"] = compared.name;
      row["rank_searched"] = rank(problem.searched);
      row["rank_polished"] = rank(problem.polished);
      row["median_searched_A"] = compared.searched.median;
      row["median_polished_A"] = compared.polished.median;
      row["within_1e9"] = compared.polished.within_1e9;
      row["runs"] = compared.runs.size();
      row["evaluations"] = compared.evaluations;
      row["target_hits"] = compared.target_hits;
      row["reference_A"] = problem.reference.rmse_A;
      rows.append(row);
    }
  }
  return FrameOfRows(rows);
}

constexpr char kCompareDoc[] =
    "Compare search algorithms, pure and polished, over many runs.\n\n"
    "Parameters\n----------\n"
    "curves : curve, or list or dict of curves\n"
    "    Each as fit() takes it: a path, a Curve, a frame, (voltage, current) in V and A.\n"
    "algorithms : str, callable, dict or list\n"
    "    Names of the library's, 'shape', 'default', and searches of your own: functions, or a "
    "dict\n"
    "    of functions by name. Such a search is called as ``search(objective, lower, upper,\n"
    "    options)``: `objective` gives the RMSE in A at a point of shape (n,), a float, or at m\n"
    "    points of shape (m, n), an array; `lower` and `upper` are the box, shape (n,); `options`\n"
    "    is a dict with seed, run, population, iterations, max_evaluations and elites. It returns\n"
    "    its best point, or several, best first, shape (m, n), within the box. The same seed and\n"
    "    run must give the same; its evaluations are counted, not limited. With one of them one\n"
    "    thread is used.\n"
    "bounds : str, path or dict\n"
    "    'physical', 'wide', 'paper', 'literature', a file, or {'Rs': (0, 0.5), ...}; bound={...}\n"
    "    changes single ranges.\n"
    "resume : path, optional\n"
    "    A journal that finished runs are written to and taken up from.\n"
    "progress : callable, optional\n"
    "    Called with a :class:`Progress` ten times a second; False ends the work.\n";

constexpr char kCompareEnd[] =
    "Returns\n-------\n"
    "CompareResult\n\n"
    "Raises\n------\n"
    "lyrefit.Error\n";

std::vector<KeywordNote> CompareNotes() {
  std::vector<KeywordNote> notes;
  notes.push_back({"algorithms", "Any", "'lo,lo+mblss,lo+dmlss,mlo,de,random'", "Search", ""});
  notes.push_back({"bounds", "str | PathLike[str] | Mapping[str, tuple[float, float]]",
                   "'physical'", "Model", ""});
  notes.push_back({"bound", "Mapping[str, tuple[float, float]]", "None", "Model", ""});
  notes.push_back({"resume", "str | PathLike[str]", "None", "Runs", ""});
  notes.push_back({"progress", "Callable[[Progress], object]", "None", "", ""});
  AppendNotes(kCompareOptionTable, CompareOptions(), &notes);
  SearchOptions search;
  search.population = 100;
  search.iterations = 1000;
  AppendNotes(kSearchOptionTable, search, &notes);
  AppendCurveNotes(&notes);
  return EachOnce(notes);
}

}  // namespace

void BindStudy(py::module_* module) {
  py::class_<CompareResult, Result>(*module, "CompareResult", "What compare() found.")
      .def("frame", &RankFrame,
           "frame($self)\n--\n\nA pandas.DataFrame with a row for each algorithm on each problem:\n"
           "mean ranks over the runs, median RMSEs (A) of search and polish, hits.")
      .def(
          "run_frame", [](const CompareResult& r) { return FrameOfCsv(r.record().csv()); },
          "run_frame($self)\n--\n\nA pandas.DataFrame with a row a run (--csv).");
  DefineVerb(module, {"compare", "curves", kCompareDoc, kCompareEnd, CompareNotes()}, &CompareAll,
             py::arg("curves"));
}

}  // namespace lyrefit::python

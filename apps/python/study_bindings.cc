#include <memory>

#include "../lyrefit/pagmo_searcher.h"
#include "bindings.h"
#include "docs.h"
#include "effects.h"
#include "frames.h"
#include "lyrefit/estimate/fit/bounds.h"
#include "lyrefit/settings/bounds_file.h"
#include "lyrefit/study/algorithms.h"
#include "lyrefit/study/compare.h"
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
  record.text = [comparison](Length) { return CompareText(*comparison); };
  record.brief = [comparison] {
    return "comparison of " + std::to_string(comparison->problems.size()) + " problems, " +
           std::to_string(comparison->options.runs) + " runs each";
  };
  record.document = [comparison] { return CompareDocument(*comparison); };
  record.csv = [comparison] { return CompareCsv(*comparison); };
  record.plot = [comparison](const std::string& file) { return PlotBoxes(*comparison, file); };
  record.convergence = [comparison](const std::string& file) {
    return PlotConvergence(*comparison, file);
  };
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
  if (name.rfind("pagmo:", 0) == 0) {
    if (PagmoNames().empty()) {
      Raise({"algorithms: '" + name +
                 "' needs pagmo2, which wheels and packages leave out: build the module where "
                 "libpagmo-dev is installed, or take a search of lyrefit.searches, such as "
                 "lyrefit.searches.cma_es",
             {}});
    }
    return Must(PagmoAlgorithm(name.substr(6), asked.search));
  }
  const std::optional<Algorithm> algorithm = FromText<Algorithm>(name);
  if (!algorithm) {
    Raise({"algorithms: expected a list of " + AllTexts<Algorithm>() +
               ", shape, default, pagmo:NAME or functions, found '" + name + "'",
           {}});
  }
  return PlainAlgorithms({*algorithm}, asked.search).front();
}

// Tells versions of a search apart in a journal: of its source and of the values that it holds.
// What it calls is not looked at.
std::string VersionOf(const std::string& name, py::handle search) {
  const py::module_ inspect = py::module_::import("inspect");
  std::string text;
  try {
    if (PyFunction_Check(search.ptr()) == 0) throw py::type_error("no function");
    text = inspect.attr("getsource")(search).cast<std::string>();
    text += py::repr(search.attr("__defaults__")).cast<std::string>();
    text += py::repr(inspect.attr("getclosurevars")(search).attr("nonlocals")).cast<std::string>();
  } catch (const std::exception&) {
    PyErr_Clear();
    Raise(
        {"resume: the search '" + name +
             "' is no function with a source, which would tell in the journal whether it is still "
             "the same",
         {}});
  }
  const py::object digest =
      py::module_::import("hashlib").attr("sha256")(py::bytes(text)).attr("hexdigest")();
  return digest.cast<std::string>().substr(0, 16);
}

ComparedAlgorithm OwnSearch(const std::string& name, py::handle search, CompareAsked* asked) {
  if (PyCallable_Check(search.ptr()) == 0) {
    Raise({"algorithms: expected a function search(objective, lower, upper, options), found " +
               NameOf(py::type::of(search)),
           {}});
  }
  auto fault = std::make_shared<Fault>();
  ComparedAlgorithm compared;
  compared.name = name;
  compared.search = asked->search;
  compared.searcher = SearcherOf(py::reinterpret_borrow<py::object>(search), fault, true);
  if (!asked->options.journal.empty()) compared.searcher_version = VersionOf(name, search);
  asked->faults.Add(std::move(fault));
  return compared;
}

// Adds algorithms from names, functions, a dict of both by name, or a list of these.
void AddAlgorithms(py::handle value, CompareAsked* asked) {
  if (py::isinstance<py::str>(value)) {
    const auto names = SplitList(value.cast<std::string>());
    if (!names) Raise({"algorithms: " + names.error().message, {}});
    for (const std::string& name : *names) {
      asked->algorithms.push_back(NamedAlgorithm(name, *asked));
    }
  } else if (py::isinstance<py::dict>(value)) {
    for (const auto& [name, search] : py::reinterpret_borrow<py::dict>(value)) {
      ComparedAlgorithm compared = py::isinstance<py::str>(search)
                                       ? NamedAlgorithm(search.cast<std::string>(), *asked)
                                       : OwnSearch(TextOf("algorithms", name), search, asked);
      compared.name = TextOf("algorithms", name);
      asked->algorithms.push_back(std::move(compared));
    }
  } else if (PyCallable_Check(value.ptr()) != 0) {
    asked->algorithms.push_back(OwnSearch(NameOf(value), value, asked));
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
      const auto spread = [&row](const std::string& stage, const RunSpread& of) {
        const auto set = [&](const char* figure, double value) {
          row[py::str(std::string(figure) + "_" + stage + "_A")] = value;
        };
        set("min", of.min);
        set("mean", of.mean);
        set("median", of.median);
        set("max", of.max);
        set("std", of.std);
      };
      spread("searched", compared.searched);
      spread("polished", compared.polished);
      row["within_1e9"] = compared.polished.within_1e9;
      row["runs"] = compared.runs.size();
      row["evaluations"] = compared.evaluations;
      row["search_seconds"] = compared.search_seconds;
      row["polish_seconds"] = compared.polish_seconds;
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
    "    Names of the library's, 'shape', 'default', 'pagmo:NAME' with pagmo2's where the module "
    "was\n"
    "    built beside it, and searches of your own: functions (lyrefit.searches has some); a dict\n"
    "    gives either other names. Such a search is called as ``search(objective, lower, upper,\n"
    "    options)``: `objective` gives the RMSE in A at a point of shape (n,), a float, or at m\n"
    "    points of shape (m, n), an array; `lower` and `upper` are the box, shape (n,). It "
    "returns\n"
    "    its best point, or several, best first, shape (m, n), within the box. The same seed and\n"
    "    run must give the same. With one of them one thread is used.\n\n"
    "    The budget is that of the library's searches, population x (iterations + 1) evaluations\n"
    "    or max_evaluations: an evaluation beyond it raises StopIteration in the search, and its\n"
    "    best point so far counts. NaN of the objective is given as infinity.\n\n"
    "    `options` is a dict with seed, run, population, iterations, max_evaluations, elites;\n"
    "    `start`, shape (population, n), the points from which the library's searches start in\n"
    "    this run; and `parameters`, a dict a coordinate with name, unit, the range lower to "
    "upper\n"
    "    of the parameter's values, and scale. A coordinate of scale 'linear' is the value, one "
    "of\n"
    "    scale 'log' is ln(value / lower), one of scale 'whole' has a unit of length a value. The\n"
    "    bounds 'physical' and 'wide' make saturation currents and shunts logarithmic; published\n"
    "    ones keep all linear, and so do those that you give.\n"
    "bounds : str, path or dict\n"
    "    'physical', 'wide', 'table1', 'literature', a file, or {'Rs': (0, 0.5), ...}; "
    "bound={...}\n"
    "    changes single ranges.\n"
    "resume : path, optional\n"
    "    A journal that finished runs are written to and taken up from. It knows a search of your\n"
    "    own by its source and the values that it holds, not by what it calls.\n"
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
           "mean ranks over the runs, smallest, mean, median, largest RMSE (A) of search and "
           "polish\n"
           "and their standard deviation, hits, seconds of a run.")
      .def(
          "run_frame", [](const CompareResult& r) { return FrameOfCsv(r.record().csv()); },
          "run_frame($self)\n--\n\nA pandas.DataFrame with a row a run (--csv).");
  DefineVerb(module, {"compare", "curves", kCompareDoc, kCompareEnd, CompareNotes(), true},
             &CompareAll, py::arg("curves"));
}

}  // namespace lyrefit::python

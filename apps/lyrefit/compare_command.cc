#include <fmt/format.h>

#include <algorithm>

#include "compare_flags.h"
#include "interrupt.h"
#include "lyrefit/base/try.h"
#include "lyrefit/report/page.h"
#include "lyrefit/study/algorithms.h"
#include "lyrefit/study/report/documents.h"
#include "pagmo_searcher.h"
#include "verbs.h"

namespace lyrefit {
namespace {

constexpr char kCompareFooter[] =
    "Examples:\n"
    "  lyrefit compare data/rtc_france --runs 50\n"
    "  lyrefit compare data/rtc_france --bounds literature --models td --algorithms lo,mlo,random\n"
    "      --json compare.json --csv runs.csv\n"
    "  lyrefit compare data/s75_constructed --at 1000x25,200x25,1000x60 --models sd --bounds "
    "paper\n"
    "\n"
    "Every algorithm has the same budget and, in run r, the same first points. RMSEs are of the\n"
    "objective that is named beside them.";

constexpr OptionRow<CompareFlags> kCompareFlagTable[] = {
    OptionRow<CompareFlags>("Curves"),
    {"at", "LIST",
     "of a set of curves: those nearest to 1000x25,200x25 (W/m2 x C; 10 W/m2 are as far as 1 K)",
     &CompareFlags::at},
    {"curves", "LIST", "of a set of curves: those with these ids", &CompareFlags::curve_ids},
    OptionRow<CompareFlags>("Model"),
    {"bound", "P=LOWER:UPPER", "range of one parameter, Rs=0:0.5; once for each",
     RangesOption<&CompareFlags::ranges>(), OptionTrait::kNoFlag},
};

// The flags of curves, models, objective, bounds, runs, seed, threads, JSON and CSV.
void AddSharedFlags(VerbLine* verb, CompareFlags* flags) {
  verb->AddOption("CURVE", &flags->curve_files, "one or more curve files or folders")
      .ReadsCurves()
      .Required();
  AddTableFlags(verb, kConditionOptionTable, &flags->conditions);
  AddTableFlags(verb, kCompareFlagTable, flags);
  AddTableFlags(verb, kCompareOptionTable, &flags->options, "Model");
  AddBoundsFlag(verb, "Model", &flags->bounds);
  AddNamedFlags(verb, kCompareFlagTable, {"bound"}, flags);
  AddTableFlags(verb, kCompareOptionTable, &flags->options, "Runs");
  AddResumeFlag(verb, "run", &flags->options.journal);
  verb->AddOption("--json", &flags->output.json_file,
                  "everything as JSON; - for standard output, alone")
      .Writes();
  AddCsvFlag(verb, "one row a run", &flags->output);
  AddHtmlFlag(verb, "report", &flags->output);
  verb->AddQuietSwitch();
}

void AddAlgorithmsFlag(VerbLine* verb, CompareFlags* flags) {
  const std::string peers = PagmoNames();
  const std::string pagmo = peers.empty() ? "; pagmo:NAME with pagmo2's algorithms, none of which "
                                            "is in this build: install libpagmo-dev and build again"
                                          : "; pagmo:NAME with NAME one of " + peers;
  verb->AddOption("--algorithms", &flags->algorithms,
                  "list of " + AllTexts<Algorithm>() +
                      ", shape (starts from the curve's shape alone), "
                      "default (the fit with its default settings)" +
                      pagmo + " (default " + flags->algorithms + ")")
      .Type("LIST")
      .Group("Search");
}

// The rows of these names of the search's option table; `flags->search` holds the defaults.
void AddSearchRows(VerbLine* verb, const std::vector<std::string>& names, CompareFlags* flags) {
  for (OptionRow<SearchOptions> row : kSearchOptionTable) {
    if (std::find(names.begin(), names.end(), row.name) == names.end()) continue;
    row.traits = row.traits | OptionTrait::kUnchecked;  // checked by the study
    AddRowFlag(verb, row, "Search", &flags->search);
  }
}

void DeclareCompare(VerbLine* verb, CompareFlags* flags) {
  flags->search.population = 100;
  flags->search.iterations = 1000;
  AddSharedFlags(verb, flags);
  AddAlgorithmsFlag(verb, flags);
  AddSearchRows(verb,
                {"population", "iterations", "memory-rate", "distance-coefficient", "de-scale",
                 "de-crossover", "max-evaluations", "elites"},
                flags);
  AddNamedFlags(verb, kCompareOptionTable, {"target-gap", "polish", "plain-polish"},
                &flags->options);
  verb->AddOption("--plot", &flags->output.plot_file,
                  "box plots of all runs as a picture, .svg, .png or .pdf")
      .Draws();
  verb->AddOption("--convergence-plot", &flags->convergence_file,
                  "the median course of the searches as a picture, .svg, .png or .pdf")
      .Draws();
}

Expected<ComparedAlgorithm> ParseAlgorithm(const std::string& name, const SearchOptions& search) {
  for (const AlgorithmKind kind : {AlgorithmKind::kShape, AlgorithmKind::kDefault}) {
    if (name == ToText(kind)) return OwnAlgorithm(kind);
  }
  const std::string pagmo = "pagmo:";
  if (name.rfind(pagmo, 0) == 0) {
    return PagmoAlgorithm(name.substr(pagmo.size()), search);
  }
  const std::optional<Algorithm> algorithm = FromText<Algorithm>(name);
  if (!algorithm) {
    return Fail(
        fmt::format("--algorithms: expected a list of {}, shape, default or pagmo:NAME, found '{}'",
                    AllTexts<Algorithm>(), name));
  }
  return PlainAlgorithms({*algorithm}, search)[0];
}

Expected<std::vector<ComparedAlgorithm>> ParseAlgorithms(const CompareFlags& flags) {
  TRY(const auto names, ParseList("--algorithms", flags.algorithms));
  std::vector<ComparedAlgorithm> algorithms;
  for (const std::string& name : names) {
    TRY(ComparedAlgorithm compared, ParseAlgorithm(name, flags.search));
    algorithms.push_back(std::move(compared));
  }
  return algorithms;
}

Expected<int> RunCompare(VerbLine& verb, CompareFlags& flags) {
  TRY(const auto algorithms, ParseAlgorithms(flags));
  CompareOptions options = flags.options;
  if (!options.with.empty()) {
    options.force_effects = verb.Forced();
    if (!verb.Given("--objective")) options.objective = Objective::kSolvedCurrent;
  }
  TRY(verb.CheckFiles());
  TRY(const auto curves, ReadComparedCurves(flags));
  const InterruptGuard guard;
  TRY(const Comparison comparison,
      Compare(curves, algorithms, options, TerminalObserver({"compare"})));
  PrintRemarks(comparison.remarks);
  TRY(WriteWanted(flags.output.json_file, [&] { return CompareJson(comparison); }));
  TRY(WriteWanted(flags.output.csv_file, [&] { return CompareCsv(comparison); }));
  if (!comparison.problems.empty()) {
    if (const std::string& path = flags.output.plot_file; !path.empty()) {
      TRY(PlotBoxes(comparison, path));
    }
    if (const std::string& path = flags.convergence_file; !path.empty()) {
      TRY(PlotConvergence(comparison, path));
    }
  }
  TRY(WriteWanted(flags.output.html_file,
                  [&] { return DrawPage(CompareDocument(comparison), CompareJson(comparison)); }));
  TRY(WriteText(verb, [&] { return DrawText(CompareDocument(comparison)); }));
  if (comparison.interrupted) return kExitInterrupted;
  return comparison.journal_lacks_runs ? kExitBadInput : kExitFine;
}

}  // namespace

const Verb kCompareVerb = {
    "compare",
    "Compare search algorithms, pure and polished, over many runs",
    kCompareFooter,
    "its tables as text, --json, --csv, --plot, --convergence-plot and --html",
    Declare<CompareFlags, DeclareCompare, RunCompare>,
    VerbKind::kPromised};

}  // namespace lyrefit

#include "lyrefit/base/try.h"
#include "lyrefit/study/report/compare_plot.h"
#include "lyrefit/study/report/documents.h"
#include "study_flags.h"
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

struct CompareRequest {
  StudyFlags study;
  std::string convergence_file;
};

void DeclareCompare(VerbLine* verb, CompareRequest* request) {
  StudyFlags& study = request->study;
  study.search.population = 100;
  study.search.iterations = 1000;
  AddStudyFlags(verb, &study);
  AddAlgorithmsFlag(verb, &study);
  AddSearchRows(verb,
                {"population", "iterations", "memory-rate", "distance-coefficient", "de-scale",
                 "de-crossover", "max-evaluations", "elites"},
                &study);
  AddNamedFlags(verb, kCompareOptionTable, {"target-gap", "polish", "plain-polish"},
                &study.options);
  verb->AddOption("--plot", &study.output.plot_file,
                  "box plots of all runs as a picture, .svg, .png or .pdf")
      .Draws();
  verb->AddOption("--convergence-plot", &request->convergence_file,
                  "the median course of the searches as a picture, .svg, .png or .pdf")
      .Draws();
}

Expected<int> RunCompare(VerbLine& verb, CompareRequest& request) {
  TRY(const auto algorithms, ParseAlgorithms(request.study));
  return RunStudy(
      verb, request.study, algorithms, CompareDocument,
      {{request.study.output.plot_file, PlotBoxes}, {request.convergence_file, PlotConvergence}});
}

}  // namespace

const Verb kCompareVerb = {
    "compare",
    "Compare search algorithms, pure and polished, over many runs",
    kCompareFooter,
    "its tables as text, --json, --csv, --plot, --convergence-plot and --html",
    Declare<CompareRequest, DeclareCompare, RunCompare>,
    VerbKind::kPromised};

}  // namespace lyrefit

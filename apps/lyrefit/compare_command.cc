#include "compare_command.h"

#include "lyrefit/study/report/compare_plot.h"
#include "lyrefit/study/report/documents.h"
#include "output.h"

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

}  // namespace

CompareCommand::CompareCommand(CommandLine* line)
    : verb_(line->AddVerb("compare",
                          "Compare search algorithms, pure and polished, over many runs")) {
  flags_.search.population = 100;
  flags_.search.iterations = 1000;
  AddStudyFlags(verb_, &flags_).Required();
  AddAlgorithmsFlag(verb_, &flags_);
  AddSearchRows(verb_,
                {"population", "iterations", "memory-rate", "distance-coefficient", "de-scale",
                 "de-crossover", "max-evaluations", "elites"},
                &flags_);
  verb_
      ->AddOption("--target-gap", &flags_.options.target_gap,
                  "relative distance from the reference that counts as reached (default " +
                      NumberText(flags_.options.target_gap) + ")")
      .Type("NUMBER")
      .Group("Runs");
  AddPolishLevelFlags(verb_, &flags_);
  const auto picture = [this](const char* flag, std::string* target, const char* doc) {
    verb_->AddOption(flag, target, doc).Draws();
  };
  picture("--plot", &plot_file_, "box plots of all runs as a picture, .svg or .png");
  picture("--convergence-plot", &convergence_file_,
          "the median course of the searches as a picture, .svg or .png");
  verb_->Footer(kCompareFooter);
}

int CompareCommand::Run() {
  const auto contenders = ParseContenders(flags_);
  if (!contenders) return Refuse(contenders.error());
  return RunStudy(*verb_, flags_, *contenders, CompareText,
                  {{plot_file_, PlotBoxes}, {convergence_file_, PlotConvergence}});
}

}  // namespace lyrefit

#include <fmt/format.h>

#include <cmath>

#include "lyrefit/base/try.h"
#include "lyrefit/study/report/compare_plot.h"
#include "lyrefit/study/report/documents.h"
#include "study_flags.h"
#include "verbs.h"

namespace lyrefit {
namespace {

constexpr double kLeast = 4;
constexpr double kMost = 1e9;
constexpr int kMultistart = 100;  // default with effects

constexpr char kBudgetFooter[] =
    "Examples:\n"
    "  lyrefit budget data/rtc_france --algorithms mlo,de,random --plot budget.svg\n"
    "  lyrefit budget data/rtc_france --models td --budgets 10,100,1000 --runs 20\n"
    "\n"
    "A hit is a run within 1e-6 (search alone) or 1e-9 (polished) of the reference; of problems\n"
    "with effects one within 1e-6 of the best known optimum.";

struct BudgetRequest {
  StudyFlags study;
  std::string budgets = "10,30,100,300,1000,3000,10000,30000,100000";
};

void DeclareBudget(VerbLine* verb, BudgetRequest* request) {
  StudyFlags& study = request->study;
  study.options.plain_polish = true;
  study.options.rankings = false;
  AddStudyFlags(verb, &study);
  AddNamedFlags(verb, kCompareOptionTable, {"multistart"}, &study.options);
  AddAlgorithmsFlag(verb, &study);
  verb->AddOption("--budgets", &request->budgets,
                  "list of evaluations; the population is about their root (default " +
                      request->budgets + ")")
      .Type("LIST")
      .Group("Search");
  AddSearchRows(verb, {"memory-rate", "distance-coefficient", "de-scale", "de-crossover", "elites"},
                &study);
  verb->AddOption("--plot", &study.output.plot_file,
                  "success rate over evaluations as a picture, .svg, .png or .pdf")
      .Draws();
}

Expected<std::vector<std::int64_t>> ParseBudgets(const std::string& text) {
  TRY(const auto numbers, ParseNumbers("--budgets", text));
  std::vector<std::int64_t> budgets;
  for (const double number : numbers) {
    if (!(number >= kLeast && number <= kMost && number == std::floor(number))) {
      return Fail(fmt::format("--budgets: expected whole numbers from {:g} to {:g}, found {:g}",
                              kLeast, kMost, number));
    }
    budgets.push_back(static_cast<std::int64_t>(number));
  }
  return budgets;
}

Expected<std::vector<ComparedAlgorithm>> BudgetAlgorithms(const StudyFlags& study,
                                                          const std::string& budget_list) {
  TRY(const auto names, ParseList("--algorithms", study.algorithms));
  TRY(const auto budgets, ParseBudgets(budget_list));
  std::vector<ComparedAlgorithm> algorithms;
  for (const std::string& name : names) {
    if (name == ToText(AlgorithmKind::kShape) || name == ToText(AlgorithmKind::kDefault)) {
      algorithms.push_back(*ParseAlgorithm(name, study.search));  // has no budget
      continue;
    }
    for (const std::int64_t budget : budgets) {
      TRY(ComparedAlgorithm compared, ParseAlgorithm(name, BudgetSearch(budget, study.search)));
      compared.name = fmt::format("{}@{}", name, budget);
      compared.budget = budget;
      algorithms.push_back(std::move(compared));
    }
  }
  return algorithms;
}

Expected<int> RunBudget(VerbLine& verb, BudgetRequest& request) {
  StudyFlags& study = request.study;
  if (!study.options.with.empty() && !verb.Given("--multistart")) {
    study.options.multistart = kMultistart;
  }
  TRY(const auto algorithms, BudgetAlgorithms(study, request.budgets));
  return RunStudy(verb, study, algorithms, BudgetDocument, {{study.output.plot_file, PlotBudget}});
}

}  // namespace

const Verb kBudgetVerb = {"budget", "Evaluations each algorithm needs, by how far it is polished",
                          kBudgetFooter, "its tables as text, --json, --csv, --plot and --html",
                          Declare<BudgetRequest, DeclareBudget, RunBudget>};

}  // namespace lyrefit

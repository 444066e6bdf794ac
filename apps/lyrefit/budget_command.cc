#include "budget_command.h"

#include <fmt/format.h>

#include <cmath>

#include "lyrefit/study/report/compare_plot.h"
#include "lyrefit/study/report/documents.h"
#include "output.h"

namespace lyrefit {
namespace {

constexpr double kLeast = 4;
constexpr double kMost = 1e9;
constexpr char kLandscapeBudgets[] = "30,100,300,1000,3000";

constexpr char kBudgetFooter[] =
    "Examples:\n"
    "  lyrefit budget data/rtc_france --algorithms mlo,de,random --plot budget.svg\n"
    "  lyrefit budget data/rtc_france --models td --budgets 10,100,1000 --runs 20\n"
    "\n"
    "  lyrefit budget --landscape strings_2,strings_3 --devices 10 --budgets 100,1000\n"
    "\n"
    "A hit is a run within 1e-6 (search alone) or 1e-9 (polished) of the reference; of problems\n"
    "with effects and of --landscape one within 1e-6 of the best known optimum of its device.";

Expected<std::vector<std::int64_t>> ParseBudgets(const std::string& text) {
  const auto numbers = ParseNumbers("--budgets", text);
  if (!numbers) return tl::unexpected(numbers.error());
  std::vector<std::int64_t> budgets;
  for (const double number : *numbers) {
    if (!(number >= kLeast && number <= kMost && number == std::floor(number))) {
      return Fail(fmt::format("--budgets: expected whole numbers from {:g} to {:g}, found {:g}",
                              kLeast, kMost, number));
    }
    budgets.push_back(static_cast<std::int64_t>(number));
  }
  return budgets;
}

}  // namespace

BudgetCommand::BudgetCommand(CommandLine* line)
    : verb_(
          line->AddVerb("budget", "Evaluations each algorithm needs, by how far it is polished")) {
  flags_.options.plain_polish = true;
  flags_.options.rankings = false;
  AddStudyFlags(verb_, &flags_);
  AddLandscapeFlags(verb_, &flags_);
  AddAlgorithmsFlag(verb_, &flags_);
  verb_
      ->AddOption("--budgets", &budgets_,
                  "list of evaluations; the population is about their root (default " + budgets_ +
                      ", with --landscape " + kLandscapeBudgets + ")")
      .Type("LIST")
      .Group("Search");
  AddSearchRows(verb_,
                {"memory-rate", "distance-coefficient", "de-scale", "de-crossover", "elites"},
                &flags_);
  verb_
      ->AddOption("--plot", &plot_file_, "success rate over evaluations as a picture, .svg or .png")
      .Draws();
  verb_->Footer(kBudgetFooter);
}

Expected<std::vector<Contender>> BudgetCommand::Contenders() const {
  const auto names = ParseList("--algorithms", flags_.algorithms);
  if (!names) return tl::unexpected(names.error());
  const auto budgets = ParseBudgets(budgets_);
  if (!budgets) return tl::unexpected(budgets.error());
  std::vector<Contender> contenders;
  for (const std::string& name : *names) {
    if (name == ToText(ContenderKind::kShape) || name == ToText(ContenderKind::kDefault)) {
      contenders.push_back(*ParseContender(name, flags_.search, flags_.birds));  // has no budget
      continue;
    }
    for (const std::int64_t budget : *budgets) {
      auto contender = ParseContender(name, BudgetSearch(budget, flags_.search), flags_.birds);
      if (!contender) return tl::unexpected(contender.error());
      contender->name = fmt::format("{}@{}", name, budget);
      contender->budget = budget;
      contenders.push_back(std::move(*contender));
    }
  }
  return contenders;
}

int BudgetCommand::Run() {
  if (auto checked = CheckLandscape(*verb_, &flags_); !checked) return Refuse(checked.error());
  if (!flags_.landscape.empty() && !verb_->Given("--budgets")) budgets_ = kLandscapeBudgets;
  const auto contenders = Contenders();
  if (!contenders) return Refuse(contenders.error());
  return RunStudy(*verb_, flags_, *contenders, BudgetText, {{plot_file_, PlotBudget}});
}

}  // namespace lyrefit

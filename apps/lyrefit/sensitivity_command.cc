#include "sensitivity_command.h"

#include "lyrefit/study/report/documents.h"
#include "output.h"

namespace lyrefit {
namespace {

constexpr char kSensitivityFooter[] =
    "Examples:\n"
    "  lyrefit sensitivity data/rtc_france --bounds literature\n"
    "  lyrefit sensitivity data/rtc_france --models sd --memory-rates 0,0.5 --runs 20\n"
    "\n"
    "A memory rate of 0 switches the memory-based strategy off, a distance coefficient of 0 the\n"
    "diversity strategy.";

}  // namespace

SensitivityCommand::SensitivityCommand(CommandLine* line)
    : verb_(line->AddVerb("sensitivity", "MLO over a grid of its settings Pm and gamma")) {
  flags_.models = "td";
  flags_.search.population = 100;
  flags_.search.iterations = 1000;
  flags_.options.rankings = false;
  AddStudyFlags(verb_, &flags_).Required();
  const auto list = [this](const char* flag, const char* doc, std::string* target) {
    verb_->AddOption(flag, target, std::string(doc) + " (default " + *target + ")")
        .Type("LIST")
        .Group("Search");
  };
  list("--memory-rates", "list of Pm, rate of the memory-based strategy", &memory_rates_);
  list("--distance-coefficients", "list of gamma, reach of the diversity strategy",
       &distance_coefficients_);
  AddSearchRows(verb_, {"population", "iterations", "max-evaluations", "elites"}, &flags_);
  verb_->AddSwitch("--no-polish", &flags_.no_polish, "the search alone").Group("Polish");
  verb_->Footer(kSensitivityFooter);
}

int SensitivityCommand::Run() {
  const auto rates = ParseNumbers("--memory-rates", memory_rates_);
  if (!rates) return Refuse(rates.error());
  const auto coefficients = ParseNumbers("--distance-coefficients", distance_coefficients_);
  if (!coefficients) return Refuse(coefficients.error());
  return RunStudy(*verb_, flags_, SensitivityContenders(*rates, *coefficients, flags_.search),
                  SensitivityText, {});
}

}  // namespace lyrefit

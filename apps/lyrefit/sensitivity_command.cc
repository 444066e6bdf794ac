#include "lyrefit/base/try.h"
#include "lyrefit/study/report/documents.h"
#include "study_flags.h"
#include "verbs.h"

namespace lyrefit {
namespace {

constexpr char kSensitivityFooter[] =
    "Examples:\n"
    "  lyrefit sensitivity data/rtc_france --bounds literature\n"
    "  lyrefit sensitivity data/rtc_france --models sd --memory-rates 0,0.5 --runs 20\n"
    "\n"
    "A memory rate of 0 switches the memory-based strategy off, a distance coefficient of 0 the\n"
    "diversity strategy.";

struct SensitivityRequest {
  StudyFlags study;
  std::string memory_rates = "0,0.25,0.5,0.75,1";
  std::string distance_coefficients = "0,0.25,0.5,0.75,1";
};

void DeclareSensitivity(VerbLine* verb, SensitivityRequest* request) {
  StudyFlags& study = request->study;
  study.options.models = {Model::kTripleDiode};
  study.search.population = 100;
  study.search.iterations = 1000;
  study.options.rankings = false;
  AddStudyFlags(verb, &study);
  const auto list = [verb](const char* flag, const char* doc, std::string* target) {
    verb->AddOption(flag, target, std::string(doc) + " (default " + *target + ")")
        .Type("LIST")
        .Group("Search");
  };
  list("--memory-rates", "list of Pm, rate of the memory-based strategy", &request->memory_rates);
  list("--distance-coefficients", "list of gamma, reach of the diversity strategy",
       &request->distance_coefficients);
  AddSearchRows(verb, {"population", "iterations", "max-evaluations", "elites"}, &study);
  AddNamedFlags(verb, kCompareOptionTable, {"polish"}, &study.options);
}

Expected<int> RunSensitivity(VerbLine& verb, SensitivityRequest& request) {
  TRY(const auto rates, ParseNumbers("--memory-rates", request.memory_rates));
  TRY(const auto coefficients,
      ParseNumbers("--distance-coefficients", request.distance_coefficients));
  return RunStudy(verb, request.study,
                  SensitivityAlgorithms(rates, coefficients, request.study.search),
                  SensitivityDocument, {});
}

}  // namespace

const Verb kSensitivityVerb = {"sensitivity", "MLO over a grid of its settings Pm and gamma",
                               kSensitivityFooter, "its tables as text, --json, --csv and --html",
                               Declare<SensitivityRequest, DeclareSensitivity, RunSensitivity>};

}  // namespace lyrefit

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/study/algorithms.h"
#include "lyrefit/study/report/compare_csv.h"
#include "lyrefit/study/report/compare_plot.h"
#include "lyrefit/study/report/documents.h"
#include "pagmo_searcher.h"
#include "studies/landscape.h"
#include "studies/programs.h"
#include "studies/watch.h"

namespace lyrefit {
namespace {

constexpr double kLeastBudget = 4;
constexpr double kMostBudget = 1e9;

Expected<double> WholeNumber(const std::string& flag, const std::string& text, double least,
                             double most) {
  const std::optional<double> value = ParseNumber(text);
  if (!value || *value != std::floor(*value) || *value < least || *value > most) {
    return Fail(fmt::format("{}: expected a whole number from {:g} to {:g}, found '{}'", flag,
                            least, most, text));
  }
  return *value;
}

Expected<std::vector<std::string>> ListOf(const std::string& flag, const std::string& text) {
  auto parts = SplitList(text);
  if (!parts) return Fail(flag + ": " + parts.error().message);
  return parts;
}

Expected<ComparedAlgorithm> SearchNamed(const std::string& name, const SearchOptions& search) {
  const std::string pagmo = "pagmo:";
  if (name.rfind(pagmo, 0) == 0) return PagmoAlgorithm(name.substr(pagmo.size()), search);
  const std::optional<Algorithm> algorithm = FromText<Algorithm>(name);
  if (algorithm) return PlainAlgorithms({*algorithm}, search)[0];
  return Fail(
      fmt::format("--algorithms: expected a list of {}, shape, default or pagmo:NAME, found '{}'",
                  AllTexts<Algorithm>(), name));
}

Expected<std::vector<ComparedAlgorithm>> AlgorithmsOf(const std::string& names,
                                                      const std::string& budgets) {
  std::vector<ComparedAlgorithm> algorithms;
  TRY(const auto all, ListOf("--algorithms", names));
  TRY(const auto sizes, ListOf("--budgets", budgets));
  for (const std::string& name : all) {
    if (name == ToText(AlgorithmKind::kShape) || name == ToText(AlgorithmKind::kDefault)) {
      algorithms.push_back(OwnAlgorithm(*FromText<AlgorithmKind>(name)));  // has no budget
      continue;
    }
    for (const std::string& size : sizes) {
      TRY(const double budget, WholeNumber("--budgets", size, kLeastBudget, kMostBudget));
      const auto evaluations = static_cast<std::int64_t>(budget);
      TRY(ComparedAlgorithm compared, SearchNamed(name, BudgetSearch(evaluations)));
      compared.name = fmt::format("{}@{}", name, evaluations);
      compared.algorithm = name;
      compared.budget = evaluations;
      algorithms.push_back(std::move(compared));
    }
  }
  return algorithms;
}

Expected<std::vector<CompareCurve>> SubjectsOf(const std::string& problems, int devices,
                                               std::uint64_t seed) {
  std::vector<std::string> names;
  if (problems == "all") {
    for (const LandscapeProblem& problem : LandscapeProblems()) names.push_back(problem.name);
  } else {
    TRY(names, ListOf("--problems", problems));
  }
  std::vector<CompareCurve> subjects;
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (std::find(names.begin(), name, *name) != name) {
      return Fail(fmt::format("--problems: {} is named twice", *name));
    }
    TRY(auto cases, MakeLandscape(*name, devices, seed));
    for (LandscapeCase& made : cases) subjects.push_back(SubjectOf(std::move(made)));
  }
  return subjects;
}

}  // namespace

Expected<int> RunLandscape(ProgramFlags flags) {
  for (const char* own : {"models", "objective", "with"}) {
    if (flags.texts.count(own) == 0) continue;
    return Fail(fmt::format("--{}: every problem has its own", own));
  }
  if (!flags.files.empty()) return Fail("the problems are made: no curve is read");
  CompareOptions options;
  options.models = {Model::kSingleDiode};  // placeholder: every device has its own model
  options.runs = 1;
  options.multistart = 100;
  options.plain_polish = true;
  options.rankings = false;
  const char* peers = PagmoNames().empty() ? "" : ",pagmo:cmaes,pagmo:de";
  const std::string problems = Take("problems", "all", &flags);
  const std::string devices = Take("devices", "50", &flags);
  const std::string names =
      Take("algorithms", std::string("shape,default,mlo,lo,de,random") + peers, &flags);
  const std::string budgets = Take("budgets", "30,100,300,1000,3000", &flags);
  const std::string csv = Take("csv", "", &flags), plot = Take("plot", "", &flags);
  options.journal = Take("resume", "", &flags);
  TRY(TakeTable(kCompareOptionTable, &flags, &options));
  TRY(CheckNothingLeft(flags));
  TRY(const double count, WholeNumber("--devices", devices, 1, 1e4));
  TRY(const auto algorithms, AlgorithmsOf(names, budgets));
  TRY(const auto subjects, SubjectsOf(problems, static_cast<int>(count), options.seed));
  TRY(const Comparison comparison, Compare(subjects, algorithms, options, Watch));
  for (const std::string& remark : comparison.remarks) fmt::print(stderr, "{}\n", remark);
  if (!csv.empty()) TRY(WriteTextFile(csv, CompareCsv(comparison)));
  if (!plot.empty() && !comparison.problems.empty()) TRY(PlotBudget(comparison, plot));
  fmt::print("{}", BudgetText(comparison));
  if (comparison.interrupted) return kExitInterrupted;
  return comparison.journal_lacks_runs ? 1 : 0;
}

}  // namespace lyrefit

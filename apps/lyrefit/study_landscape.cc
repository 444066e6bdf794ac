#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/base/try.h"
#include "lyrefit/study/landscape.h"
#include "pagmo_searcher.h"
#include "study_flags.h"

namespace lyrefit {
namespace {

constexpr int kMultistart = 100;

}  // namespace

void AddLandscapeFlags(VerbLine* verb, StudyFlags* flags) {
  std::string names;
  for (const LandscapeProblem& problem : LandscapeProblems()) names += problem.name + ", ";
  verb->AddOption(
          "--landscape", &flags->landscape,
          "instead of curves a list of made problems with many local optima, summed up over "
          "their devices: " +
              names + "or all")
      .Type("LIST")
      .Group("Curves");
  AddNamedFlags(verb, kStudyFlagTable, {"devices"}, flags);
  AddNamedFlags(verb, kCompareOptionTable, {"multistart"}, &flags->options);
}

Expected<void> CheckLandscape(const VerbLine& verb, StudyFlags* flags) {
  const bool made = !flags->landscape.empty();
  if (made != flags->curve_files.empty()) {
    return Fail(made ? "--landscape: makes its own curves, and goes without CURVE"
                     : "CURVE is required, or --landscape");
  }
  if ((made || !flags->options.with.empty()) && !verb.Given("--multistart")) {
    flags->options.multistart = kMultistart;
  }
  if (!made) return {};
  for (const char* flag : {"--models", "--objective", "--with", "--bounds", "--at", "--curves"}) {
    if (!verb.Given(flag)) continue;
    return Fail(fmt::format("{}: every problem of --landscape has its own", flag));
  }
  flags->options.models = {Model::kSingleDiode};  // placeholder: every device has its own model
  if (!verb.Given("--runs")) flags->options.runs = 1;
  if (!verb.Given("--algorithms")) {
    flags->algorithms = "shape,default,mlo,lo,de,random";
    if (!PagmoNames().empty()) flags->algorithms += ",pagmo:cmaes,pagmo:de";
  }
  return {};
}

Expected<std::vector<CompareCurve>> LandscapeSubjects(const StudyFlags& flags) {
  std::vector<std::string> names;
  if (flags.landscape == "all") {
    for (const LandscapeProblem& problem : LandscapeProblems()) names.push_back(problem.name);
  } else {
    TRY(names, ParseList("--landscape", flags.landscape));
  }
  std::vector<CompareCurve> subjects;
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (std::find(names.begin(), name, *name) != name) {
      return Fail(fmt::format("--landscape: {} is named twice", *name));
    }
    auto cases = MakeLandscape(*name, flags.devices, flags.options.seed);
    if (!cases) {
      return Fail("--landscape: " + cases.error().message);
    }
    for (LandscapeCase& made : *cases) subjects.push_back(SubjectOf(std::move(made)));
  }
  return subjects;
}

}  // namespace lyrefit

#include "study_flags.h"

#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "pagmo_searcher.h"

namespace lyrefit {

void AddStudyFlags(VerbLine* verb, StudyFlags* flags) {
  verb->AddOption("CURVE", &flags->curve_files, "one or more curve files or folders")
      .ReadsCurves()
      .Required();
  AddTableFlags(verb, kConditionOptionTable, &flags->conditions);
  AddTableFlags(verb, kStudyFlagTable, flags);
  AddTableFlags(verb, kCompareOptionTable, &flags->options, "Model");
  AddBoundsFlag(verb, "Model", &flags->bounds);
  AddNamedFlags(verb, kStudyFlagTable, {"bound"}, flags);
  AddTableFlags(verb, kCompareOptionTable, &flags->options, "Runs");
  AddResumeFlag(verb, "run", &flags->options.journal);
  verb->AddOption("--json", &flags->output.json_file,
                  "everything as JSON; - for standard output, alone")
      .Writes();
  AddCsvFlag(verb, "one row a run", &flags->output);
  AddHtmlFlag(verb, "report", &flags->output);
  verb->AddQuietSwitch();
}

void AddAlgorithmsFlag(VerbLine* verb, StudyFlags* flags) {
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

void AddSearchRows(VerbLine* verb, const std::vector<std::string>& names, StudyFlags* flags) {
  for (OptionRow<SearchOptions> row : kSearchOptionTable) {
    if (std::find(names.begin(), names.end(), row.name) == names.end()) continue;
    row.traits = row.traits | OptionTrait::kUnchecked;  // checked by the study
    AddRowFlag(verb, row, "Search", &flags->search);
  }
}

Expected<std::vector<std::string>> ParseList(const std::string& flag, const std::string& text) {
  const auto parts = SplitList(text);
  if (!parts) return Fail(flag + ": " + parts.error().message);
  return *parts;
}

Expected<std::vector<double>> ParseNumbers(const std::string& flag, const std::string& text) {
  TRY(const auto parts, ParseList(flag, text));
  std::vector<double> numbers;
  for (const std::string& part : parts) {
    const std::optional<double> number = ParseNumber(part);
    if (!number) return Fail(fmt::format("{}: expected a number, found '{}'", flag, part));
    numbers.push_back(*number);
  }
  return numbers;
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

Expected<std::vector<ComparedAlgorithm>> ParseAlgorithms(const StudyFlags& flags) {
  TRY(const auto names, ParseList("--algorithms", flags.algorithms));
  std::vector<ComparedAlgorithm> algorithms;
  for (const std::string& name : names) {
    TRY(ComparedAlgorithm compared, ParseAlgorithm(name, flags.search));
    algorithms.push_back(std::move(compared));
  }
  return algorithms;
}

}  // namespace lyrefit

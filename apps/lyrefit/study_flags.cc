#include "study_flags.h"

#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/curve/number_text.h"
#include "pagmo_searcher.h"

namespace lyrefit {

Flag AddStudyFlags(Verb* verb, StudyFlags* flags) {
  Flag curves = verb->AddOption("CURVE", &flags->curve_files, "one or more curve files or folders");
  curves.ReadsCurves();
  AddConditionFlags(verb, &flags->conditions);
  verb->AddOption("--at", &flags->at,
                  "of a set of curves: those nearest to 1000x25,200x25 (W/m2 x C; 10 W/m2 are as "
                  "far as 1 K)")
      .Type("LIST")
      .Group("Curves");
  verb->AddOption("--curves", &flags->curve_ids, "of a set of curves: those with these ids")
      .Type("LIST")
      .Group("Curves");
  verb->AddOption("--models", &flags->models,
                  "list of " + AllTexts<Model>() + " (default " + flags->models + ")")
      .Type("LIST")
      .Group("Model");
  AddEnumFlag(verb, "--objective", "which residual is squared", &flags->options.objective)
      .Group("Model");
  AddEnumFlag(verb, "--constants", "values of k and q", &flags->options.constants).Group("Model");
  AddWithFlag(verb, "Model", &flags->with);
  AddBoundsFlags(verb, "Model", &flags->bounds);
  const auto number = [verb](const char* name, auto* target, const std::string& doc) {
    verb->AddOption(name, target, doc + " (default " + NumberText(*target) + ")")
        .Type("NUMBER")
        .Group("Runs");
  };
  number("--runs", &flags->options.runs, "runs of each algorithm on each problem");
  number("--seed", &flags->options.seed, "seed of all runs; run r has its own stream");
  verb->AddOption("--threads", &flags->options.threads,
                  "0: all cores; never changes a result but the seconds (default 0)")
      .Between(0, 1024)
      .Type("N")
      .Group("Runs");
  AddResumeFlag(verb, "run", &flags->options.journal);
  verb->AddOption("--json", &flags->json_file, "everything as JSON; - for standard output, alone")
      .Writes();
  verb->AddOption("--csv", &flags->csv_file, "one row a run; - for standard output, alone")
      .Writes();
  verb->AddQuietSwitch();
  return curves;
}

void AddAlgorithmsFlag(Verb* verb, StudyFlags* flags) {
  const std::string peers = PagmoNames();
  const std::string pagmo = peers.empty() ? "; pagmo:NAME in a build with pagmo2"
                                          : "; pagmo:NAME with NAME one of " + peers;
  verb->AddOption("--algorithms", &flags->algorithms,
                  "list of " + AllTexts<Algorithm>() +
                      ", shape (starts from the curve's shape alone), "
                      "default (the fit with its default settings)" +
                      pagmo + " (default " + flags->algorithms + ")")
      .Type("LIST")
      .Group("Search");
  AddBirdsFlag(verb, &flags->birds);
}

void AddSearchRows(Verb* verb, const std::vector<std::string>& names, StudyFlags* flags) {
  for (const OptionRow<SearchOptions>& row : kSearchOptionTable) {
    if (std::find(names.begin(), names.end(), row.name) == names.end()) continue;
    const FlagTarget target =
        std::visit([flags](auto field) { return FlagTarget(&(flags->search.*field)); }, row.field);
    verb->AddOption(std::string("--") + row.name, target, RowHelp(row, flags->search))
        .Type(*row.unit != '\0' ? row.unit : "NUMBER")
        .Group("Search");
  }
}

void AddPolishLevelFlags(Verb* verb, StudyFlags* flags) {
  verb->AddSwitch("--no-polish", &flags->no_polish, "the search alone").Group("Polish");
  verb->AddSwitch("--plain-polish", &flags->options.plain_polish,
                  "also one bounded least-squares solve from the best bird, and nothing more")
      .Group("Polish");
}

Expected<std::vector<std::string>> ParseList(const std::string& flag, const std::string& text) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = text.find(',', begin);
    parts.push_back(text.substr(begin, end - begin));
    if (parts.back().empty()) {
      return Fail(fmt::format("{}: expected a list such as a,b,c, found '{}'", flag, text));
    }
  }
  return parts;
}

Expected<std::vector<double>> ParseNumbers(const std::string& flag, const std::string& text) {
  const auto parts = ParseList(flag, text);
  if (!parts) return tl::unexpected(parts.error());
  std::vector<double> numbers;
  for (const std::string& part : *parts) {
    const std::optional<double> number = ParseNumber(part);
    if (!number) return Fail(fmt::format("{}: expected a number, found '{}'", flag, part));
    numbers.push_back(*number);
  }
  return numbers;
}

Expected<std::vector<Model>> ParseModels(const std::string& text) {
  const auto names = ParseList("--models", text);
  if (!names) return tl::unexpected(names.error());
  std::vector<Model> models;
  for (const std::string& name : *names) {
    const std::optional<Model> model = FromText<Model>(name);
    if (!model) {
      return Fail(
          fmt::format("--models: expected a list of {}, found '{}'", AllTexts<Model>(), name));
    }
    models.push_back(*model);
  }
  return models;
}

Expected<Contender> ParseContender(const std::string& name, const SearchOptions& search,
                                   Birds birds) {
  for (const ContenderKind kind : {ContenderKind::kShape, ContenderKind::kDefault}) {
    if (name == ToText(kind)) return OwnContender(kind);
  }
  const std::string pagmo = "pagmo:";
  if (name.rfind(pagmo, 0) == 0) {
    auto peer = PagmoContender(name.substr(pagmo.size()), search);
    if (peer) peer->birds = birds;
    return peer;
  }
  const std::optional<Algorithm> algorithm = FromText<Algorithm>(name);
  if (!algorithm) {
    return Fail(
        fmt::format("--algorithms: expected a list of {}, shape, default or pagmo:NAME, found '{}'",
                    AllTexts<Algorithm>(), name));
  }
  Contender contender = PlainContenders({*algorithm}, search)[0];
  contender.birds = birds;
  return contender;
}

Expected<std::vector<Contender>> ParseContenders(const StudyFlags& flags) {
  const auto names = ParseList("--algorithms", flags.algorithms);
  if (!names) return tl::unexpected(names.error());
  std::vector<Contender> contenders;
  for (const std::string& name : *names) {
    auto contender = ParseContender(name, flags.search, flags.birds);
    if (!contender) return tl::unexpected(contender.error());
    contenders.push_back(std::move(*contender));
  }
  return contenders;
}

}  // namespace lyrefit

#include "faults/study.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>

namespace faults {

Mode ModeOf(const StudyOptions& options) {
  const bool field = options.asked.empty() ? options.mode == "field" : options.asked == "field";
  return field ? Mode::kField : Mode::kLaboratory;
}

double Percent(int part, int whole) {
  return whole > 0 ? 100.0 * part / whole : std::numeric_limits<double>::quiet_NaN();
}

std::vector<const Injection*> HidesCalled(const std::string& name, Kind kind) {
  std::vector<const Injection*> injections;
  for (const Injection& injection : Injections()) {
    if (Shows(injection, kind) && (name == "all" || name == injection.name))
      injections.push_back(&injection);
  }
  return injections;
}

Request RequestFor(const StudyOptions& options, Kind kind, const Injection& injection, int number,
                   double lowest, double highest) {
  std::uint64_t name = 0;
  for (const char* letter = injection.name; *letter; ++letter) name = 131 * name + *letter;
  Request request;
  request.kind = kind;
  request.injections = {&injection};
  request.seed = SeedOf(options.seed, name, static_cast<int>(kind), number);
  request.misfit = Random(request.seed).LogUniform(lowest, highest);
  return request;
}

Case NullFor(const StudyOptions& options, Kind kind, int number) {
  const std::uint64_t seed = SeedOf(options.seed, number);
  return MakeNull(kind, static_cast<NoiseType>(number % kNoiseTypes), seed);
}

std::vector<Run> RunCases(const StudyOptions& options, Kind kind, const Injection& injection,
                          int cases, double lowest, double highest) {
  std::vector<Run> runs(cases);
  ForEach(cases, options.threads, [&](int i) {
    const Request request = RequestFor(options, kind, injection, i, lowest, highest);
    const std::optional<Case> made = MakeCase(request);
    if (!made) return;
    runs[i] = {
        true, *made,
        Ask(made->measurement, i, options.probability, request.seed, false, ModeOf(options))};
  });
  return runs;
}

std::string Text(const Answer& answer) {
  std::string text = answer.error;
  for (const Claim& claim : answer.claims) {
    if (!text.empty()) text += " ";
    text += claim.id;
    for (const std::string& other : claim.equivalents) text += "|" + other;
    for (const std::string& other : claim.beside) text += "/" + other;
  }
  return text.empty() ? "-" : text;
}

namespace {

constexpr const char* kUsage =
    "fault_study MODE [--kind fwd|rev|updown|dark|famG|famGT|all] [--effect ID|all] [--cases N]\n"
    "             [--probability P] [--seed N] [--threads N] [--csv FILE]\n"
    "             [--rows FILE] [--number I]\n"
    "MODE: silence, power, pairs, show\n"
    "fault_study calibration [--asked laboratory|field | --real FOLDER] [--cases N] [--csv FILE]\n"
    "fault_study field [--effect KIND|all] [--cases N] [--misfit-above PERCENT] [--rows FILE]\n"
    "             [--show KIND --number I] [--dump FOLDER]\n";

bool Read(int argc, char** argv, StudyOptions* options) {
  if (argc < 2) return false;
  options->mode = argv[1];
  const std::map<std::string, std::function<void(const char*)>> flags = {
      {"--kind", [&](const char* text) { options->kind = text; }},
      {"--effect", [&](const char* text) { options->effect = text; }},
      {"--cases", [&](const char* text) { options->cases = std::atoi(text); }},
      {"--asked", [&](const char* text) { options->asked = text; }},
      {"--probability", [&](const char* text) { options->probability = std::atof(text); }},
      {"--real", [&](const char* text) { options->real = text; }},
      {"--seed", [&](const char* text) { options->seed = std::strtoull(text, nullptr, 10); }},
      {"--threads", [&](const char* text) { options->threads = std::atoi(text); }},
      {"--rows", [&](const char* text) { options->rows = text; }},
      {"--number", [&](const char* text) { options->number = std::atoi(text); }},
      {"--csv", [&](const char* text) { options->csv = text; }},
      {"--misfit-above", [&](const char* text) { options->misfit_above = std::atof(text); }},
      {"--show", [&](const char* text) { options->show = text; }},
      {"--dump", [&](const char* text) { options->dump = text; }},
  };
  for (int i = 2; i < argc; i += 2) {
    const auto flag = flags.find(argv[i]);
    if (flag == flags.end() || i + 1 == argc) return false;
    flag->second(argv[i + 1]);
  }
  if (options->mode == "field") return true;  // the mode has its own kinds
  const bool known = options->effect == "all" || FindInjection(options->effect) != nullptr;
  return known && !KindsCalled(options->kind).empty();
}

}  // namespace
}  // namespace faults

int main(int argc, char** argv) {
  using namespace faults;
  const std::map<std::string, int (*)(const StudyOptions&)> modes = {
      {"silence", StudySilence}, {"power", StudyPower}, {"pairs", StudyPairs},
      {"show", ShowCase},        {"field", StudyField}, {"calibration", StudyCalibration}};
  StudyOptions options;
  if (!Read(argc, argv, &options) || modes.count(options.mode) == 0) {
    std::fputs(kUsage, stderr);
    return 2;
  }
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  return modes.at(options.mode)(options);
}

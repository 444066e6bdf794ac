#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "faults/study.h"

namespace faults {
namespace {

// Whether two effects can act in one scene and the data can distinguish them.
bool GoTogether(const Injection& a, const Injection& b) {
  static const std::vector<std::string> kAlone = {"quantisation", "temperature_or_cells"};
  static const std::vector<std::vector<std::string>> kApart = {
      {"capacitance", "timing_skew", "shading", "mismatch"},
      {"nonohmic_shunt", "collection", "photoshunt", "breakdown"},
      {"current_offset", "sensor_offset", "voltage_offset"},
      {"temp_offset", "bandgap", "voltage_offset"},
      {"drift", "temp_drift"},
  };
  const auto holds = [](const std::vector<std::string>& names, const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (holds(kAlone, a.name) || holds(kAlone, b.name)) return false;
  return std::none_of(kApart.begin(), kApart.end(), [&](const std::vector<std::string>& names) {
    return holds(names, a.name) && holds(names, b.name);
  });
}

std::optional<Case> MakePair(Kind kind, std::uint64_t seed) {
  Random random(seed);
  const std::vector<const Injection*> injections = HidesCalled("all", kind);
  for (int i = 0; i < 20; ++i) {
    const int count = static_cast<int>(injections.size());
    const Injection* a = injections[random.Index(count)];
    const Injection* b = injections[random.Index(count)];
    if (a >= b || !GoTogether(*a, *b)) continue;
    Request request;
    request.kind = kind;
    request.injections = {a, b};
    request.misfit = random.LogUniform(12, 30);
    request.seed = SeedOf(seed, i);
    if (std::optional<Case> made = MakeCase(request)) return made;
  }
  return std::nullopt;
}

}  // namespace

int StudyPairs(const StudyOptions& options) {
  const int cases = options.cases > 0 ? options.cases : 100;
  std::printf("%-7s %5s %7s %7s %7s %9s %7s\n", "kind", "pairs", "both%", "one%", "none%", "claims",
              "s/case");
  for (const Kind kind : KindsCalled(options.kind)) {
    std::vector<Run> runs(cases);
    ForEach(cases, options.threads, [&](int i) {
      const std::uint64_t seed = SeedOf(options.seed, 77, static_cast<int>(kind), i);
      const std::optional<Case> made = MakePair(kind, seed);
      if (!made) return;
      runs[i] = {true, *made,
                 Ask(made->measurement, i, options.probability, seed, false, ModeOf(options))};
    });
    int made = 0, named[3] = {}, claims = 0;
    double seconds = 0;
    std::map<std::string, int> missed;
    for (const Run& run : runs) {
      if (!run.made) continue;
      ++made;
      claims += static_cast<int>(Counted(run.with_fault, run.answer).size());
      seconds += run.answer.seconds;
      const bool first = ScoreCase(run.with_fault, run.answer, 0).named;
      const bool second = ScoreCase(run.with_fault, run.answer, 1).named;
      ++named[first + second];
      if (!first)
        ++missed[run.with_fault.causes[0].name + " beside " + run.with_fault.causes[1].name];
      if (!second)
        ++missed[run.with_fault.causes[1].name + " beside " + run.with_fault.causes[0].name];
    }
    std::printf("%-7s %5d %7.1f %7.1f %7.1f %9.2f %7.3f\n", Name(kind), made,
                Percent(named[2], made), Percent(named[1], made), Percent(named[0], made),
                made > 0 ? static_cast<double>(claims) / made : 0, made > 0 ? seconds / made : 0);
    for (const auto& [name, count] : missed)
      std::printf("        missed %s %d\n", name.c_str(), count);
  }
  return 0;
}

}  // namespace faults

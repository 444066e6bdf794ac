#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "faults/study.h"

namespace faults {
namespace {

struct Quiet {
  Case with_fault;
  Answer answer;
};

struct Alarms {
  int cases = 0;
  int loose = 0;   // alarms at the requested probability
  int strict = 0;  // alarms at 0.01, or from parameter values
  int failed = 0;
  double seconds = 0;
  std::map<std::string, int> names;
  std::map<std::string, int> absorbed;  // absorbed effects in the cases with an alarm
};

bool Strict(const Claim& claim) { return claim.by_values || claim.probability > 0.99; }

void Count(const Quiet& run, Alarms* alarms) {
  ++alarms->cases;
  alarms->failed += !run.answer.error.empty();
  alarms->seconds += run.answer.seconds;
  const std::vector<Claim> claims = Counted(run.with_fault, run.answer);
  if (claims.empty()) return;
  ++alarms->loose;
  alarms->strict += std::any_of(claims.begin(), claims.end(), Strict);
  for (const Claim& claim : claims) ++alarms->names[claim.id];
  ++alarms->absorbed[run.with_fault.second_diode ? "second_diode device" : run.with_fault.absorbed];
}

void Print(const char* kind, const char* noise, const Alarms& alarms) {
  const double rate = Percent(alarms.loose, alarms.cases);
  const double error = std::sqrt(rate * (100 - rate) / std::max(1, alarms.cases));
  std::printf("%-7s %-13s %6d %6.2f +- %4.2f %7.2f %8.3f %7d ", kind, noise, alarms.cases, rate,
              error, Percent(alarms.strict, alarms.cases),
              alarms.seconds / std::max(1, alarms.cases), alarms.failed);
  for (const auto& [name, count] : alarms.names) std::printf(" %s %d", name.c_str(), count);
  std::printf("\n");
}

void PrintInside(const Alarms& alarms) {
  std::printf("   alarmed with inside:");
  for (const auto& [name, count] : alarms.absorbed) std::printf("  %s %d", name.c_str(), count);
  std::printf("\n");
}

}  // namespace

int StudySilence(const StudyOptions& options) {
  const int cases = options.cases > 0 ? options.cases : 1000;
  std::printf("%-7s %-13s %6s %14s %7s %8s %7s  %s\n", "kind", "noise", "cases", "alarms % +- se",
              "at .01", "s/case", "errors", "falsely named");
  Alarms total;
  for (const Kind kind : KindsCalled(options.kind)) {
    std::vector<Quiet> runs(cases);
    ForEach(cases, options.threads, [&](int i) {
      runs[i].with_fault = NullFor(options, kind, i);
      runs[i].answer =
          Ask(runs[i].with_fault.measurement, i, options.probability, SeedOf(options.seed, i),
              runs[i].with_fault.second_diode, ModeOf(options));
    });
    Alarms independent;
    for (int type = 0; type < kNoiseTypes; ++type) {
      Alarms alarms;
      for (int i = type; i < cases; i += kNoiseTypes) {
        Count(runs[i], &alarms);
        if (static_cast<NoiseType>(type) == NoiseType::kCorrelated) continue;
        Count(runs[i], &independent);
        Count(runs[i], &total);
      }
      Print(Name(kind), Name(static_cast<NoiseType>(type)), alarms);
    }
    Print(Name(kind), "independent", independent);
    PrintInside(independent);
  }
  Print("all", "independent", total);
  PrintInside(total);
  return 0;
}

}  // namespace faults

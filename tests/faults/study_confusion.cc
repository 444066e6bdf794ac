#include <algorithm>
#include <cstdio>
#include <map>

#include "faults/study.h"

namespace faults {

int StudyConfusion(const StudyOptions& options) {
  const int cases = options.cases > 0 ? options.cases : 100;
  std::printf("%-7s %-21s %5s  %s\n", "kind", "effect", "cases", "first name, % of cases");
  for (const Kind kind : KindsCalled(options.kind)) {
    for (const Injection* injection : HidesCalled(options.effect, kind)) {
      std::map<std::string, int> firsts;
      int made = 0;
      for (const Run& run : RunCases(options, kind, *injection, cases, 7, 25)) {
        if (!run.made) continue;
        ++made;
        ++firsts[ScoreCase(run.with_fault, run.answer).first];
      }
      std::vector<std::pair<int, std::string>> order;
      for (const auto& [name, count] : firsts) order.push_back({-count, name});
      std::sort(order.begin(), order.end());
      std::printf("%-7s %-21s %5d ", Name(kind), injection->name, made);
      for (const auto& [count, name] : order) {
        std::printf(" %s %.0f", name.c_str(), Percent(-count, made));
      }
      std::printf("\n");
    }
  }
  return 0;
}

}  // namespace faults

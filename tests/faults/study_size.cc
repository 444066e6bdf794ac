#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "faults/study.h"
#include "lyrefit/base/median.h"

namespace faults {
namespace {}  // namespace

int StudySize(const StudyOptions& options) {
  const int cases = options.cases > 0 ? options.cases : 100;
  std::printf("%-7s %-21s %5s %7s %8s %10s  %s\n", "kind", "effect", "sized", "holds%", "median",
              "half width", "(ratios to the truth)");
  for (const Kind kind : KindsCalled(options.kind)) {
    for (const Injection* injection : HidesCalled(options.effect, kind)) {
      int sized = 0, holds = 0, plain = 0;
      std::vector<double> ratios, widths;
      for (const Run& run : RunCases(options, kind, *injection, cases, 7, 25)) {
        if (!run.made || run.with_fault.causes[0].size.unit == nullptr) continue;
        ++plain;
        const Cause& cause = run.with_fault.causes[0];
        const std::optional<Sized> size = SizeOf(cause, run.answer);
        if (!size) continue;
        ++sized;
        holds += size->low <= cause.size.value && cause.size.value <= size->high;
        ratios.push_back(size->value / cause.size.value);
        widths.push_back(std::fabs((size->high - size->low) / 2 / cause.size.value));
      }
      if (plain == 0) continue;
      std::printf("%-7s %-21s %5d %7.1f %8.3f %10.3f\n", Name(kind), injection->name, sized,
                  Percent(holds, sized), lyrefit::UpperMedian(ratios),
                  lyrefit::UpperMedian(widths));
    }
  }
  return 0;
}

}  // namespace faults

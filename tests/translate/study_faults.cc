#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "lyrefit/base/parallel.h"
#include "lyrefit/translate/key_point_noise.h"
#include "lyrefit/translate/translate.h"
#include "translate/carried.h"
#include "translate/study.h"
#include "translate/translation_simulators.h"

namespace shown {
namespace {

using lyrefit::Procedure;

constexpr Procedure kAll[] = {Procedure::kIec1,   Procedure::kIec2,   Procedure::kIec4,
                              Procedure::kDeSoto, Procedure::kPvsyst, Procedure::kExtended};

// Translation of one faulty module; errors are relative, of Pmax.
struct Answer {
  std::map<Procedure, double> errors;
  double recommended = 0;
  double expanded = 0;
  bool by_extended = false;
  bool any = false;
};

Answer Ask(const SyntheticCase& made) {
  lyrefit::TranslateOptions options = ReadyOptions(true);
  options.coefficients = made.coefficients;
  lyrefit::UncertaintyOptions& sizes = options.uncertainty;
  sizes.draws = 0;
  sizes.threads = 1;
  sizes.irradiance_percent = sizes.temperature_K = sizes.cell_offset_K = 0.0;
  sizes.voltage_percent = sizes.current_percent = sizes.alpha_percent = sizes.beta_percent = 0.0;
  Answer answer;
  const auto report = lyrefit::TranslateCurve(made.curve, options);
  if (!report) {
    std::fprintf(stderr, "%s\n", report.error().message.c_str());
    return answer;
  }
  for (const lyrefit::TranslatedResult& result : report->results) {
    if (!result.computed()) continue;
    answer.errors[result.procedure] = result.key_points.max_power_W / made.stc.max_power_W - 1;
  }
  const lyrefit::TranslatedResult* best = report->Recommended();
  if (best == nullptr || best->budget.outputs.empty()) return answer;
  answer.any = true;
  answer.recommended = answer.errors[best->procedure];
  answer.expanded =
      best->budget.outputs[lyrefit::kMaxPowerOutput].expanded_uncertainty / made.stc.max_power_W;
  answer.by_extended = best->procedure == Procedure::kExtended;
  return answer;
}

// Prints "-1.2 (2.3)", mean and rms in %, or a dash if there are no results.
void PrintErrors(const std::vector<double>& errors) {
  if (errors.empty()) {
    std::printf(" - |");
    return;
  }
  double sum = 0, squares = 0;
  for (const double error : errors) {
    sum += error;
    squares += error * error;
  }
  const double n = static_cast<double>(errors.size());
  std::printf(" %+.1f (%.1f) |", 100 * sum / n, 100 * std::sqrt(squares / n));
}

void PrintRow(const std::string& kind, const std::vector<Answer>& answers) {
  std::printf("| %s |", kind.c_str());
  for (const Procedure procedure : kAll) {
    std::vector<double> errors;
    for (const Answer& answer : answers) {
      const auto found = answer.errors.find(procedure);
      if (found != answer.errors.end()) errors.push_back(found->second);
    }
    PrintErrors(errors);
  }
  std::vector<double> errors;
  double within = 0, expanded = 0, by_extended = 0;
  for (const Answer& answer : answers) {
    if (!answer.any) continue;
    errors.push_back(answer.recommended);
    within += std::fabs(answer.recommended) <= answer.expanded;
    expanded += answer.expanded;
    by_extended += answer.by_extended;
  }
  PrintErrors(errors);
  const double n = std::max<double>(1, static_cast<double>(errors.size()));
  std::printf(" %.0f %% | %.1f %% | %.0f %% |\n", 100 * by_extended / n, 100 * expanded / n,
              100 * within / n);
  std::fflush(stdout);
}

}  // namespace

int StudyFaults(const StudyOptions& options) {
  const int cases = options.cases > 0 ? options.cases : 24;
  constexpr struct {
    double irradiance_W_m2, temperature_C;
  } kSources[] = {{800, 45}, {500, 35}, {200, 20}};
  for (const auto& from : kSources) {
    std::printf(
        "From %g W/m2, %g C: error of Pmax in %%, mean (rms) of %d modules\n\n| fault | iec1 | "
        "iec2 | "
        "iec4 | desoto | pvsyst | extended | recommended | of them extended | mean U of the "
        "procedure | "
        "within U |\n|---|---|---|---|---|---|---|---|---|---|---|\n",
        from.irradiance_W_m2, from.temperature_C, cases);
    for (const std::string& kind : FaultKinds()) {
      std::vector<Answer> answers(cases);
      lyrefit::ParallelFor(cases, options.threads, [&](int i) {
        answers[i] = Ask(
            MakeFaulty(kind, from.irradiance_W_m2, from.temperature_C, 1000 * options.seed + i));
      });
      PrintRow(kind, answers);
    }
    std::printf("\n");
  }
  return 0;
}

}  // namespace shown

#include "faults/study_field.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "faults/field_score.h"

namespace faults {
namespace {

struct FieldRun {
  field::Case with_fault;
  Answer answer;
  field::CaseScore score;
};

// Errors of one quantity over the accepted claims.
struct Agreement {
  std::vector<double> errors;
  int intervals = 0;
  int holds = 0;
};

Agreement AgreementOf(const std::vector<FieldRun>& runs, const std::string& quantity) {
  Agreement agreement;
  for (const FieldRun& run : runs) {
    for (const field::Compared& compared : run.score.compared) {
      if (compared.quantity != quantity) continue;
      agreement.errors.push_back(std::fabs(compared.value - compared.truth));
      agreement.intervals += compared.interval;
      agreement.holds += compared.holds;
    }
  }
  std::sort(agreement.errors.begin(), agreement.errors.end());
  return agreement;
}

void PrintAgreement(const std::vector<FieldRun>& runs, const char* quantity) {
  const Agreement agreement = AgreementOf(runs, quantity);
  const std::vector<double>& errors = agreement.errors;
  if (errors.empty()) return;
  const auto near = std::upper_bound(errors.begin(), errors.end(), 0.02) - errors.begin();
  std::printf("  %s: %zu read, median off %.4f, within 0.02 %.0f %%", quantity, errors.size(),
              errors[errors.size() / 2], Percent(static_cast<int>(near), errors.size()));
  if (agreement.intervals > 0) {
    std::printf(", interval holds %.0f %% of %d", Percent(agreement.holds, agreement.intervals),
                agreement.intervals);
  }
  std::printf(";");
}

void PrintTable(const std::string& kind, const std::vector<FieldRun>& runs) {
  const int cases = static_cast<int>(runs.size());
  int named = 0, first = 0, any = 0, claims = 0, in_set = 0, spurious = 0, failed = 0;
  double seconds = 0, slowest = 0, misfit = 0;
  for (const FieldRun& run : runs) {
    named += run.score.named;
    first += run.score.first_right;
    any += run.score.any_right;
    claims += run.score.claims;
    in_set += run.score.in_set;
    spurious += run.score.spurious;
    failed += !run.answer.error.empty();
    seconds += run.answer.seconds / cases;
    misfit += run.with_fault.misfit / cases;
    slowest = std::max(slowest, run.answer.seconds);
  }
  std::printf("%-13s %5d %7.2f %7.1f %7.1f %7.1f %6d %7.1f %7.1f %7.2f %7.2f %6d", kind.c_str(),
              cases, misfit, Percent(named, cases), Percent(first, cases), Percent(any, cases),
              claims, Percent(in_set, claims), Percent(spurious, claims), seconds, slowest, failed);
  for (const char* quantity :
       {"light", "share", "width", "step", "dip", "drift", "gain", "power", "least power"}) {
    PrintAgreement(runs, quantity);
  }
  std::printf("\n");
}

void PrintRows(const std::string& kind, const std::vector<FieldRun>& runs, std::FILE* rows) {
  for (std::size_t i = 0; i < runs.size() && rows != nullptr; ++i) {
    const FieldRun& run = runs[i];
    std::string read;
    char part[96];
    for (const field::Compared& compared : run.score.compared) {
      std::snprintf(part, sizeof part, " %s %.4g for %.4g%s", compared.quantity.c_str(),
                    compared.value, compared.truth, compared.holds ? " held" : "");
      read += part;
    }
    std::fprintf(rows, "%s,%zu,%d,%d,%zu,%.4f,%.4f,%d,%d,%d,%d,%.3f,%s,%s,%s\n", kind.c_str(), i,
                 run.with_fault.measurement.cells, run.with_fault.make.half_cut,
                 run.with_fault.measurement.voltage.size(), run.with_fault.healthy,
                 run.with_fault.misfit, run.score.first_right, run.score.any_right,
                 run.score.in_set, run.score.spurious, run.answer.seconds,
                 FiguresOf(run.with_fault).c_str(), Text(run.answer).c_str(), read.c_str());
  }
}

}  // namespace

std::uint64_t FieldSeed(const StudyOptions& options, const std::string& kind, int number) {
  std::uint64_t name = 0;
  for (const char letter : kind) name = 131 * name + static_cast<unsigned char>(letter);
  return SeedOf(options.seed, name, number, 7);
}

field::Case FieldCase(const StudyOptions& options, const std::string& kind, int number) {
  // No minimum misfit for three faults. A single diode fits the curve of a shorted group as well as
  // that of a healthy module; bins and limits change the readings, not the curve.
  const bool any = kind.rfind("clean", 0) == 0 || kind == "bypass_short" ||
                   kind == "voltage_bins" || kind == "limits";
  return field::MakeCaseAbove(kind, any ? 0 : options.misfit_above,
                              FieldSeed(options, kind, number));
}

std::string Joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::string FiguresOf(const field::Case& with_fault) {
  std::string text;
  char part[64];
  for (const field::Figure& figure : with_fault.truth.figures) {
    std::snprintf(part, sizeof part, "%s%s %.4g", text.empty() ? "" : ", ", figure.quantity.c_str(),
                  figure.value);
    text += part;
  }
  return text;
}

int StudyField(const StudyOptions& options) {
  std::vector<std::string> kinds;
  for (const std::string& kind : field::Kinds()) {
    const std::string& wanted = options.show.empty() ? options.effect : options.show;
    if (wanted == "all" || wanted == kind) kinds.push_back(kind);
  }
  if (kinds.empty()) {
    std::fprintf(stderr, "kinds: %s\n", Joined(field::Kinds()).c_str());
    return 2;
  }
  const int cases = options.cases > 0 ? options.cases : 200;
  if (!options.show.empty()) return ShowFieldCase(options);
  if (!options.dump.empty()) return DumpFieldCases(options, kinds, cases);
  std::FILE* rows = options.rows.empty() ? nullptr : std::fopen(options.rows.c_str(), "w");
  if (rows == nullptr && !options.rows.empty()) return std::perror(options.rows.c_str()), 1;
  if (rows != nullptr) {
    std::fputs(
        "kind,number,cells,half_cut,readings,healthy,misfit,first_right,any_right,in_set,spurious,"
        "seconds,truth,answer,read\n",
        rows);
  }
  std::printf("%-13s %5s %7s %7s %7s %7s %6s %7s %7s %7s %7s %6s\n", "kind", "cases", "misfit%",
              "named%", "first%", "any%", "claims", "in set%", "spur.%", "s/case", "slowest",
              "errors");
  for (const std::string& kind : kinds) {
    std::vector<FieldRun> runs(cases);
    ForEach(cases, options.threads, [&](int i) {
      FieldRun& run = runs[i];
      run.with_fault = FieldCase(options, kind, i);
      run.answer = Ask(run.with_fault.measurement, i, options.probability,
                       FieldSeed(options, kind, i), false, ModeOf(options));
      run.score = field::ScoreCase(run.with_fault, run.answer);
    });
    PrintTable(kind, runs);
    PrintRows(kind, runs, rows);
  }
  if (rows != nullptr) std::fclose(rows);
  return 0;
}

}  // namespace faults

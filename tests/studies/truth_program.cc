#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/estimate/fit/bounds.h"
#include "lyrefit/estimate/fit/error_spec.h"
#include "lyrefit/family/family_documents.h"
#include "lyrefit/family/fit_family.h"
#include "lyrefit/family/fit_individually.h"
#include "lyrefit/read/read_curve_set.h"
#include "lyrefit/report/csv.h"
#include "studies/programs.h"
#include "studies/truth.h"
#include "studies/watch.h"

namespace lyrefit {
namespace {

constexpr OptionRow<FamilyOptions> kTruthTable[] = {
    {"bound", "P=LOWER:UPPER", "range of one parameter; once for each",
     RangesOption<&FamilyOptions::bounds>()},
    {"noise", "NAME", "errors of the readings, of curves fitted alone",
     NoiseOption<&FamilyOptions::errors>()},
    {"threads", "N", "0: all cores", &FamilyOptions::threads, 0, kMostThreads},
};

}  // namespace

Expected<int> RunTruth(ProgramFlags flags) {
  FamilyOptions options;
  const std::string family = Take("family", "free", &flags);
  const std::string csv = Take("csv", "", &flags);
  TRY(TakeTable(kTruthTable, &flags, &options));
  TRY(CheckNothingLeft(flags));
  const std::optional<TranslationLaw> law = FromText<TranslationLaw>(family);
  if (!law && family != "free") {
    return Fail(fmt::format("--family: expected free or one of {}, found '{}'",
                            AllTexts<TranslationLaw>(), family));
  }
  if (flags.files.size() != 2) return Fail("expected a set of curves and a table of their truth");
  TRY(const CurveSet set, ReadCurveSet(flags.files[0]));
  TRY(const auto truth, ReadTruth(flags.files[1]));
  if (law) {
    options.law = *law;
  } else {
    options.search = SearchOptions();
  }
  TRY(const FamilyReport report,
      law ? FitFamily(set, options, Watch) : FitIndividually(set, options, Watch));
  if (!csv.empty()) TRY(WriteTextFile(csv, IndividualFitsCsv(report)));
  fmt::print("{}", TruthText(CompareWithTruth(report, truth)));
  return report.interrupted ? kExitInterrupted : report.usable ? 0 : 1;
}

}  // namespace lyrefit

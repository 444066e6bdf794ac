#include "paper/corner_study.h"

#include <cmath>
#include <utility>

#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/certify/floor.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/settings/bounds_file.h"
#include "lyrefit/study/algorithms.h"
#include "lyrefit/study/compare.h"

namespace lyrefit {
namespace {

constexpr double kSame = 1e-6;  // relative

// DE/rand/1/bin with the settings of the study cited on the page.
ComparedAlgorithm QuotedDe() {
  ComparedAlgorithm quoted = PlainAlgorithms({Algorithm::kDe}, {})[0];
  quoted.search.population = 50;
  quoted.search.iterations = 1600;
  quoted.search.de_scale = 0.6;
  quoted.search.de_crossover = 0.9;
  quoted.name = "de, F 0.6, 50 candidates@80050";
  quoted.algorithm = "de, F 0.6, 50 candidates";
  return quoted;
}

std::vector<ComparedAlgorithm> Algorithms(const CornerOptions& options) {
  std::vector<ComparedAlgorithm> all = BudgetAlgorithms(
      {Algorithm::kMlo, Algorithm::kLo, Algorithm::kDe, Algorithm::kRandom}, options.budgets);
  all.push_back(QuotedDe());
  all.insert(all.end(), options.peers.begin(), options.peers.end());
  return all;
}

Expected<FitReport> FitOf(const CompareCurve& subject, Model model, Objective objective,
                          const CornerOptions& corner, const Observer& observer) {
  FitOptions options;
  options.model = model;
  options.objective = objective;
  options.bounds = subject.bounds;
  options.search.seed = corner.seed;
  options.intervals = Intervals::kNone;
  return Fit(subject.curve, options, observer);
}

}  // namespace

CornerEnds CountEnds(const CornerStudy& study, const AlgorithmResult& compared,
                     double RunRecord::*end_A) {
  CornerEnds ends;
  const double optimum = study.optimum_A();
  const double literature = study.literature_A();
  for (const RunRecord& run : compared.runs) {
    const double end = run.*end_A;
    if (end <= optimum * (1 + kSame)) {
      ++ends.optimum;
    } else if (std::fabs(end - literature) <= kSame * literature) {
      ++ends.literature;
    } else {
      ++(end < literature ? ends.between : ends.above);
    }
  }
  return ends;
}

Expected<CornerStudy> StudyCorner(const std::string& folder, const std::string& bounds,
                                  const CornerOptions& options, const Observer& observer) {
  CornerStudy study;
  study.version = Version();
  study.options = options;
  TRY(IvCurve curve, ReadCurve(folder));
  TRY(BoundsSpec spec, NamedBounds(bounds, folder));
  const CompareCurve subject = MakeSubject(std::move(curve), std::move(spec));
  const std::vector<Model> models = {Model::kSingleDiode, Model::kDoubleDiode};
  const Device device = MakeDevice(Model::kDoubleDiode, subject.curve.conditions);
  TRY(const auto box, MakeBounds(subject.bounds, device, subject.curve));
  TRY(study.certificate,
      Certify(subject.curve, RangesOf(box, ConstantSet::kCodata, models), observer));
  const Objective measured = Objective::kMeasuredCurrent;
  TRY(study.one, FitOf(subject, Model::kSingleDiode, measured, options, observer));
  TRY(study.two, FitOf(subject, Model::kDoubleDiode, measured, options, observer));
  TRY(study.two_solved,
      FitOf(subject, Model::kDoubleDiode, Objective::kSolvedCurrent, options, observer));
  CompareOptions compare;
  compare.models = {Model::kDoubleDiode};
  compare.seed = options.seed;
  compare.runs = options.runs;
  compare.plain_polish = true;
  compare.rankings = false;
  compare.threads = options.threads;
  compare.journal = options.journal;
  compare.journal_section = "pwp201";
  TRY(study.comparison, Compare({subject}, Algorithms(options), compare, observer));
  study.interrupted = study.comparison.interrupted || study.certificate.interrupted ||
                      study.one.interrupted || study.two.interrupted ||
                      study.two_solved.interrupted;
  return study;
}

}  // namespace lyrefit

#include "lyrefit/estimate/fit/fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "lyrefit/model/kernel.h"
#include "lyrefit/read/read_curve.h"
#include "repeats.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

IvCurve Rtc() { return *ReadCurve(LYREFIT_DATA_DIR "/rtc_france"); }

std::string ErrorOf(const IvCurve& curve, const FitOptions& options) {
  const auto report = Fit(curve, options);
  return report ? "no error" : report.error().message;
}

TEST(Fit, SaysWhatIsWrongWithOptions) {
  FitOptions options;
  options.search.population = 1;
  EXPECT_EQ(ErrorOf(Rtc(), options), "population = 1 is outside [4, 20000]");
  options = {};
  options.fixed["n2"] = 2;
  EXPECT_EQ(ErrorOf(Rtc(), options), "cannot fix 'n2': this model has no such parameter");
  options = {};
  options.fixed["n"] = -1;
  EXPECT_EQ(ErrorOf(Rtc(), options), "n cannot be fixed at -1, expected a finite number above 0");
  options = {};
  options.bounds.overrides["Rs"] = {0.5, 0.1};
  EXPECT_EQ(ErrorOf(Rtc(), options), "bounds of Rs are reversed: 0.5 is above 0.1");
  options = {};
  options.bounds.overrides["n3"] = {1, 2};
  EXPECT_EQ(ErrorOf(Rtc(), options),
            "bounds of 'n3': this model has no such parameter; it has Iph, Is1, n1, Rs, Rsh");
  options = {};
  options.fixed = {{"Iph", 0.76}, {"Is", 3e-7}, {"n", 1.48}, {"Rs", 0.036}, {"Rsh", 50}};
  EXPECT_EQ(ErrorOf(Rtc(), options), "every parameter is fixed: nothing is left to fit");
}

// A search that evaluates only the middle of the box.
SearchSummary StandStill(const ObjectiveFunction& objective, const Box& box,
                         const SearchOptions& options, const Observer& /*observer*/) {
  Candidate candidate;
  for (std::size_t j = 0; j < box.lower.size(); ++j) {
    candidate.x.push_back(0.5 * (box.lower[j] + box.upper[j]));
  }
  candidate.objective = objective(candidate.x.data());
  SearchSummary summary;
  summary.termination = SearchTermination::kEvaluations;
  summary.best = candidate;
  summary.elites = {candidate};
  summary.evaluations = 1;
  summary.trace = {{0, 1, candidate.objective}};
  EXPECT_EQ(options.seed, 7U);
  return summary;
}

TEST(Fit, TakesASearchOfTheUsersOwn) {
  FitOptions options;
  options.searcher = StandStill;
  options.search.seed = 7;
  options.intervals = Intervals::kNone;
  const auto report = Fit(Rtc(), options);
  ASSERT_TRUE(report.has_value());
  EXPECT_EQ(report->search.evaluations, 1);
  EXPECT_DOUBLE_EQ(report->searched[IdealityIndex(0)], 1.5);
  EXPECT_NEAR(report->rmse.refined.solved_current_A, 7.730062690e-4, 1e-12);
  EXPECT_EQ(report->non_default_options.at(0).name, "searcher");
}

TEST(Fit, ShowsAPlainSolveBesideThePolishWhenAsked) {
  FitOptions options;
  options.model = Model::kDoubleDiode;
  options.intervals = Intervals::kNone;
  EXPECT_TRUE(std::isnan(Fit(Rtc(), options)->rmse.plain_polished.solved_current_A));
  options.plain_polish = true;
  const RmseTable rmse = Fit(Rtc(), options)->rmse;
  EXPECT_LE(rmse.plain_polished.solved_current_A, rmse.searched.solved_current_A);
  EXPECT_GE(rmse.plain_polished.solved_current_A, rmse.refined.solved_current_A * (1 - 1e-9));
}

TEST(Fit, RefusesFewerPointsThanParameters) {
  IvCurve curve = Rtc();
  curve.voltage_V.resize(4);
  curve.current_A.resize(4);
  EXPECT_EQ(ErrorOf(curve, {}),
            "4 points cannot determine 5 parameters: measure more points or fix some");
  FitOptions options;
  options.fixed = {{"Rs", 0.036}, {"Rsh", 53}};
  EXPECT_EQ(ErrorOf(curve, options), "no error");
}

TEST(Fit, RefusesCurvesWithNaN) {
  IvCurve curve = Rtc();
  curve.current_A[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(ErrorOf(curve, {}), "no error");
}

TEST(Fit, FillsAllFourRmsesAndNeverEndsAboveTheBestCandidate) {
  for (const Objective objective : {Objective::kMeasuredCurrent, Objective::kSolvedCurrent}) {
    FitOptions options;
    options.objective = objective;
    const FitReport report = *Fit(Rtc(), options);
    EXPECT_LE(report.rmse.refined.Of(objective),
              report.rmse.refined_best_candidate.Of(objective) * (1 + 1e-9));
    EXPECT_LE(report.rmse.refined_best_candidate.Of(objective), report.rmse.searched.Of(objective));
    EXPECT_NEAR(report.search.best.objective / report.rmse.searched.Of(objective), 1, 1e-12);
    for (const RmsePair& pair :
         {report.rmse.searched, report.rmse.refined_best_candidate, report.rmse.refined}) {
      EXPECT_GT(pair.measured_current_A, 0);
      EXPECT_GT(pair.solved_current_A, 0);
    }
  }
}

TEST(Fit, HasTheSameBitsOnAnyNumberOfThreadsAndOnEveryKernel) {
  FitOptions options;
  options.model = Model::kDoubleDiode;
  options.threads = 1;
  const FitReport one = *Fit(Rtc(), options);
  std::vector<FitOptions> others(1, options);
  others[0].threads = 3;
  for (const Kernel& kernel : AvailableKernels()) {
    others.push_back(options);
    others.back().kernel = &kernel;
  }
  for (const FitOptions& other : others) {
    const FitReport again = *Fit(Rtc(), other);
    EXPECT_EQ(again.searched, one.searched);
    EXPECT_EQ(again.refined, one.refined);
    EXPECT_EQ(again.refined_best_candidate, one.refined_best_candidate);
    EXPECT_EQ(again.model_current_A, one.model_current_A);
    for (std::size_t i = 0; i < one.estimates.size(); ++i) {
      EXPECT_EQ(again.estimates[i].low_95, one.estimates[i].low_95);
      EXPECT_EQ(again.estimates[i].high_95, one.estimates[i].high_95);
    }
  }
}

TEST(Fit, KeepsFixedParametersAndSaysSo) {
  FitOptions options;
  options.model = Model::kDoubleDiode;
  options.fixed["n2"] = 2;
  options.fixed["n1"] = 1;
  const FitReport report = *Fit(Rtc(), options);
  EXPECT_EQ(report.refined[IdealityIndex(0)], 1);
  EXPECT_EQ(report.refined[IdealityIndex(1)], 2);
  EXPECT_EQ(report.searched[IdealityIndex(1)], 2);
  EXPECT_TRUE(report.estimates[IdealityIndex(1)].fixed);
  EXPECT_EQ(report.estimates[IdealityIndex(1)].at_bound, BoundSide::kNone);
  EXPECT_TRUE(std::isnan(report.estimates[IdealityIndex(1)].standard_error));
  EXPECT_EQ(report.criteria.parameters, 5);
}

TEST(Fit, WithoutPolishReportsTheCandidateAlone) {
  FitOptions options;
  options.polish = false;
  const FitReport report = *Fit(Rtc(), options);
  EXPECT_FALSE(report.polished);
  EXPECT_EQ(report.refined, report.searched);
  EXPECT_TRUE(std::isnan(report.rmse.refined.solved_current_A));
  EXPECT_EQ(report.refine.termination, "not run");
}

TEST(Fit, GivesEqualSigmasNoEffectAndUnequalOnesTheRightOne) {
  IvCurve curve = ModuleCurve(Model::kSingleDiode, kSingleTruth, 1e-3);
  const FitReport plain = *Fit(curve, {});
  curve.sigma_A.assign(curve.size(), 5e-3);
  EXPECT_EQ(Fit(curve, {})->refined, plain.refined);
  // Ten readings with an error of 0.2 A and a stated sigma of 50 A must not change the fit.
  for (int k = 10; k < 20; ++k) {
    curve.current_A[k] += 0.2;
    curve.sigma_A[k] = 50;
  }
  const FitReport weighted = *Fit(curve, {});
  EXPECT_NEAR(weighted.refined[kIph] / plain.refined[kIph], 1, 1e-3);
  EXPECT_NEAR(weighted.refined[2] / plain.refined[2], 1, 2e-2);
}

TEST(Fit, WithARobustLossShrugsOffOutliers) {
  IvCurve curve = ModuleCurve(Model::kSingleDiode, kSingleTruth, 1e-3);
  const FitReport clean = *Fit(curve, {});
  for (const int k : {5, 23, 41}) curve.current_A[k] -= 0.3;
  const double n_error =
      std::fabs(Fit(curve, {})->refined[IdealityIndex(0)] - clean.refined[IdealityIndex(0)]);
  for (const Loss loss : {Loss::kHuber, Loss::kCauchy}) {
    FitOptions options;
    options.loss = loss;
    const FitReport robust = *Fit(curve, options);
    EXPECT_LT(std::fabs(robust.refined[IdealityIndex(0)] - clean.refined[IdealityIndex(0)]),
              0.1 * n_error)
        << ToText(loss);
  }
}

TEST(Fit, IntervalsCoverTheTruthAsOftenAsTheyClaim) {
  SKIP_IF_SANITIZED();
  constexpr int kCurves = 300;
  std::vector<int> covered(5);
  for (int seed = 0; seed < kCurves; ++seed) {
    const FitReport report = *Fit(ModuleCurve(Model::kSingleDiode, kSingleTruth, 4e-3, seed), {});
    for (int i = 0; i < 5; ++i) {
      const Estimate& e = report.estimates[i];
      EXPECT_LE(e.bounds.lower, e.low_95);
      EXPECT_GE(e.bounds.upper, e.high_95);
      covered[i] += e.low_95 <= kSingleTruth[i] && kSingleTruth[i] <= e.high_95;
    }
  }
  // The tolerance of 15 is four standard deviations of a count of 300 with probability 95 %.
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(covered[i], 0.95 * kCurves, 15) << i;
}

TEST(Fit, MarksADiodeThatTheDataDoNotNeed) {
  FitOptions options;
  options.model = Model::kDoubleDiode;
  const FitReport report = *Fit(ModuleCurve(Model::kSingleDiode, kSingleTruth, 4e-3), options);
  int doubtful = 0;
  for (const Estimate& e : report.estimates) {
    if (e.identifiable) continue;
    ++doubtful;
    EXPECT_FALSE(e.reason.empty());
  }
  EXPECT_GE(doubtful, 2);
}

TEST(Fit, StopsWhenAskedAndKeepsTheBestSoFar) {
  FitOptions options;
  options.search.iterations = 100000000;
  std::atomic<int> calls{0};
  const FitReport report = *Fit(Rtc(), options, [&](const Progress&) {
    return ++calls > 20 ? ObserverAction::kStop : ObserverAction::kContinue;
  });
  EXPECT_TRUE(report.interrupted);
  EXPECT_EQ(report.search.termination, SearchTermination::kInterrupted);
  EXPECT_TRUE(std::isfinite(report.rmse.searched.solved_current_A));
  ASSERT_FALSE(report.warnings.empty());
  EXPECT_EQ(report.warnings[0].rfind("interrupted", 0), 0U);
}

TEST(Fit, WarnsOfACurrentThatRisesWithVoltage) {
  IvCurve curve = ModuleCurve(Model::kSingleDiode, kSingleTruth, 1e-3);
  for (int k = 20; k < 40; ++k) curve.current_A[k] += 0.01 * (k - 20);
  const auto warned = [](const IvCurve& of) {
    const FitReport report = *Fit(of, {});
    return std::any_of(report.warnings.begin(), report.warnings.end(), [](const std::string& w) {
      return w.find("rises with voltage") != std::string::npos;
    });
  };
  EXPECT_TRUE(warned(curve));
  EXPECT_FALSE(warned(ModuleCurve(Model::kSingleDiode, kSingleTruth, 1e-3)));
}

TEST(Fit, CallsAFitUnusableThatAStraightLineBeats) {
  IvCurve curve = Rtc();
  // Currents alternate about a rising line, which no diode model fits.
  for (std::size_t k = 0; k < curve.size(); ++k) {
    curve.current_A[k] = (k % 2 == 0 ? 1.0 : -1.0) + 2 * curve.voltage_V[k];
  }
  curve.as_is = true;  // a generator has no such signs
  const auto report = Fit(curve, {});
  ASSERT_TRUE(report);
  EXPECT_FALSE(report->usable);
}

TEST(Fit, GivesPvlibItsFifthValue) {
  const FitReport report = *Fit(Rtc(), {});
  EXPECT_NEAR(report.nNsVth, report.refined[2] * 1.380649e-23 * 306.15 / 1.602176634e-19, 1e-16);
}

TEST(Fit, EchoesEveryOptionThatDiffersFromItsDefault) {
  FitOptions options;
  options.search.seed = 7;
  options.bounds.overrides["Rs"] = {0, 0.5};
  options.intervals = Intervals::kNone;
  const FitReport report = *Fit(Rtc(), options);
  std::string echo;
  for (const OptionEcho& option : report.non_default_options) {
    echo += option.name + "=" + option.value + ";";
  }
  EXPECT_EQ(echo, "bound=Rs=0:0.5;seed=7;intervals=none;");
}

// A source meter held the current at its limit beyond open circuit. No diode model fits that, and
// the linearised steps of the descent are misleading.
IvCurve Clipped(int points = 83, double limit_A = -0.05) {
  IvCurve curve;
  curve.conditions.cells_in_series = 1;
  for (int k = 0; k < points; ++k) curve.voltage_V.push_back(-0.1 + 0.01 * k);
  const std::vector<double> truth = {0.038, 4e-10, 1.2, 0.3, 2900};
  curve.current_A = SolveCurrents(MakeDevice(Model::kSingleDiode, curve.conditions), truth.data(),
                                  curve.voltage_V);
  RandomStream random(4);
  for (double& i : curve.current_A) i = std::max(i + 1e-5 * random.Normal(), limit_A);
  return curve;
}

TEST(Fit, NeverPolishesACandidateIntoSomethingWorse) {
  for (int seed = 0; seed < 4; ++seed) {
    FitOptions options;
    options.search.seed = seed;
    options.intervals = Intervals::kNone;
    const RmseTable rmse = Fit(Clipped(), options)->rmse;
    EXPECT_LE(rmse.refined_best_candidate.solved_current_A,
              rmse.searched.solved_current_A * (1 + 1e-9));
  }
}

// The limit holds the last reading only: the fit is barely usable, with a parameter at its bound.
IvCurve ClippedOnce() { return Clipped(73, -0.06); }

TEST(Fit, HasTheSameParametersWithAndWithoutIntervals) {
  for (int seed = 0; seed < 3; ++seed) {
    FitOptions options;
    options.search.seed = seed;
    for (const IvCurve& curve : {Clipped(), ClippedOnce()}) {
      options.intervals = Intervals::kProfile;
      const FitReport with = *Fit(curve, options);
      options.intervals = Intervals::kNone;
      EXPECT_EQ(Fit(curve, options)->refined, with.refined) << seed;
    }
  }
}

TEST(Fit, GivesNoIntervalNarrowerThanItsProfileSaw) {
  const FitReport report = *Fit(ClippedOnce(), {});
  EXPECT_TRUE(report.usable);
  for (const Estimate& e : report.estimates) {
    EXPECT_LT(e.low_95, e.high_95) << e.info.symbol;
    if (e.at_bound == BoundSide::kNone) {
      EXPECT_LT(e.low_95, e.refined) << e.info.symbol;
      EXPECT_LT(e.refined, e.high_95) << e.info.symbol;
    }
    if (!std::isfinite(e.standard_error)) continue;
    EXPECT_GT(e.high_95 - e.low_95, 0.5 * e.standard_error) << e.info.symbol;
  }
}

TEST(Fit, RefusesANegativeNumberOfThreads) {
  FitOptions options;
  options.threads = -3;
  EXPECT_EQ(ErrorOf(Rtc(), options), "threads = -3, expected 0 (all cores) or more");
}

}  // namespace
}  // namespace lyrefit

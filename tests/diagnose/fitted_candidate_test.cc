#include "lyrefit/diagnose/fitted_candidate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "synthetic_data.h"

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::Not;

constexpr double kField = 1.2e-3;

// The law of `base` with one more effect, fitted from a probe, and with those of `after`.
FittedCandidate With(const SyntheticData& made, const LawFit& base, const char* id,
                     const std::vector<const char*>& after = {}) {
  FittedCandidate candidate;
  candidate.score.effect = FindEffect(id);
  Law law = base.law;
  law.effects = {candidate.score.effect};
  for (const char* other : after) law.effects.push_back(FindEffect(other));
  std::vector<double> start = base.p;
  for (const Effect* effect : law.effects) {
    const Probe probe = effect->probes(made.measurement.readings.traits)[10];
    start.insert(start.end(), probe.begin(), probe.end());
  }
  candidate.fit = FitLaw(made.weighted, law, start);
  return candidate;
}

Hypotheses Judged(const IvCurve& curve, const JudgeOptions& options) {
  const SyntheticData made = OnTheData(curve);
  Hypotheses hypotheses;
  hypotheses.none.fit = FitBase(made.weighted, Law());
  hypotheses.candidates = {With(made, hypotheses.none.fit, "transient"),
                           With(made, hypotheses.none.fit, "irr_step")};
  Judge(made.weighted, hypotheses.none.fit, options, &hypotheses);
  return hypotheses;
}

double Sum(const Hypotheses& hypotheses) {
  double sum = hypotheses.none.probability;
  for (const FittedCandidate& candidate : hypotheses.candidates) sum += candidate.probability;
  return sum;
}

IvCurve WithStep(double step_A) {
  IvCurve curve = SyntheticCurve({});
  const SyntheticData made = OnTheData(curve);
  const double place = FindEffect("irr_step")->probes(made.measurement.readings.traits)[10][1];
  for (std::size_t k = 0; k < curve.size(); ++k) {
    if (made.measurement.readings.points[k].x > place) curve.current_A[k] += step_A;
  }
  return curve;
}

TEST(JudgeTest, ProbabilitiesAddUpToOneAndFollowTheData) {
  const JudgeOptions laboratory;
  const Hypotheses nothing = Judged(WithStep(0), laboratory);
  EXPECT_NEAR(Sum(nothing), 1, 1e-12);
  EXPECT_GT(nothing.none.probability, 0.9);
  const Hypotheses step = Judged(WithStep(0.08), laboratory);
  EXPECT_NEAR(Sum(step), 1, 1e-12);
  EXPECT_STREQ(step.candidates.front().score.effect->id, "irr_step");
  EXPECT_GT(step.candidates.front().probability, 0.99);
}

// What modules without a fault do as well does not count.
TEST(JudgeTest, ADepartureOfTheDeviceMakesSmallCausesLessProbable) {
  JudgeOptions field;
  field.departure = kField;
  field.departure_width = 0.35;
  const double step_A = 0.02;
  EXPECT_GT(Judged(WithStep(step_A), field).none.probability,
            Judged(WithStep(step_A), {}).none.probability);
}

TEST(JudgeTest, PriorsWeighInOdds) {
  JudgeOptions rare, usual;
  for (const char* id : {"irr_step", "transient"}) {
    rare.priors.given[id] = 1e-3;
    usual.priors.given[id] = 0.5;
  }
  const auto odds = [](const JudgeOptions& options) {
    const double none = Judged(WithStep(0.02), options).none.probability;
    return std::log((1 - none) / none);
  };
  EXPECT_NEAR(odds(usual) - odds(rare), std::log(0.999 / 0.001), 1e-6);
}

// ln of the odds of the first cause over the second, as Judge tempers their evidence. `part`: at
// most; `least`: of what the misfits do not show, over `pieces` of a sweep.
double OddsOfFirst(const WeightedData& weighted, const Hypotheses& judged, double part,
                   double least) {
  const FittedCandidate *above = &judged.candidates[0], *below = &judged.candidates[1];
  const bool turned = LogTotal(above->evidence) < LogTotal(below->evidence);
  if (turned) std::swap(above, below);
  const auto misfit = [&](const FittedCandidate& one) {
    return std::log(MissedBy(weighted, one.fit));
  };
  const double evidence = LogTotal(above->evidence) - LogTotal(below->evidence);
  const double none = LogTotal(judged.none.evidence);
  const bool explains = LogTotal(below->evidence) - none > 0.5 * (LogTotal(above->evidence) - none);
  const double shown = 6 * std::max(misfit(*below) - misfit(*above), 0.0);
  const double counted =
      explains ? std::min(part * evidence, least * evidence + shown) : part * evidence;
  const double odds = above->log_prior - below->log_prior + counted;
  return turned ? -odds : odds;
}

// Against none the evidence of all causes counts in full; between causes a part of it does, the
// smaller where devices depart from their model, and smaller still where both laws miss alike.
TEST(JudgeTest, DifferencesBetweenCausesCountInPart) {
  JudgeOptions field;
  field.departure = kField;
  field.departure_width = 0.35;
  const IvCurve curve = WithStep(0.05);
  const SyntheticData made = OnTheData(curve);
  for (const auto& [options, part, least] :
       {std::tuple(JudgeOptions(), 0.6, 0.6), std::tuple(field, 0.3, 0.1)}) {
    const Hypotheses judged = Judged(curve, options);
    const FittedCandidate& first = judged.candidates[0];
    const FittedCandidate& second = judged.candidates[1];
    EXPECT_NEAR(std::log(first.probability / second.probability),
                OddsOfFirst(made.weighted, judged, part, least), 1e-9);
    const double causes = LogSum(LogTotal(first.evidence) + first.log_prior,
                                 LogTotal(second.evidence) + second.log_prior);
    EXPECT_NEAR(std::log((1 - judged.none.probability) / judged.none.probability),
                causes - LogTotal(judged.none.evidence), 1e-6);
  }
}

// The part of a shading's probability that cells which differ one by one have.
double PartOfScatter(double light_missing, int substrings,
                     const std::vector<const Effect*>& candidates = {},
                     const std::vector<const char*>& after = {}) {
  SyntheticData made = OnTheData(SyntheticCurve({}));
  Readings readings = made.measurement.readings;
  readings.traits.substrings = substrings;
  made.weighted.readings = std::make_shared<const Readings>(readings);
  Hypotheses hypotheses;
  hypotheses.none.fit = FitBase(made.weighted, Law());
  FittedCandidate shading = With(made, hypotheses.none.fit, "shading", after);
  shading.fit.p[shading.fit.law.Offset(0)] = light_missing;
  hypotheses.candidates = {shading, With(made, hypotheses.none.fit, "irr_step")};
  JudgeOptions options;
  options.priors.given = {{"shading", 0.1}, {"scatter", 0.1}};
  options.candidates = candidates;
  Judge(made.weighted, hypotheses.none.fit, options, &hypotheses);
  double part = kUnknown, sum = hypotheses.none.probability;
  for (const FittedCandidate& candidate : hypotheses.candidates) {
    sum += candidate.probability + candidate.as_slight;
    if (candidate.score.effect->light_missing == nullptr) {
      EXPECT_EQ(candidate.as_slight, 0) << candidate.score.effect->id;
    } else {
      part = candidate.as_slight / (candidate.probability + candidate.as_slight);
    }
  }
  EXPECT_NEAR(sum, 1, 1e-12);
  return part;
}

// With equal priors the densities of the size decide: at a light of 95 % half of Student's t has
// 12 sqrt(3) / (16 pi 0.05), an even density 1.
TEST(JudgeTest, SlightDifferencesOfLightMayBeCellsThatDiffer) {
  const double density = 12 * std::sqrt(3.0) / M_PI / 0.05 / 16;
  EXPECT_NEAR(PartOfScatter(0.05, 2), density / (1 + density), 1e-9);
  EXPECT_LT(PartOfScatter(0.5, 2), 0.02);
  EXPECT_EQ(PartOfScatter(0.05, 3), 0);  // two of three substrings alike
  // Only what is asked for is named.
  EXPECT_EQ(PartOfScatter(0.05, 2, {FindEffect("shading"), FindEffect("irr_step")}), 0);
  EXPECT_GT(PartOfScatter(0.05, 2, {FindEffect("shading"), FindEffect("scatter")}), 0.8);
}

// The parameters judged are those of the cause, wherever it stands among the effects of its law.
TEST(JudgeTest, ACauseIsJudgedByItsOwnParameters) {
  const double alone = PartOfScatter(0.05, 2);
  EXPECT_NEAR(PartOfScatter(0.05, 2, {}, {"irr_step"}), alone, 1e-9);
}

// Evidence that readings which alternate by 0.01 A about a step of the light take from the step.
double LostByRoughness(double step_A) {
  const auto evidence = [step_A](double rough_A) {
    IvCurve curve = WithStep(step_A);
    for (std::size_t k = 0; k < curve.size(); ++k) {
      curve.current_A[k] += k % 2 == 0 ? rough_A : -rough_A;
    }
    SyntheticData made = OnTheData(curve);
    made.weighted.least_variance = 1;
    const LawFit base = FitBase(made.weighted, Law());
    return EvidenceOf(made.weighted, base, {}, With(made, base, "irr_step").fit).complete;
  };
  return evidence(0) - evidence(0.01);
}

// What a cause misses from reading to reading weighs less the larger it is.
TEST(JudgeTest, LargeCausesMayMissTheKinks) {
  EXPECT_LT(LostByRoughness(1), 0.5 * LostByRoughness(0.05));
}

TEST(FittedCandidateTest, ThereIsNoRoomForWhatIsThereNorForWhatItExcludes) {
  const std::vector<const Effect*> all = Catalogue();
  Law law;
  EXPECT_EQ(RoomFor(law, all), all);
  const Effect* shading = FindEffect("shading");
  law.effects.push_back(shading);
  const std::vector<const Effect*> open = RoomFor(law, all);
  EXPECT_THAT(open, Not(Contains(shading)));
  EXPECT_THAT(open, Contains(FindEffect("irr_step")));
  for (const Effect* effect : all) {
    if (!Exclude(*shading, *effect)) continue;
    EXPECT_THAT(open, Not(Contains(effect))) << effect->id;
  }
}

}  // namespace
}  // namespace lyrefit

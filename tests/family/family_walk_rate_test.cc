// Rate test of the catalogue over several curves of one device: families of lit curves, and lit
// curves with a dark one. More sets per row than CI runs:
//   LYREFIT_WALK_CURVES=300 tests/family_rate_test --gtest_filter='FamilyWalk*'

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "catalogue_walk.h"
#include "family/quick.h"
#include "family/synthetic_effects.h"

namespace lyrefit {
namespace {

struct Place {
  const Effect* effect;
  bool dark;

  const char* Data() const { return dark ? "lit and dark" : "family"; }
  int Curves() const { return WalkCurves(4); }
};

// A shunt that is independent of irradiance. One that depends on it would replace the effect
// `photoshunt`.
Translation ConstantShunt() {
  TranslationSpec spec;
  spec.law = TranslationLaw::kDeSoto;
  spec.shunt = ShuntLaw::kConstant;
  spec.cells_in_series = 36;
  return *MakeTranslation(spec);
}

struct Synthetic {
  Translation law = ConstantShunt();
  std::vector<double> truth = SyntheticTruth(law);
  CurveSet set;
};

// A random module under six operating conditions, or at one temperature and in the dark.
Synthetic DrawSet(const Place& place, RandomStream* random) {
  Synthetic made;
  const auto vary = [&](int i, double part) {
    made.truth[i] *= 1 + part * (random->Uniform() - 0.5);
  };
  vary(made.law.photocurrent, 0.5);
  vary(made.law.n, 0.1);
  vary(made.law.resistance_series, 1);
  vary(made.law.resistance_shunt, 1);
  const std::vector<SyntheticAt> one = {{1000, 25}, {600, 25}};
  made.set = SyntheticSet(made.law, made.truth, place.dark ? one : kSixPlaces, 40, 0);
  if (place.dark) made.set.curves.push_back(DarkCurve(made.law, made.truth, 25, 40));
  return made;
}

bool Shows(const Place& place) {
  RandomStream random(1);
  Synthetic made = DrawSet(place, &random);
  return ExtendTranslation(made.set, made.truth[made.law.bandgap_slope], {{place.effect, {}}},
                           /*force=*/false, &made.law)
      .has_value();
}

std::vector<Place> Places() {
  std::vector<Place> places;
  for (const Effect* effect : Catalogue()) {
    for (const bool dark : {false, true}) {
      if (effect->HasStage() && Shows({effect, dark})) places.push_back({effect, dark});
    }
  }
  return places;
}

FamilyOptions Options() {
  FamilyOptions options = Quick();
  options.shunt = ShuntLaw::kConstant;
  options.threads = 1;
  return options;
}

double DrawNoise(const CurveSet& clean, RandomStream* random) {
  FamilyOptions alone = Options();
  alone.intervals = false;
  const auto base = FitFamily(clean, alone);
  double count = 0, scale = 0;
  for (const IvCurve& curve : clean.curves) {
    count += static_cast<double>(curve.size());
    for (const double current : curve.current_A) scale = std::max(scale, current);
  }
  const double misfit = base ? base->rmse.refined.solved_current_A * std::sqrt(count) : 0;
  return NoiseFor(misfit, scale, random);
}

void Count(const Place& place, RandomStream* random, WalkRow* row) {
  const Effect& effect = *place.effect;
  Synthetic made = DrawSet(place, random);
  Translation extended = made.law;
  ASSERT_TRUE(ExtendTranslation(made.set, made.truth[made.law.bandgap_slope], {{&effect, {}}},
                                /*force=*/false, &extended));
  const Device& device = *extended.extended;
  const DrawnEffect drawn = DrawEffect(device, effect, random);
  AddSyntheticEffects({drawn.truth}, made.law, made.truth, 0, &made.set);
  const double noise = DrawNoise(made.set, random);
  for (IvCurve& curve : made.set.curves) {
    for (double& current : curve.current_A) current += noise * random->Normal();
  }
  // The effect may have changed the curves so much that it is no longer testable.
  Translation again = made.law;
  if (!ExtendTranslation(made.set, made.truth[made.law.bandgap_slope], {drawn.asked},
                         /*force=*/false, &again)) {
    return;
  }
  FamilyOptions options = Options();
  options.with = {drawn.asked};
  const auto begin = std::chrono::steady_clock::now();
  const auto report = FitFamily(made.set, options);
  CountFit(report, std::chrono::steady_clock::now() - begin, drawn, row);
}

WalkRow Walk(const Place& place) {
  WalkRow row;
  const int wanted = place.Curves();
  for (int draw = 0; row.curves < wanted && draw < 20 * wanted; ++draw) {
    RandomStream random(SeedOf(place.effect->id, place.Data()), draw);
    Count(place, &random, &row);
  }
  return row;
}

TEST(FamilyWalk, FitsBackWhatWasSimulated) { WalkAll(Places(), Walk); }

}  // namespace
}  // namespace lyrefit

#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "law/made_curve.h"
#include "lyrefit/diagnose/known_effects.h"
#include "lyrefit/diagnose/measurement.h"
#include "lyrefit/diagnose/score.h"
#include "lyrefit/diagnose/workbench.h"
#include "lyrefit/effects/catalogue.h"

namespace lyrefit {

// A measurement on the bench, its noise known.
struct MadeBench {
  Measurement measurement;
  Workbench bench;
};

inline MadeBench OnTheBench(const CurveSet& set, double sigma_A = 0.004) {
  MadeBench made;
  made.measurement = *MakeMeasurement(set);
  const Readings& readings = made.measurement.readings;
  made.bench.readings = std::make_shared<const Readings>(readings);
  made.bench.sigma.assign(readings.points.size(), sigma_A / readings.scale.current_A);
  made.bench.used.assign(readings.points.size(), 1);
  return made;
}

inline MadeBench OnTheBench(const IvCurve& curve) { return OnTheBench(SetOf({curve})); }

// The effects a diagnosis tries on these data.
inline std::vector<const Effect*> Showable(const DataTraits& traits) {
  return Candidates(Catalogue(), traits, {});
}

// Scored and judged by linear nulls of the same law.
inline std::vector<Score> ScoreEffects(const Workbench& bench, const LawFit& fit,
                                       const std::vector<const Effect*>& effects, int draws,
                                       std::uint64_t seed) {
  Imprints imprints;
  const Prepared prepared = PrepareAll(bench, fit, effects, &imprints);
  return JudgeScores(prepared, SimulateWorth(bench, prepared, nullptr, draws, seed));
}

}  // namespace lyrefit

#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "lyrefit/diagnose/fit_effect.h"
#include "lyrefit/diagnose/known_effects.h"
#include "lyrefit/diagnose/measurement.h"
#include "lyrefit/diagnose/weighted_data.h"
#include "lyrefit/effects/catalogue.h"
#include "synthetic/curves.h"

namespace lyrefit {

// A synthetic measurement with known noise.
struct SyntheticData {
  Measurement measurement;
  WeightedData weighted;
};

inline SyntheticData OnTheData(const CurveSet& set, double sigma_A = 0.004) {
  SyntheticData made;
  made.measurement = *MakeMeasurement(set);
  const Readings& readings = made.measurement.readings;
  made.weighted.readings = std::make_shared<const Readings>(readings);
  made.weighted.sigma.assign(readings.points.size(), sigma_A / readings.scale.current_A);
  made.weighted.used.assign(readings.points.size(), 1);
  return made;
}

inline SyntheticData OnTheData(const IvCurve& curve) { return OnTheData(SetOf({curve})); }

// Effects of the catalogue that data with these traits can show.
inline std::vector<const Effect*> Showable(const DataTraits& traits) {
  return Candidates(Catalogue(), traits, {});
}

}  // namespace lyrefit

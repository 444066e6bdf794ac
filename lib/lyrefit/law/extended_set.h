#pragma once

#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/law/extension.h"
#include "lyrefit/law/translation.h"

namespace lyrefit {

// MakeReadings with the cells as stated, its parameters quoted at `reference_K`.
Expected<Readings> SetReadings(const CurveSet& set, double reference_K);

// The device behind all curves of a set, extended by effects: `base` at 1000 W/m2 and
// `reference_K`, then alpha (A/K) and EgRef (eV), then the parameters of the effects. The diodes
// follow the curves' irradiances and temperatures by De Soto's law with the `shunt`, constants and
// slope of the band gap of `law`; curves of irradiance 0 are dark. Errors as of Extend.
Expected<Device> ExtendSet(const Device& base, Law law, const CurveSet& set, double reference_K,
                           const std::vector<EffectUse>& uses, bool force);

// The same device in the measurement of one curve of its set, under its own conditions.
Device OfCurve(const Device& device, int curve);

// The same device under one sky: irradiance in suns.
Device UnderSky(const Device& device, double irradiance, double temperature_K);

// De Soto's `translation` with the effects: fills `extended` and `shared_of`, appends the effects'
// parameters. `bandgap_slope` is the dEgdT that is held.
Expected<void> ExtendTranslation(const CurveSet& set, double bandgap_slope,
                                 const std::vector<EffectUse>& uses, bool force,
                                 Translation* translation);

// Parameters of `translation.extended` of shared ones; and shared ones with those of the effects in
// the units of reports.
std::vector<double> ExtendedParameters(const Translation& translation, const double* shared);
std::vector<double> ReportedShared(const Translation& translation, std::vector<double> shared);

}  // namespace lyrefit

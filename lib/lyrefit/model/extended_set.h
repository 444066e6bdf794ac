#pragma once

#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/model/device_effects.h"
#include "lyrefit/model/reporting_units.h"
#include "lyrefit/model/translation.h"

namespace lyrefit {

// MakeReadings with the stated number of cells and parameters at reference temperature
// `reference_K`.
Expected<Readings> SetReadings(const CurveSet& set, double reference_K);

// The device behind all curves of a set, with effects. Its parameters are those of `base` at 1000
// W/m2 and `reference_K`, then alpha (A/K), EgRef (eV) and the parameters of the effects. The
// diodes follow irradiance and temperature of each curve by De Soto's law, with shunt law,
// constants and band gap slope of `law`. Curves of irradiance 0 are dark. Errors: those of Extend.
Expected<Device> ExtendSet(const Device& base, Law law, const CurveSet& set, double reference_K,
                           const std::vector<EffectUse>& uses, bool force);

// A device from ExtendSet in the measurement of one curve of its set, at that curve's conditions.
Device OfCurve(const Device& device, int curve);

// A device from ExtendSet at one irradiance (suns) and temperature.
Device UnderConditions(const Device& device, double irradiance, double temperature_K);

// Adds effects to a De Soto `translation`: fills `extended` and `shared_of`, appends the effects'
// parameters. `bandgap_slope`: the fixed dEgdT, 1/K.
Expected<void> ExtendTranslation(const CurveSet& set, double bandgap_slope,
                                 const std::vector<EffectUse>& uses, bool force,
                                 Translation* translation);

// The effects of a translation, in its shared parameters.
EffectSpan SpanOf(const Translation& translation);

// ExtendedParameters: parameter vector of `translation.extended` from the shared parameters.
// ReportedShared and InternalShared: the shared parameters with those of the effects converted from
// internal to reporting units, and back.
std::vector<double> ExtendedParameters(const Translation& translation, const double* shared);
std::vector<double> ReportedShared(const Translation& translation, std::vector<double> shared);
std::vector<double> InternalShared(const Translation& translation, std::vector<double> shared);

}  // namespace lyrefit

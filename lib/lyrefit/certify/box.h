#pragma once

#include "lyrefit/base/error.h"
#include "lyrefit/certify/certify_options.h"
#include "lyrefit/certify/interval.h"
#include "lyrefit/certify/mixture.h"
#include "lyrefit/certify/upper_bound.h"

namespace lyrefit {

// These functions convert the requested ranges of parameters to those of a proof.

// Errors: a range that is empty or reversed, and ranges for fewer diodes than the largest model
// has.
Expected<void> CheckRanges(const CertifyOptions& options);

// The options with `diodes` filled: an empty list becomes three diodes with the common ranges.
// Otherwise the common range of n is widened to include the n of every diode.
CertifyOptions WithEveryDiode(CertifyOptions options);

// AnyDiode() is the window of u for every n of the options and any Is. BoxOf() has the windows of u
// and Is of the first `diodes` diodes. `thermal_voltage_V` is Ns k T / q, and `safe_V` an interval
// that contains it. If options.rigorous is set, the windows are rounded outwards, so that they
// contain all n in spite of rounding.
Window AnyDiode(const CertifyOptions& options, double thermal_voltage_V,
                const WideInterval& safe_V);
std::vector<Window> BoxOf(const CertifyOptions& options, int diodes, double thermal_voltage_V,
                          const WideInterval& safe_V);

// Sets the ranges of photocurrent (A) and shunt conductance (S) in data made by CurveData().
void SetRanges(const CertifyOptions& options, MixtureData* data);

// The ranges for fits of a model of `diodes` diodes. `rs_upper_ohm` is the largest Rs that the
// proof searches.
ModelRanges RangesOfModel(const CertifyOptions& options, int diodes, double rs_upper_ohm,
                          double reference_voltage_V);

}  // namespace lyrefit

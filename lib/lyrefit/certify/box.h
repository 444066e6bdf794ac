#pragma once

#include "lyrefit/base/error.h"
#include "lyrefit/certify/upper_bound.h"
#include "lyrefit/certify/certify_options.h"
#include "lyrefit/certify/interval.h"
#include "lyrefit/certify/mixture.h"

namespace lyrefit {

// From the ranges that are asked for to those of the proof.

// Ranges that are empty, reversed or of too few diodes are errors.
Expected<void> CheckRanges(const CertifyOptions& options);

// The same options with `diodes` filled, one for each of the largest model, and n from the least to the
// largest of any.
CertifyOptions WithEveryDiode(CertifyOptions options);

// The window of any diode, whatever its Is, and those of a model's diodes with theirs. Windows of
// rigorous proofs hold all n in spite of rounding.
Window AnyDiode(const CertifyOptions& options, double thermal_voltage_V,
                const WideInterval& safe_V);
std::vector<Window> BoxOf(const CertifyOptions& options, int diodes, double thermal_voltage_V,
                          const WideInterval& safe_V);

// Gives photocurrent and shunt conductance of CurveData() their ranges.
void SetRanges(const CertifyOptions& options, MixtureData* data);

// The ranges of a model; Rs up to what the proof goes through.
ModelRanges RangesOfModel(const CertifyOptions& options, int diodes, double rs_upper_ohm,
                          double reference_voltage_V);

}  // namespace lyrefit

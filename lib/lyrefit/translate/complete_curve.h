#pragma once

#include "lyrefit/translate/procedures.h"

namespace lyrefit {

// Readings extended by their single-diode fit to a voltage of `lowest_V` and a current of
// `lowest_A`, where they end sooner. The diode's curve is shifted so that it starts at the last
// reading: in voltage beyond open circuit, in current beyond short circuit. IEC 60891 requires
// readings at negative current where the irradiance is increased; few instruments record them.
CurvePoints Completed(const CurvePoints& points, const SingleDiodeFit& diode, double lowest_V,
                      double lowest_A);

// The points sorted by rising voltage; points at equal voltage keep their order.
CurvePoints ByVoltage(CurvePoints points);

}  // namespace lyrefit

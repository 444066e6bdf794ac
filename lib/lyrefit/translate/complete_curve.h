#pragma once

#include "lyrefit/translate/procedures.h"

namespace lyrefit {

// Readings continued by the single diode behind them: down to a voltage of `lowest_V` and a current
// of `lowest_A`, where they end sooner. The diode's piece is moved along the voltage (beyond open
// circuit) or the current (beyond short circuit) so that it begins at the last reading. IEC 60891
// asks for readings at negative current where light is added; few instruments take them.
CurvePoints Completed(const CurvePoints& points, const SingleDiodeFit& diode, double lowest_V,
                      double lowest_A);

// The points by rising voltage; those at one voltage keep their order.
CurvePoints ByVoltage(CurvePoints points);

}  // namespace lyrefit

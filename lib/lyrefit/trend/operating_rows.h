#pragma once

#include <vector>

#include "lyrefit/trend/trend_device.h"
#include "lyrefit/trend/trend_options.h"
#include "lyrefit/trend/trend_report.h"

namespace lyrefit {

// Finds what operating points tell of the device, and fills the parameters of the rows.
//
// Rows off maximum power are marked: at a voltage that departs from that of the days around by more
// than the scatter and the temperature explain. Of these, rows at the highest power of the series
// are limited by the inverter.
//
// A voltage and a current at maximum power leave, once the light of the row is eliminated, one
// equation for series resistance and voltage of the diodes. Its coefficients differ between bright
// and dim rows, so that the rows of a week determine both (robust least squares, the Jacobian by
// differences of the maximum power point). Shunt and second diode stay those of the law: they
// hardly move the point. `represents` is set for the rows of one day of each week, so that a week
// counts once.
void ReduceOperatingPoints(const TrendDevice& device, const TrendOptions& options,
                           std::vector<TrendRow>* rows);

}  // namespace lyrefit

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lyrefit/curve/key_points.h"
#include "lyrefit/model/translation.h"
#include "lyrefit/translate/procedures.h"

namespace lyrefit {

// Key points at the target by a law (model/translation.h) for the single diode of the readings. The
// reference parameters follow from the five parameters at (G1, T1) and the law's own inputs:
//   De Soto   EgRef, dEgdT, alpha; Rsh in proportion to 1 / G
//   PVsyst    EgRef, mu_gamma, alpha; Rsh exponential in G, four times as large in the dark
// The result is that of ScaledKeyPoints for the corrected readings.
Expected<KeyPoints> DiodeKeyPoints(Procedure procedure, const PreparedCurve& curve,
                                   const TranslationInputs& inputs);

// The law of kDeSoto or kPvsyst for a module with this number of cells in series.
Expected<std::shared_ptr<const Translation>> LawOf(Procedure procedure, int cells_in_series);

// `measured` times the model's ratio of `target` to `source`, which keeps the misfit of the model.
// The model's value where the readings lack a key point.
KeyPoints ScaledKeyPoints(const KeyPoints& measured, const KeyPoints& source,
                          const KeyPoints& target);

// 200 points of the model at even voltages at the target, from below 0 V to beyond Voc.
Expected<CurvePoints> DiodePoints(Procedure procedure, const PreparedCurve& curve,
                                  const TranslationInputs& inputs);

// The band gap (De Soto) or slope of the ideality (PVsyst) with which Voc follows
// `inputs.beta_oc_V_K` at 1000 W/m2 and 25 C. De Soto's barrier is n EgRef, so an error of the
// fitted n would change beta; the band gap is therefore fitted to keep beta. None where no band gap
// of 0.3 to 4 eV (slope within +-0.02 1/K) does so.
std::optional<BetaAnchor> AnchorBandgap(const SingleDiodeFit& diode, int cells,
                                        const TranslationInputs& inputs);
std::optional<BetaAnchor> AnchorMuGamma(const SingleDiodeFit& diode, int cells,
                                        const TranslationInputs& inputs);

// Points by IEC 60891:2021, procedure 3, between curves 1 and 2 of one device, or beyond them:
//   V3 = V1 + a (V2 - V1),   I3 = I1 + a (I2 - I1)   for points with I2 - I1 = Isc2 - Isc1,
//   G3 = G1 + a (G2 - G1),   T3 = T1 + a (T2 - T1).
// Two curves reach the targets on one line of (G, T). With a third curve, the first step goes to
// the point on the line of 2 and 3 that is collinear with 1 and the target; the second goes to the
// target. Errors: no further curve; a target off the line by more than 2 % of its irradiance or 1
// K; a target further beyond the curves than the distance between them.
Expected<CurvePoints> BetweenCurves(const PreparedCurve& curve, const TranslationInputs& inputs);

// Position of the target from 0 (the measured curve) to 1 (the further one); with a third curve the
// larger of both steps. NaN where BetweenCurves fails.
double PlaceBetween(const PreparedCurve& curve, const TranslationInputs& inputs);

// Key points of readings by ASTM E1036 (and E948), in windows around the key points of
// FindKeyPoints (Isc0, Voc0, Imp0, Vmp0):
//   Isc   straight line I(V) through readings with |V| <= 0.2 Voc0 and I >= 0.96 Isc0, at V = 0
//   Voc   straight line V(I) through readings with |I| <= 0.2 Isc0 and V >= 0.9 Voc0, at I = 0
//   Pmax  maximum of the polynomial P(V) of fourth degree through readings with currents of 0.75 to
//         1.15 Imp0 and voltages of 0.75 to 1.15 Vmp0
// The value of FindKeyPoints stays where a window has fewer readings than 2, 2 and 5, respectively,
// or where the polynomial has no maximum inside its window. Arrays in V and A, of equal length.
KeyPoints E1036KeyPoints(const std::vector<double>& voltage_V,
                         const std::vector<double>& current_A);

// Readings extended by their single-diode fit to a voltage of `lowest_V` and a current of
// `lowest_A`, where they end sooner. The diode's curve is shifted so that it starts at the last
// reading: in voltage beyond open circuit, in current beyond short circuit. IEC 60891 requires
// readings at negative current where the irradiance is increased; few instruments record them.
CurvePoints Completed(const CurvePoints& points, const SingleDiodeFit& diode, double lowest_V,
                      double lowest_A);

// The points sorted by rising voltage; points at equal voltage keep their order.
CurvePoints ByVoltage(CurvePoints points);

}  // namespace lyrefit

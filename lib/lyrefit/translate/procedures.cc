#include "lyrefit/translate/procedures.h"

#include <cmath>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/try.h"
#include "lyrefit/translate/extended_model.h"
#include "lyrefit/translate/procedure_steps.h"

namespace lyrefit {
namespace {

// Corrected and completed points with their key values: the input of procedures 1, 2 and 4.
struct Moving {
  CurvePoints points;  // corrected and completed
  double isc_A = 0;    // of the readings
  double voc_V = 0;
  double g1 = 0;  // W/m2
  double t1_C = 0;
};

// Corrects the readings and completes them down to a current of -`lowest_part` Isc.
Expected<Moving> Begin(const PreparedCurve& curve, const TranslationInputs& inputs,
                       double lowest_part) {
  Moving at;
  at.points = TruePoints(curve.points, inputs);
  at.g1 = EquivalentIrradiance(inputs);
  at.t1_C = inputs.temperature_C;
  if (!(at.g1 > 0)) return Fail("the curve was taken without light");
  if (!curve.diode) return Fail("no single diode fits the readings, which end at the axes");
  const SingleDiodeFit diode = TrueDiode(*curve.diode, inputs);
  const KeyPoints key = KeyPointsBy(KeyPointMethod::kInterpolated, at.points);
  const double lowest_V = at.points.voltage_V.empty() ? 0 : -0.4 * at.points.voltage_V.back();
  at.isc_A = key.short_circuit_current_A;
  if (std::isnan(at.isc_A)) at.isc_A = diode.photocurrent_A;
  at.points = Completed(at.points, diode, lowest_V, -(lowest_part + 0.02) * at.isc_A);
  at.voc_V = KeyPointsBy(KeyPointMethod::kInterpolated, at.points).open_circuit_voltage_V;
  if (std::isnan(at.voc_V)) return Fail("the readings do not come to open circuit");
  return at;
}

// IEC 60891:2021, procedure 1:
//   I2 = I1 + Isc1 (G2 / G1 - 1) + alpha (T2 - T1)
//   V2 = V1 - Rs (I2 - I1) - kappa I2 (T2 - T1) + beta (T2 - T1)
// alpha is stated for 1000 W/m2 and scaled in proportion to the target's irradiance.
Expected<CurvePoints> ByProcedure1(const PreparedCurve& curve, const TranslationInputs& in) {
  const double g2 = curve.target.irradiance_W_m2;
  TRY(Moving at, Begin(curve, in, std::max(0.0, g2 / EquivalentIrradiance(in) - 1)));
  const double dt = curve.target.temperature_C - at.t1_C;
  const double alpha = in.alpha_sc_A_K * g2 / 1000;
  for (std::size_t i = 0; i < at.points.voltage_V.size(); ++i) {
    const double i1 = at.points.current_A[i];
    const double i2 = i1 + at.isc_A * (g2 / at.g1 - 1) + alpha * dt;
    at.points.current_A[i] = i2;
    at.points.voltage_V[i] +=
        -in.resistance_series_ohm * (i2 - i1) - in.kappa_ohm_K * i2 * dt + in.beta_oc_V_K * dt;
  }
  return at.points;
}

// IEC 60891:2021, procedure 2, with alpha and beta relative to the values at standard conditions:
//   I2 = I1 G2 / G1 (1 + alpha (T2 - 25)) / (1 + alpha (T1 - 25))
//   V2 = V1 - R's1 (I2 - I1) - kappa' I2 (T2 - T1)
//        + Voc_stc (beta (f(G2) (T2 - 25) - f(G1) (T1 - 25)) + 1 / f(G2) - 1 / f(G1))
//   R's1 = R's + kappa' (T1 - 25)
//   f(G) = Voc_stc / Voc(G) = 1 + B1 ln(1000 / G) + B2 ln(1000 / G)^2
// Voc_stc is computed from the curve's own Voc by the equation of V2.
Expected<CurvePoints> ByProcedure2(const PreparedCurve& curve, const TranslationInputs& in) {
  TRY(Moving at, Begin(curve, in, 0));
  const auto f = [&](double g) {
    const double x = std::log(1000 / g);
    return 1 + x * (in.b1 + x * in.b2);
  };
  const double g2 = curve.target.irradiance_W_m2, t2_C = curve.target.temperature_C;
  const double f1 = f(at.g1), f2 = f(g2);
  if (!(f1 > 0 && f2 > 0)) return Fail("B1 and B2 leave no Voc at this light");
  const double from_25 = at.t1_C - kReferenceTemperature_C;
  const double to_25 = t2_C - kReferenceTemperature_C;
  const double voc_stc = f1 * (at.voc_V - in.beta_oc_V_K * f1 * from_25);
  const double isc_stc = at.isc_A * 1000 / at.g1 - in.alpha_sc_A_K * from_25;
  const double alpha = in.alpha_sc_A_K / isc_stc;
  const double gain = g2 / at.g1 * (1 + alpha * to_25) / (1 + alpha * from_25);
  const double shift = in.beta_oc_V_K * (f2 * to_25 - f1 * from_25) + voc_stc * (1 / f2 - 1 / f1);
  const double rs = in.resistance_series_ohm + in.kappa_ohm_K * from_25;
  for (std::size_t i = 0; i < at.points.voltage_V.size(); ++i) {
    const double i1 = at.points.current_A[i], i2 = gain * i1;
    at.points.current_A[i] = i2;
    at.points.voltage_V[i] += -rs * (i2 - i1) - in.kappa_ohm_K * i2 * (t2_C - at.t1_C) + shift;
  }
  return at.points;
}

// IEC 60891:2021, procedure 4 (Hishikawa et al., doi:10.1109/JPHOTOV.2017.2762586), for crystalline
// silicon. The irradiance is corrected first, then the temperature, whose coefficient depends on
// the voltage itself:
//   I' = I1 + Isc1 (G2 / G1 - 1),        V' = V1 - Rs (I' - I1)
//   I2 = I' + alpha (T2 - T1),           V2 = V' + (T2 - T1) / T1 (V' - Ns n Eg / q)
// T1 in kelvin. V' is the voltage of the terminals, not of the junction. This implies an Rs in
// proportion to T, which is nearly true of metals.
Expected<CurvePoints> ByProcedure4(const PreparedCurve& curve, const TranslationInputs& in) {
  const double g2 = curve.target.irradiance_W_m2;
  TRY(Moving at, Begin(curve, in, std::max(0.0, g2 / EquivalentIrradiance(in) - 1)));
  const double dt = curve.target.temperature_C - at.t1_C;
  const double part = dt / (at.t1_C + kZeroCelsius_K);
  const double barrier_V = curve.cells_in_series * in.epsilon_V;
  const double rs = in.resistance_series_ohm;
  for (std::size_t i = 0; i < at.points.voltage_V.size(); ++i) {
    const double i1 = at.points.current_A[i];
    const double lit = i1 + at.isc_A * (g2 / at.g1 - 1);
    const double v = at.points.voltage_V[i] - rs * (lit - i1);
    at.points.current_A[i] = lit + in.alpha_sc_A_K * g2 / 1000 * dt;
    at.points.voltage_V[i] = v + part * (v - barrier_V);
  }
  return at.points;
}

}  // namespace

CurvePoints TruePoints(const CurvePoints& read, const TranslationInputs& inputs) {
  CurvePoints points = read;
  for (std::size_t i = 0; i < points.voltage_V.size(); ++i) {
    const double current = inputs.current_gain * read.current_A[i] + inputs.current_offset_A;
    points.current_A[i] = current;
    points.voltage_V[i] = inputs.voltage_gain * read.voltage_V[i] + inputs.voltage_offset_V +
                          inputs.lead_resistance_ohm * current;
  }
  return points;
}

SingleDiodeFit TrueDiode(const SingleDiodeFit& read, const TranslationInputs& inputs) {
  const double gain = inputs.voltage_gain / inputs.current_gain;
  SingleDiodeFit diode = read;
  diode.photocurrent_A *= inputs.current_gain;
  diode.saturation_current_A *= inputs.current_gain;
  diode.nNsVth_V *= inputs.voltage_gain;
  diode.resistance_series_ohm = gain * read.resistance_series_ohm - inputs.lead_resistance_ohm;
  diode.resistance_shunt_ohm *= gain;
  return diode;
}

KeyPoints KeyPointsBy(KeyPointMethod method, const CurvePoints& points) {
  return method == KeyPointMethod::kE1036 ? E1036KeyPoints(points.voltage_V, points.current_A)
                                          : FindKeyPoints(points.voltage_V, points.current_A);
}

Expected<CurvePoints> TranslatedPoints(Procedure procedure, const PreparedCurve& curve,
                                       const TranslationInputs& inputs, int alternative) {
  switch (procedure) {
    case Procedure::kIec1:
      return ByProcedure1(curve, inputs);
    case Procedure::kIec2:
      return ByProcedure2(curve, inputs);
    case Procedure::kIec3:
      return BetweenCurves(curve, inputs);
    case Procedure::kIec4:
      return ByProcedure4(curve, inputs);
    case Procedure::kExtended:
      return ExtendedPoints(curve, inputs, alternative);
    case Procedure::kDeSoto:
    case Procedure::kPvsyst:
      break;
  }
  return DiodePoints(procedure, curve, inputs);
}

Expected<KeyPoints> TranslatedKeyPoints(Procedure procedure, const PreparedCurve& curve,
                                        const TranslationInputs& inputs, int alternative) {
  if (procedure == Procedure::kDeSoto || procedure == Procedure::kPvsyst) {
    return DiodeKeyPoints(procedure, curve, inputs);
  }
  if (procedure == Procedure::kExtended) return ExtendedKeyPoints(curve, inputs, alternative);
  TRY(const CurvePoints points, TranslatedPoints(procedure, curve, inputs, alternative));
  const KeyPoints key = KeyPointsBy(curve.key_points, points);
  if (!(key.max_power_W > 0)) return Fail("the translated curve has no point of maximum power");
  return key;
}

}  // namespace lyrefit

// Experimental: may change in a minor version (data/stable).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/model/device.h"

namespace LYREFIT_PUBLIC lyrefit {

// Procedures that translate a curve from (G1, T1) to (G2, T2). Equations are in procedures.cc and
// model_procedures.cc, clauses in the module's README.
enum class Procedure {
  kIec1,      // IEC 60891:2021, procedure 1: points, by alpha, beta, kappa and Rs
  kIec2,      // procedure 2: relative coefficients, Voc by the logarithm of G
  kIec3,      // procedure 3: between (or beyond) curves at other conditions
  kIec4,      // procedure 4: crystalline silicon, without coefficients of Voc
  kDeSoto,    // single diode, parameters by De Soto, Klein and Beckman 2006
  kPvsyst,    // single diode, parameters by PVsyst's law
  kExtended,  // diagnosed model: keeps causes in the device, removes the sweep's
};

template <>
struct EnumTable<Procedure> {
  static constexpr EnumText<Procedure> kRows[] = {
      {Procedure::kIec1, "iec1"},        {Procedure::kIec2, "iec2"},
      {Procedure::kIec3, "iec3"},        {Procedure::kIec4, "iec4"},
      {Procedure::kDeSoto, "desoto"},    {Procedure::kPvsyst, "pvsyst"},
      {Procedure::kExtended, "extended"}};
};

// All uncertain inputs of a translated curve besides its readings. Instances hold either values or
// standard uncertainties.
struct TranslationInputs {
  double irradiance_W_m2 = 0;       // on the front during the sweep, G1
  double rear_irradiance_W_m2 = 0;  // on the back; IEC TS 60904-1-2: G = G_front + phi G_rear
  double bifaciality_isc = 0;       // phi, of Isc
  double temperature_C = 0;         // of the cells, T1
  double voltage_gain = 0;          // true / read (value 1)
  double voltage_offset_V = 0;      // true - read at 0 V
  double current_gain = 0;          // true / read (value 1)
  double current_offset_A = 0;
  double lead_resistance_ohm = 0;    // I R_lead is added to the corrected voltage
  double alpha_sc_A_K = 0;           // of Isc at 1000 W/m2
  double beta_oc_V_K = 0;            // of Voc
  double kappa_ohm_K = 0;            // curve correction factor
  double resistance_series_ohm = 0;  // internal, procedures 1, 2 and 4
  double b1 = 0;                     // procedure 2: Voc(STC) / Voc(G) = 1 + B1 x + B2 x^2,
  double b2 = 0;                     // x = ln(1000 / G)
  double epsilon_V = 0;              // procedure 4: n Eg / q of one cell
  double EgRef_eV = 0;               // band gap at 25 C; De Soto without an anchor
  double dEgdT_1_K = 0;              // relative slope of the band gap: De Soto
  double mu_gamma_1_K = 0;           // slope of the ideality: PVsyst without an anchor
};

// One member of TranslationInputs, for loops over all of them (budgets, JSON).
struct TranslationInput {
  const char* name;  // with its unit, as in JSON
  const char* unit;
  const char* title;                 // "irradiance", for tables
  double TranslationInputs::*field;  // the member itself
};

// All members, in the order of the struct.
inline constexpr TranslationInput kTranslationInputs[] = {
    {"irradiance_W_m2", "W/m2", "irradiance", &TranslationInputs::irradiance_W_m2},
    {"rear_irradiance_W_m2", "W/m2", "irradiance of the back",
     &TranslationInputs::rear_irradiance_W_m2},
    {"bifaciality_isc", "", "bifaciality of Isc", &TranslationInputs::bifaciality_isc},
    {"temperature_C", "C", "cell temperature", &TranslationInputs::temperature_C},
    {"voltage_gain", "", "calibration of the voltage", &TranslationInputs::voltage_gain},
    {"voltage_offset_V", "V", "offset of the voltage", &TranslationInputs::voltage_offset_V},
    {"current_gain", "", "calibration of the current", &TranslationInputs::current_gain},
    {"current_offset_A", "A", "offset of the current", &TranslationInputs::current_offset_A},
    {"lead_resistance_ohm", "ohm", "resistance of the leads",
     &TranslationInputs::lead_resistance_ohm},
    {"alpha_sc_A_K", "A/K", "alpha (Isc)", &TranslationInputs::alpha_sc_A_K},
    {"beta_oc_V_K", "V/K", "beta (Voc)", &TranslationInputs::beta_oc_V_K},
    {"kappa_ohm_K", "ohm/K", "kappa", &TranslationInputs::kappa_ohm_K},
    {"resistance_series_ohm", "ohm", "internal series resistance",
     &TranslationInputs::resistance_series_ohm},
    {"b1", "", "B1", &TranslationInputs::b1},
    {"b2", "", "B2", &TranslationInputs::b2},
    {"epsilon_V", "V", "n Eg / q", &TranslationInputs::epsilon_V},
    {"EgRef_eV", "eV", "band gap", &TranslationInputs::EgRef_eV},
    {"dEgdT_1_K", "1/K", "slope of the band gap", &TranslationInputs::dEgdT_1_K},
    {"mu_gamma_1_K", "1/K", "slope of the ideality", &TranslationInputs::mu_gamma_1_K},
};

// How Isc, Voc and the maximum power are determined from points.
enum class KeyPointMethod {
  kInterpolated,  // curve/key_points.h
  kE1036,         // ASTM E1036, annex: straight lines and a polynomial in windows
};

template <>
struct EnumTable<KeyPointMethod> {
  static constexpr EnumText<KeyPointMethod> kRows[] = {
      {KeyPointMethod::kInterpolated, "interpolated"}, {KeyPointMethod::kE1036, "e1036"}};
};

// Conditions of the translated curve; standard test conditions by default.
struct TranslationTarget {
  double irradiance_W_m2 = 1000;
  double temperature_C = 25;
};

// Points of a curve by rising voltage; both arrays have one length.
struct CurvePoints {
  std::vector<double> voltage_V;
  std::vector<double> current_A;
};

// Single-diode parameters of the readings as recorded, at the measured conditions. TrueDiode
// corrects them exactly for gains and leads, so that one fit suffices.
struct SingleDiodeFit {
  double photocurrent_A = 0;
  double saturation_current_A = 0;
  double nNsVth_V = 0;
  double resistance_series_ohm = 0;
  double resistance_shunt_ohm = 0;
};

// Another curve of the device for procedure 3, with the lead resistance and gains of the first.
struct FurtherCurve {
  CurvePoints points;
  double irradiance_W_m2 = 0;  // front plus bifaciality times rear
  double temperature_C = 25;
  std::optional<SingleDiodeFit> diode;
};

// The diagnosed device (extended_model.h).
struct ExtendedModel;

struct Translation;  // model/translation.h

// A parameter of a law, fitted so that Voc follows beta, as a linear function of beta.
struct BetaAnchor {
  double beta_V_K = 0;
  double value = 0;       // of the parameter at beta_V_K
  double slope = 0;       // its derivative by beta
  double bandgap_eV = 0;  // used while mu_gamma was fitted
  // The parameter at another beta.
  double At(double beta) const { return value + slope * (beta - beta_V_K); }
};

// A prepared curve: everything that is constant while the inputs vary.
struct PreparedCurve {
  CurvePoints points;
  int cells_in_series = 1;
  std::optional<SingleDiodeFit> diode;  // none: the fit failed
  // Why the fit is no model of the device. It may still extend the readings beyond the axes. Empty:
  // it is a model.
  std::string why_no_model;
  std::vector<FurtherCurve> further;
  KeyPointMethod key_points = KeyPointMethod::kInterpolated;
  TranslationTarget target;
  double noise_A = 0;                  // standard deviation of a reading's current
  std::optional<BetaAnchor> bandgap;   // De Soto's; none: as stated
  std::optional<BetaAnchor> mu_gamma;  // PVsyst's; none: as stated
  // Both laws for `cells_in_series` (procedure_steps.h); nullptr: rebuilt at every call.
  std::shared_ptr<const Translation> desoto;
  std::shared_ptr<const Translation> pvsyst;
  // The diagnosis first, then one model for each equivalent cause.
  std::vector<std::shared_ptr<const ExtendedModel>> models;
};

// Equivalent irradiance, IEC TS 60904-1-2: front + phi rear.
inline double EquivalentIrradiance(const TranslationInputs& inputs) {
  return inputs.irradiance_W_m2 + inputs.bifaciality_isc * inputs.rear_irradiance_W_m2;
}

// The readings corrected for gains, offsets and leads: I = gain I + offset, V = gain V + offset + I
// R_lead.
CurvePoints TruePoints(const CurvePoints& read, const TranslationInputs& inputs);

// The diode corrected as TruePoints corrects its readings: the voltage gain scales nNsVth, the
// current gain Iph and Is, and Rs loses the leads. Offsets are ignored; they are small against Voc
// and Isc.
SingleDiodeFit TrueDiode(const SingleDiodeFit& read, const TranslationInputs& inputs);

// Key points by the given method.
KeyPoints KeyPointsBy(KeyPointMethod method, const CurvePoints& points);

// Isc, Voc, Imp, Vmp, Pmax, FF at the target. Pure; no fit is repeated, so a call takes
// microseconds (some hundred for the extended model). `alternative`: index into `models`. Errors:
// an input of the procedure is missing (points beyond an axis, a fit, a further curve), or the
// model has no value at the target.
Expected<KeyPoints> TranslatedKeyPoints(Procedure procedure, const PreparedCurve& curve,
                                        const TranslationInputs& inputs, int alternative = 0);

// The translated curve; for the laws 200 points at even voltages, for the extended model up to 400.
Expected<CurvePoints> TranslatedPoints(Procedure procedure, const PreparedCurve& curve,
                                       const TranslationInputs& inputs, int alternative = 0);

}  // namespace lyrefit

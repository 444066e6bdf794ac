#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/law/device.h"

namespace LYREFIT_PUBLIC lyrefit {

// How a curve measured at (G1, T1) is carried to (G2, T2). Equations in procedures.cc and
// model_procedures.cc, clauses in the module's README.
enum class Procedure {
  kIec1,      // IEC 60891:2021 procedure 1: alpha, beta, kappa and Rs, points moved
  kIec2,      // procedure 2: relative coefficients, logarithm of the light in Voc
  kIec3,      // procedure 3: between (or beyond) curves measured under other conditions
  kIec4,      // procedure 4: crystalline silicon, no coefficients of the voltage
  kDeSoto,    // single diode, parameters by De Soto, Klein and Beckman 2006
  kPvsyst,    // single diode, parameters by PVsyst's law
  kExtended,  // the diagnosed model: causes in the device stay, those of the sweep are taken out
};

template <>
struct EnumTable<Procedure> {
  static constexpr EnumText<Procedure> kRows[] = {
      {Procedure::kIec1, "iec1"},        {Procedure::kIec2, "iec2"},
      {Procedure::kIec3, "iec3"},        {Procedure::kIec4, "iec4"},
      {Procedure::kDeSoto, "desoto"},    {Procedure::kPvsyst, "pvsyst"},
      {Procedure::kExtended, "extended"}};
};

// Everything a translated curve depends on besides its readings and that somebody may be wrong
// about. The same struct holds values and, in another instance, their standard uncertainties.
struct TranslationInputs {
  double irradiance_W_m2 = 0;       // on the front while the curve was taken, G1
  double rear_irradiance_W_m2 = 0;  // on the back; IEC TS 60904-1-2: G = G_front + phi G_rear
  double bifaciality_isc = 0;       // phi, of Isc
  double temperature_C = 0;         // of the cells, T1
  double voltage_gain = 0;          // true / read (value 1)
  double voltage_offset_V = 0;      // true - read at 0 V
  double current_gain = 0;          // true / read (value 1)
  double current_offset_A = 0;
  double lead_resistance_ohm = 0;    // V I adds to the voltage read before anything else
  double alpha_sc_A_K = 0;           // of Isc at 1000 W/m2
  double beta_oc_V_K = 0;            // of Voc
  double kappa_ohm_K = 0;            // curve correction factor
  double resistance_series_ohm = 0;  // internal, procedures 1, 2 and 4
  double b1 = 0;                     // procedure 2: Voc(STC) / Voc(G) = 1 + B1 x + B2 x^2,
  double b2 = 0;                     // x = ln(1000 / G)
  double epsilon_V = 0;              // procedure 4: n Eg / q of one cell
  double EgRef_eV = 0;               // band gap at 25 C; De Soto's where it is not anchored
  double dEgdT_1_K = 0;              // its relative slope: De Soto
  double mu_gamma_1_K = 0;           // slope of the ideality: PVsyst where it is not anchored
};

// One of them, for whoever walks them all: budgets, JSON.
struct TranslationInput {
  const char* name;  // with its unit, as in JSON
  const char* unit;
  const char* title;                 // "irradiance", for tables
  double TranslationInputs::*field;  // where it stands
};

// All of them, in the order of the struct.
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

// How Isc, Voc and the maximum power are read off a curve.
enum class KeyPointMethod {
  kInterpolated,  // curve/key_points.h
  kE1036,         // ASTM E1036, annex: straight lines and a polynomial in windows
};

template <>
struct EnumTable<KeyPointMethod> {
  static constexpr EnumText<KeyPointMethod> kRows[] = {
      {KeyPointMethod::kInterpolated, "interpolated"}, {KeyPointMethod::kE1036, "e1036"}};
};

// The conditions that a curve is carried to: standard ones unless said.
struct TranslationTarget {
  double irradiance_W_m2 = 1000;
  double temperature_C = 25;
};

// Readings as recorded, in order of voltage, and under what they were taken.
struct CurvePoints {
  std::vector<double> voltage_V;
  std::vector<double> current_A;
};

// The single diode of the readings as recorded: its parameters bend exactly with every input, so
// the fit is done once.
struct SingleDiodeFit {
  double photocurrent_A = 0;
  double saturation_current_A = 0;
  double nNsVth_V = 0;
  double resistance_series_ohm = 0;
  double resistance_shunt_ohm = 0;
};

// Another curve of the same device, its lead resistance and gains those of the first: procedure 3.
struct FurtherCurve {
  CurvePoints points;
  double irradiance_W_m2 = 0;  // front and back together
  double temperature_C = 25;
  std::optional<SingleDiodeFit> diode;
};

// The device as diagnosed (extended_model.h); an alternative for every cause that explains as much.
struct ExtendedModel;

struct Translation;  // law/translation.h

// A parameter of a diode's law that is such that Voc moves by beta: what follows when beta does.
struct BetaAnchor {
  double beta_V_K = 0;
  double value = 0;       // of the parameter, where Voc moves by beta_V_K
  double slope = 0;       // of it along beta
  double bandgap_eV = 0;  // beside which mu_gamma was found
  // The parameter for another beta.
  double At(double beta) const { return value + slope * (beta - beta_V_K); }
};

// A curve made ready: what does not change from one set of inputs to the next.
struct PreparedCurve {
  CurvePoints points;
  int cells_in_series = 1;
  std::optional<SingleDiodeFit> diode;  // none: there is no fit at all
  // The fit misses the readings: it may end them beyond the axes, but is no model of the device.
  // Empty: it is one.
  std::string why_no_model;
  std::vector<FurtherCurve> further;
  KeyPointMethod key_points = KeyPointMethod::kInterpolated;
  TranslationTarget target;
  double noise_A = 0;                  // standard deviation of a reading's current
  std::optional<BetaAnchor> bandgap;   // De Soto's; none: as stated
  std::optional<BetaAnchor> mu_gamma;  // PVsyst's; none: as stated
  // Both laws for so many cells (model_procedures.h); none: they are made anew for every answer.
  std::shared_ptr<const Translation> desoto;
  std::shared_ptr<const Translation> pvsyst;
  // The first is the diagnosis, the others name another cause.
  std::vector<std::shared_ptr<const ExtendedModel>> models;
};

// The light that counts, IEC TS 60904-1-2: front + phi rear.
inline double EquivalentIrradiance(const TranslationInputs& inputs) {
  return inputs.irradiance_W_m2 + inputs.bifaciality_isc * inputs.rear_irradiance_W_m2;
}

// The readings with gains, offsets and leads allowed for: I = gain I + offset,
// V = gain V + offset + I R_lead.
CurvePoints TruePoints(const CurvePoints& read, const TranslationInputs& inputs);

// The same for the diode behind them, exactly: a gain of the voltage stretches nNsVth, one of the
// current Iph and Is, the leads leave Rs. Offsets are left out, they are small against both axes.
SingleDiodeFit TrueDiode(const SingleDiodeFit& read, const TranslationInputs& inputs);

// Key points of points by the method asked for.
KeyPoints KeyPointsBy(KeyPointMethod method, const CurvePoints& points);

// Isc, Voc, Imp, Vmp, Pmax, FF at the target. Pure, and cheap enough to be called thousands of
// times: no fit is repeated (microseconds; some hundred for the extended model). `alternative`: which of
// `models`. Errors: what the procedure needs is not there (no points beyond an axis, no fit, no
// further curve, a device whose model has no value there).
Expected<KeyPoints> TranslatedKeyPoints(Procedure procedure, const PreparedCurve& curve,
                                        const TranslationInputs& inputs, int alternative = 0);

// The curve behind them; of a model 200 even points.
Expected<CurvePoints> TranslatedPoints(Procedure procedure, const PreparedCurve& curve,
                                       const TranslationInputs& inputs, int alternative = 0);

}  // namespace lyrefit

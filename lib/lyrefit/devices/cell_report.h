// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/assumption.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/estimate/refine/estimate.h"

// Records of the description of one laboratory cell. Voltages are in V of the whole device,
// currents in A and generator sign, resistances in ohm. An unknown value is NaN. Fractions are
// fractions, not percentages, unless the name says so.
namespace LYREFIT_PUBLIC lyrefit {

// What a sweep measures.
enum class SweepKind {
  kLit,
  kDark,
  kSunsVoc,  // open-circuit voltages over light
};

template <>
struct EnumTable<SweepKind> {
  static constexpr EnumText<SweepKind> kRows[] = {
      {SweepKind::kLit, "lit"}, {SweepKind::kDark, "dark"}, {SweepKind::kSunsVoc, "Suns-Voc"}};
};

// Direction of a sweep.
enum class ScanDirection {
  kForward,  // towards higher voltages
  kReverse,
};

template <>
struct EnumTable<ScanDirection> {
  static constexpr EnumText<ScanDirection> kRows[] = {{ScanDirection::kForward, "forward"},
                                                      {ScanDirection::kReverse, "reverse"}};
};

// A key point that the file states for a sweep, beside the computed one.
struct StatedKeyPoint {
  std::string name;          // "Jsc (mA/cm2)"
  double stated = kUnknown;  // in the unit of the name
  double found = kUnknown;   // in the same unit
  std::string source;        // "line 7 'Jsc [mA/cm2]: ...'"
};

// One sweep and its figures.
struct CellSweep {
  std::string name;  // "forward, 1000 W/m2"
  std::string file;  // it was read from
  SweepKind kind = SweepKind::kLit;
  ScanDirection direction = ScanDirection::kForward;
  double irradiance_W_m2 = kUnknown;
  bool irradiance_known = true;     // false: a default is assumed
  double scan_rate_V_s = kUnknown;  // that is stated, else of the times of the readings
  double elapsed_h = kUnknown;    // hours of operation or light before it, or since the first sweep
  std::vector<double> voltage_V;  // rising; equal voltages are averaged
  std::vector<double> current_A;  // of each voltage
  double suns_voc_A = kUnknown;   // see IvCurve::suns_voc_A
  bool pseudo_current = false;    // see IvCurve::pseudo_current
  double noise_A = 0;             // of a current, from second differences
  int limited = 0;                // readings left out at a limit of the current
  KeyPoints key = {};             // of a lit sweep, read off the readings
  std::string doubt;              // why current or area are of no cell (CheckReadings); empty: none
  bool refused = false;           // the doubt allows no figures of the sweep
  std::string no_efficiency_because;        // the light is not known; empty: it is
  double jsc_mA_cm2 = kUnknown;             // Isc / area; NaN where there is a doubt
  double efficiency = kUnknown;             // Pmp / (irradiance x area); NaN where there is a doubt
  double resistance_at_isc_ohm = kUnknown;  // -dV/dI at 0 V
  double resistance_at_voc_ohm = kUnknown;  // -dV/dI at Voc
  // Least ratio of the slope -dI/dV to a larger one at a lower voltage, from 0.3 to 1.1 Voc past the
  // knee; 1: it only rises there. An S-shape has less than 0.9.
  double least_slope_ratio = 1;
  std::optional<FitReport> fit;           // of the single-diode model
  std::string no_fit_because;             // empty: there is one, or it was not requested
  std::vector<std::string> void_because;  // why n and Rs of the fit describe no diode; empty: none
  std::vector<StatedKeyPoint> stated;     // key points that the file states

  // Whether the fit's n and Rs may be used.
  bool diode() const { return fit.has_value() && void_because.empty(); }
};

// What a pair of directions shows.
enum class HysteresisSense {
  kNone,      // a gap below the least that counts
  kNormal,    // reverse gives more power
  kInverted,  // forward gives more power
  kNeither,   // a gap, but an index by power below its noise
};

template <>
struct EnumTable<HysteresisSense> {
  static constexpr EnumText<HysteresisSense> kRows[] = {{HysteresisSense::kNone, "none"},
                                                        {HysteresisSense::kNormal, "normal"},
                                                        {HysteresisSense::kInverted, "inverted"},
                                                        {HysteresisSense::kNeither, "neither"}};
};

// Comparison of a forward and a reverse sweep under one light, J of both. Indices are positive
// where the reverse sweep gives more.
struct DirectionPair {
  int forward = 0;  // index into CellReport::sweeps
  int reverse = 0;  // index into CellReport::sweeps
  double index_power =
      kUnknown;  // (Pmp_rev - Pmp_fwd) / Pmp_rev; doi:10.1021/acsenergylett.8b01627
  double index_noise =
      kUnknown;  // standard error of the index by power, of the noise of the readings
  double index_area = kUnknown;     // 1 - A_fwd / A_rev, A the area below J from 0 V to its own Voc
  double index_at_80 = kUnknown;    // (J_rev - J_fwd) / J_rev at 0.8 Voc of the reverse sweep
  double index_at_50 = kUnknown;    // the same at 0.5 Voc
  double gap_percent = kUnknown;    // rms of J_rev - J_fwd from 0 V to the larger Voc, of Jsc_rev
  double noise_percent = kUnknown;  // that the noise of both adds to the gap
  double voc_difference_V = kUnknown;  // reverse minus forward
  double isc_difference = kUnknown;    // reverse minus forward, relative to reverse
  double ff_difference = kUnknown;     // reverse minus forward, absolute
  HysteresisSense sense = HysteresisSense::kNone;
  bool cross = false;  // whether the curves cross, so that the index by power hides the gap
  std::vector<std::string> causes;  // of hysteresis, that this pair does not tell apart
};

// Pairs of directions at several rates of the sweep.
struct HysteresisOverRate {
  std::vector<int> pairs;           // indices into CellReport::pairs, by rising rate
  std::string finding;              // "a maximum at 0.2 V/s"; empty: no pair has hysteresis
  std::vector<std::string> causes;  // that the rates leave
};

// An open-circuit voltage and the light at which it was measured, as a photocurrent.
struct VocPoint {
  double light_A = kUnknown;
  double voc_V = kUnknown;
};

// Ideality between two neighbouring lights.
struct LocalIdeality {
  double low_A = kUnknown;  // photocurrents
  double high_A = kUnknown;
  double n = kUnknown;  // between them
};

// n = (q / k T Ns) dVoc / dln(light), with the light as each point's own photocurrent. No series
// resistance is in it.
struct IdealityOverLight {
  SweepKind source = SweepKind::kLit;  // a series of lit curves, or a Suns-Voc trace
  std::vector<VocPoint> points;        // by rising light
  Ranged n;                            // least squares over all points
  // Of the junction beside a shunt, light = Is exp(Voc / n) + Voc / Rsh by least squares over the
  // lights from 1/30 to 3 times Isc of the brightest lit curve; of fewer than 12 lights from the two
  // around that Isc.
  Ranged junction;
  Ranged shunt_S;      // of that shunt, 0 where none is seen
  double noise_V = 0;  // of a voltage, by the scatter around this; 0 of few lights
  // By rising light: of points that are so far apart that noise is at most 5 % of n.
  std::vector<LocalIdeality> local;
  // Whether the local n rises towards low light, as a shunt makes it: n / (1 - Voc / (Rsh Isc)).
  bool rises_to_low_light = false;
};

// n of a dark curve.
struct DarkIdeality {
  int sweep = 0;                    // index into CellReport::sweeps
  double least_n = kUnknown;        // smallest local ideality (q / k T Ns) / (dln|J| / dV)
  double at_V = kUnknown;           // where
  double plateau_low_V = kUnknown;  // range of voltages where it is within 10 % of the smallest
  double plateau_high_V = kUnknown;
  Ranged fitted;  // n of the single-diode fit of the dark curve
};

// How a series resistance is found.
enum class SeriesMethod {
  kFit,          // of a lit sweep
  kTwoLights,    // two lit sweeps
  kDark,         // a lit and a dark sweep
  kSunsVoc,      // a lit sweep and a Suns-Voc trace
  kVocOfLights,  // a lit sweep and Voc of those under other lights
  kSlope,        // at Voc
};

template <>
struct EnumTable<SeriesMethod> {
  static constexpr EnumText<SeriesMethod> kRows[] = {
      {SeriesMethod::kFit, "single-diode fit"},
      {SeriesMethod::kTwoLights, "two lights"},
      {SeriesMethod::kDark, "lit against dark"},
      {SeriesMethod::kSunsVoc, "Suns-Voc against lit"},
      {SeriesMethod::kVocOfLights, "Voc of the light series against lit"},
      {SeriesMethod::kSlope, "slope at Voc"}};
};

// One estimate of the series resistance.
struct SeriesResistance {
  SeriesMethod method = SeriesMethod::kFit;
  std::string of;       // "1000 and 500 W/m2"; empty: the method says all
  Ranged ohm;           // without an interval where the method has none
  std::string note;     // definition, or what else is in it
  std::string missing;  // why there is no value; empty: there is one

  // "two lights, 1000 and 500 W/m2".
  std::string Name() const { return ToText(method) + (of.empty() ? "" : ", " + of); }
};

// Where a fill factor without series resistance is from.
enum class PseudoSource {
  kNone,     // no sweep is lit
  kSunsVoc,  // a Suns-Voc trace
  kLights,   // Voc of lit sweeps
  kFit,
};

template <>
struct EnumTable<PseudoSource> {
  static constexpr EnumText<PseudoSource> kRows[] = {
      {PseudoSource::kNone, ""},
      {PseudoSource::kSunsVoc, "Suns-Voc"},
      {PseudoSource::kLights, "Voc of the light series"},
      {PseudoSource::kFit, "the fit with Rs = 0"}};
};

// Fill factor of the curve without series resistance.
struct PseudoFillFactor {
  double value = kUnknown;  // without Rs
  double ideal = kUnknown;  // of a diode with n = 1 and the measured Isc and Voc
  PseudoSource source = PseudoSource::kNone;
};

// A step of the fill-factor losses.
struct FillFactorPart {
  std::string name;  // "recombination: n = 1 to 1.5"
  Ranged loss;       // absolute, positive: fill factor lost
};

// Fill-factor losses of one lit sweep, from the curves of its fit with Isc and Voc held.
struct FillFactorLosses {
  int sweep = 0;                          // index into CellReport::sweeps
  double ideal = kUnknown;                // n = 1, no resistances
  double without_resistances = kUnknown;  // fitted n, no resistances
  double without_series = kUnknown;       // fitted n and Rsh
  double fitted = kUnknown;               // fitted n, Rsh and Rs
  double measured = kUnknown;             // of the readings
  // Recombination, shunt, series resistance, rest: ideal minus their sum is `measured`.
  std::vector<FillFactorPart> parts;
  double green_n1 = kUnknown;      // Green's FF0 with n = 1; doi:10.1016/0038-1101(81)90062-9
  double green_fitted = kUnknown;  // with the fitted n
  std::string missing;             // why there are no losses; empty: there are
};

// J_light(V) compared with Jsc - J_dark(V), each over its voltage without its series resistance.
struct Superposition {
  int lit = 0;            // indices into CellReport::sweeps
  int dark = 0;           // index of the dark one
  double lit_rs_ohm = 0;  // that were taken off
  double dark_rs_ohm = 0;
  std::string rs_from;   // method of the one in the light
  std::string not_with;  // method whose estimate leaves a departure; empty: none was tried before
  double rms_percent = kUnknown;      // of J_light - (Jsc - J_dark) from 0 V to `to_V`, of Jsc
  double largest_percent = kUnknown;  // signed
  double largest_at_V = kUnknown;
  double to_V = kUnknown;                // last voltage compared: Voc, or the end of the dark curve
  double noise_percent = kUnknown;       // of both currents
  double voc_shift_V = kUnknown;         // Voc minus that of Jsc - J_dark
  double dark_scale = kUnknown;          // factor of J_dark that fits best
  double scaled_rms_percent = kUnknown;  // rms that is left with it
  bool departs = false;                  // beyond noise and the least that counts
  std::vector<std::string> causes;       // that these curves do not tell apart
  std::string decides;                   // the measurement that would
};

// One measurement of a joint estimate.
struct JointMeasurement {
  int sweep = 0;              // index into CellReport::sweeps
  int readings = 0;           // that are fitted
  double rms = kUnknown;      // of the residuals: A, V of a Suns-Voc trace that states its light
  double noise = kUnknown;    // of a reading, from second differences, in the same unit
  double own_rms = kUnknown;  // of the sweep's own fit
  // Standard error of each estimate without this measurement over that with all of them, at least 1;
  // NaN: not known without it.
  std::vector<double> without;
};

// Estimates of one diode model from all measurements of one direction together: curves under
// several lights and in the dark, and Suns-Voc traces. Every curve has a photocurrent of its own.
// Estimates: the device's parameters, then `collection` (loss of photocurrent per volt of the
// junction), then photocurrents, and the factor of the lights that a Suns-Voc trace states.
struct JointEstimate : EstimateReport {
  int shared = 0;  // estimates, the first, that belong to every measurement
  std::vector<JointMeasurement> measurements;
  bool second_diode = false;         // of n = 2; the measurements need it
  double second_diode_p = kUnknown;  // p-value of one diode against it
  // A part of the area is behind a series resistance of its own, as corroded fingers and ribbons make
  // it: the measurements need it.
  bool contacts = false;
  // The lit sweeps are at another temperature than the dark one, parameter dT: the measurements need
  // it, or explain themselves by a second diode as well (`either`).
  bool warmer = false;
  double warmer_p = kUnknown;   // p-value of one temperature against two; NaN: none or all are lit
  double voc_per_K = kUnknown;  // of the law behind dT, V: what the readings tell is the product
  bool either = false;          // a temperature and a second diode explain the readings alike
  double contacts_p =
      kUnknown;  // p-value of one series resistance against it; NaN of a single cell
  // Power that this part loses under the brightest light, beside one with the resistance of the rest.
  Ranged contact_loss_W;
  double series_loss =
      kUnknown;  // part of the power that all series resistance costs, with contacts
  std::vector<std::string> void_because;  // why one diode model is not behind all; empty: it may be
  std::string shunt;                      // what is known of shunt and collection
  // Part of the conductance at short circuit under the brightest light that goes with the light, as
  // collection does and a shunt does not. NaN: the measurements do not tell the two apart.
  double collection_part = kUnknown;
  std::string missing;  // why there is no joint estimate; empty: there is one
};

// Description of one cell.
struct CellReport {
  std::string version;  // of lyrefit
  std::string name;     // of the cell
  std::string source;   // its files
  double area_cm2 = kUnknown;
  bool per_area = false;  // no area is stated: readings are densities, and figures those of 1 cm2
  int cells_in_series = 1;
  double temperature_C = kUnknown;
  double bandgap_eV = kUnknown;   // that the files state
  std::vector<CellSweep> sweeps;  // in the order of measurement
  int main = -1;                  // brightest lit sweep, of equals the first; -1: none is lit
  std::vector<DirectionPair> pairs;
  std::optional<HysteresisOverRate> over_rate;  // two and more rates
  std::vector<IdealityOverLight> over_light;
  std::optional<DarkIdeality> dark;
  std::vector<SeriesResistance> series_resistance;
  PseudoFillFactor pseudo;
  std::vector<FillFactorLosses> losses;  // of the brightest lit sweeps
  std::optional<Superposition> superposition;
  std::optional<JointEstimate> joint;  // two and more measurements
  std::vector<Assumption> assumptions;
  std::vector<std::string> warnings;
  std::vector<OptionEcho> non_default_options;
  bool interrupted = false;

  // Resistance times area in ohm cm2; NaN without an area.
  double PerArea(double ohm) const { return ohm * area_cm2; }
  // Whether one of the fits is usable, or none was asked for.
  bool Usable() const {
    bool fitted = false, usable = false;
    for (const CellSweep& sweep : sweeps) {
      fitted = fitted || sweep.fit.has_value();
      usable = usable || (sweep.fit && sweep.fit->usable);
    }
    return usable || !fitted;
  }
};

}  // namespace lyrefit

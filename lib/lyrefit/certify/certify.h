// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/certify/certify_options.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/model/device.h"

namespace LYREFIT_PUBLIC lyrefit {

// One diode of the mixture that reaches the floor.
struct FloorDiode {
  double n = 0;  // ideality factor, per cell
  double saturation_current_A = 0;
  double current_A = 0;  // at the reference voltage
};

// Floor of the RMSE over any number of diodes in parallel. No RMSE of the objective below
// `lower_bound_A` is possible with n, Rs, Iph and Rsh in the requested ranges and Is >= 0. The
// mixture given here reaches `rmse_A`.
struct Floor {
  double rmse_A = 0;
  double lower_bound_A = 0;
  double gap = 0;          // (rmse - lower bound) / rmse, over the whole range of Rs
  bool certified = false;  // the gap is at most kCertifiedGap, or within rounding
  double photocurrent_A = 0;
  double resistance_series_ohm = 0;
  double conductance_shunt_S = 0;
  std::vector<FloorDiode> diodes;  // in order of falling n
  // The certificate at that Rs: a dual vector with one element per point, in ampere. Its inner
  // product with the column of the photocurrent, of the shunt and of every diode at these junction
  // voltages is zero or negative. A photocurrent or shunt that is active at a bound is the
  // exception. For the measured-current objective both vectors are those of the measured points.
  // With the measured currents b, the dual vector y then proves b . y - |y|^2 / 2 <= half the sum
  // of squares. For the solved-current objective both belong to the problem that is linearised
  // around the solved points.
  std::vector<double> dual_A;
  std::vector<double> junction_voltage_V;
  double duality_gap = 0;  // relative, of the sum of squares; includes the penalty of any excess
  double largest_correlation = 0;  // proved bound of (y . diode column) / |y|; 0: none positive
  std::int64_t solved = 0;         // convex problems solved
};

// Certificate of a model with a fixed number of diodes, each with n and Is in its own ranges. Where
// the device law would clip the exponent of a steep diode (model/term.h), the RMSE is that of
// Shockley's equation without the clip.
struct ModelCertificate {
  Model model = Model::kSingleDiode;
  // The lowest found, in the device's order; diodes of equal ranges by rising n.
  std::vector<double> parameters;
  double rmse_A = 0;
  double lower_bound_A = 0;
  double gap = 0;           // (rmse - lower bound) / rmse
  double above_floor = 0;   // rmse / floor - 1; 0 where the difference is rounding
  bool certified = false;   // the gap is at most kCertifiedGap, or within rounding
  std::int64_t solved = 0;  // convex problems in addition to the floor's; 0: the floor proves it
};
constexpr double kCertifiedRounding = 1e-14;  // x largest current: RMSEs closer than this are equal

// Result of Certify(): proved lower bounds of the RMSE of one curve.
struct Certificate {
  std::string version;
  IvCurve curve;
  CertifyOptions options;  // as requested, with `diodes` filled in
  // Upper end of the range of Rs that is searched. It is the largest forward voltage over the
  // largest current, or more where the tail bound does not suffice, up to the requested end.
  // Without a requested end it is at most four times as much. Above it the points are in the wrong
  // order of junction voltage, which bounds every model at once. The lower bounds hold for the
  // whole requested range.
  double rs_upper_ohm = 0;
  double reference_voltage_V = 0;       // largest voltage at which the device delivers current
  double module_thermal_voltage_V = 0;  // Ns k T / q
  Floor floor;
  std::vector<ModelCertificate> models;
  std::vector<std::string> doubts;  // about the readings, before any fit; see CheckReadings
  std::vector<OptionEcho> non_default_options;
  double seconds = 0;
  bool interrupted = false;
};

// Proves how low the unweighted RMSE of a curve can go.
//
// At each Rs the measured-current problem over mixtures of diodes is convex: non-negative least
// squares over the continuum of n. Its dual vector proves its value (weak duality). The
// solved-current problem is bounded by such problems, linearised around reference currents. The
// bound is reduced by the largest effect of slope differences between the reference and any mixture
// as good as the best one known. Between the Rs visited, the interpolated dual vectors prove a
// lower bound. A branch and bound over Rs closes the gap. A fixed number of diodes is bounded by
// mixtures over ever smaller windows of n, one for each diode.
//
// All bounds hold up to rounding of double arithmetic, about 1e-15 of the largest current. With
// `rigorous` they hold without that reservation: the search is unchanged, but its proofs are
// evaluated in intervals. Every `lower_bound_A` is then at most the RMSE of any admissible model.
// Every `rmse_A` is at least that of the parameters beside it, and every `gap` at least the gap
// between the two. Readings, temperature in kelvin and ranges count as exact doubles, and k / q is
// the exact quotient. `certified` allows for rounding with and without `rigorous`.
//
// Errors: an unusable curve; no point that delivers current at a forward voltage; so few cells that
// every diode's exponent exceeds kLargestExponent of model/term.h; options outside their ranges.
Expected<Certificate> Certify(const IvCurve& curve, const CertifyOptions& asked = {},
                              const Observer& observer = {});

// Cosine between the floor's dual vector and the column of a diode at the floor's Rs, one value for
// each n. It is nowhere positive within the range of n (rounding aside), and zero at the diodes of
// the floor.
std::vector<double> DualCosines(const Certificate& certificate, const std::vector<double>& n);

}  // namespace lyrefit

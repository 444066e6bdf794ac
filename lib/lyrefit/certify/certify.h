#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/certify/certify_options.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/law/device.h"

namespace LYREFIT_PUBLIC lyrefit {

// One diode of the mixture that attains the floor.
struct FloorDiode {
  double n = 0;  // ideality, per cell
  double saturation_current_A = 0;
  double current_A = 0;  // at the reference voltage
};

// No RMSE of the objective below `lower_bound_A` is possible for any number of diodes in parallel
// with n, Rs, Iph and Rsh in the ranges asked for and Is >= 0, and `rmse_A` is attained.
struct Floor {
  double rmse_A = 0;
  double lower_bound_A = 0;
  double gap = 0;          // (rmse - lower bound) / rmse, over the whole range of Rs
  bool certified = false;  // the gap is at most kCertifiedGap, or rounding
  double photocurrent_A = 0;
  double resistance_series_ohm = 0;
  double conductance_shunt_S = 0;
  std::vector<FloorDiode> diodes;  // by falling n
  // The certificate at that Rs: a vector over the points, orthogonal to or pointing away from the
  // columns of light, leak and every diode at these junction voltages, save that of a light or leak
  // which an end of its range holds. Of the measured current both
  // are those of the measured points, and y proves b . y - |y|^2 / 2 <= half the sum of squares; of
  // the solved current those of the problem that is linear around the solved points.
  std::vector<double> dual_A;
  std::vector<double> junction_voltage_V;
  double duality_gap = 0;  // relative, of the sum of squares, what is left of `excess` priced
  double largest_correlation = 0;  // proved: of y with any diode column, over |y|; 0: none
  std::int64_t solved = 0;         // convex problems
};

// The same for a model with a fixed number of diodes, each with its n and Is in its ranges. Where a
// diode is so steep that the device would cut its exponent (law/term.h), the RMSE is that of Shockley's
// equation.
struct ModelCertificate {
  Model model = Model::kSingleDiode;
  std::vector<double> parameters;  // the best there is, in the device's order
  double rmse_A = 0;
  double lower_bound_A = 0;
  double gap = 0;           // (rmse - lower bound) / rmse
  double above_floor = 0;   // rmse / floor - 1; 0 where only rounding lies between them
  bool certified = false;   // the gap is at most kCertifiedGap, or rounding
  std::int64_t solved = 0;  // convex problems beyond those of the floor; 0: the floor proves it
};
// Largest (rmse - lower bound) / rmse that counts as a proof.
constexpr double kCertifiedGap = 1e-9;
constexpr double kCertifiedRounding = 1e-14;  // of the largest current: no difference of RMSEs

// How low the RMSE of a curve can go, proved.
struct Certificate {
  std::string version;
  IvCurve curve;
  CertifyOptions options;  // what was asked for
  // End of the range of Rs that is gone through: the largest forward voltage over the largest current,
  // or more where that does not do (four times as much where no end was asked for). Beyond it the points come in the wrong order of junction voltage,
  // which bounds every model at once; the lower bounds hold for the whole range asked for.
  double rs_upper_ohm = 0;
  double reference_voltage_V = 0;       // largest one at which the device delivers current
  double module_thermal_voltage_V = 0;  // Ns k T / q
  Floor floor;
  std::vector<ModelCertificate> models;
  std::vector<std::string> doubts;  // of the readings, before any fit; see CheckReadings
  std::vector<OptionEcho> non_default_options;
  double seconds = 0;
  bool interrupted = false;
};

// Proves how low the RMSE (unweighted) of a curve can go. At each Rs the measured-current problem
// over mixtures of diodes is convex: non-negative least squares over the continuum of n, whose dual
// vector proves its value (weak duality). The solved-current problem is bounded by such problems,
// linear around reference currents, less what the slopes of mixtures as good as the best one known
// can differ from the reference's. Between the Rs visited the interpolated dual vectors
// prove a lower bound, and a branch and bound over Rs closes the gap. A fixed number of diodes is
// bounded by mixtures over ever smaller windows of n, one for each diode. All bounds hold up to
// rounding of double arithmetic, some 1e-15 of the largest current; with `rigorous` without that
// reservation: the search is the same, but what it proves is evaluated in intervals. Then every
// `lower_bound_A` is at most the RMSE of any admissible model, every `rmse_A` at least that of the
// parameters beside it, and every `gap` at least what lies between them, for readings, temperature
// in kelvin and ranges as the doubles they are and for the exact quotient k / q. `certified` allows
// for rounding as without it. Errors: an unusable curve, no
// point that delivers current at a forward voltage, so few cells that every diode's exponent is
// absurd, options outside their ranges.
Expected<Certificate> Certify(const IvCurve& curve, const CertifyOptions& asked = {},
                              const Observer& observer = {});

// Cosine between the floor's dual vector and the column of a diode with each of these n at the
// floor's Rs: nowhere above zero within the range (rounding aside), zero at the diodes of the
// floor.
std::vector<double> DualCosines(const Certificate& certificate, const std::vector<double>& n);

}  // namespace lyrefit

#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/model/device.h"
#include "lyrefit/study/audit_reading.h"

namespace lyrefit {

// Some publications solve the diode equation by a single step of Newton's method from the measured
// current. They call the result of that step the calculated current. Its residual is
//
//   r = (F(V, I) - I) / (1 + Rs (dF/dVd)),   I measured, F the right-hand side
//
// It differs from the residual of the solved current in the second order of r. The least RMSE of
// the step is therefore slightly above or below the least RMSE of the solved current.

// RMSE of that Newton step in ampere. `parameters` are in the device's order. Infinite on overflow.
double NewtonStepRmse(const Device& device, const std::vector<double>& parameters,
                      const IvCurve& curve);

// The least RMSE of that Newton step that a descent from `start` finds, in ampere. Currents and
// shunt conductance are not negative, and n lies between the given bounds.
double LeastNewtonStepRmse(const Device& device, const std::vector<double>& start, double n_lower,
                           double n_upper, const IvCurve& curve);

// Bounds of the ideality factor n per cell in these fits.
constexpr double kLowestFitted = 1;
constexpr double kHighestFitted = 2;

// Finds how low claims on a curve can go. Results are cached for each curve, model and set of
// constants.
class LowestFinder {
 public:
  // The lowest RMSE of the plan's objective within physical bounds, in ampere. NaN: the fit failed.
  double Optimum(const AuditSubject& subject, const ReadingPlan& plan, ConstantSet constants);
  // Lowest RMSE and its proved lower bound for the unchanged curve. The lowest RMSEs of the other
  // objective and of one Newton step are included, since the claim may be one of them. Empty: the
  // fit failed.
  std::optional<AuditLowest> Find(const AuditSubject& subject, ConstantSet constants);

 private:
  struct Fitted {
    double rmse_A = 0;
    std::vector<double> parameters;
  };
  const Fitted& Fit(const AuditSubject& subject, const ReadingPlan& plan, ConstantSet constants);

  std::map<std::string, Fitted> fitted_;
  std::map<std::string, AuditLowest> lowest_;
};

// The lowest RMSE that is reached by known parameters, in ampere.
double LowestFound(const AuditLowest& lowest);

// True if a claim lies below `rmse_A` by more than a whole unit of the claim's last digit. False if
// `rmse_A` is unknown (NaN).
bool IsBelow(const PrintedNumber& claim, double rmse_A);

// True if a claim is `value`, rounded or truncated to the printed digits.
bool IsPrintOf(const PrintedNumber& claim, double value);

}  // namespace lyrefit

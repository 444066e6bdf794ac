#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/study/audit_reading.h"

namespace lyrefit {

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

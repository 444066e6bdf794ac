#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/study/audit_reading.h"

namespace lyrefit {

// Where fits look, per cell.
constexpr double kLowestFitted = 1;
constexpr double kHighestFitted = 2;

// How low claims on a curve can go; every curve, model and set of constants is looked at once.
class LowestFinder {
 public:
  // The lowest RMSE of the plan's objective within physical bounds; NaN if there is no fit.
  double Optimum(const AuditSubject& subject, const ReadingPlan& plan, ConstantSet constants);
  // That of the curve as it is, and what else the claim may be the least of. Nothing if there is no
  // fit.
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

// The lowest RMSE that parameters were found for.
double LowestFound(const AuditLowest& lowest);

// Whether a claim lies below an RMSE: its rounding would have to be wrong by more than a whole unit
// of its last digit. Never below one that is not known.
bool IsBelow(const PrintedNumber& claim, double rmse_A);

// Whether a claim is this number, rounded or cut off.
bool IsPrintOf(const PrintedNumber& claim, double value);

}  // namespace lyrefit

#pragma once

#include <string>
#include <vector>

#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/family/family_options.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/family/joint.h"

namespace lyrefit {

// Selects `count` of the curves `among` (positions in `conditions`), well spread over the logarithm
// of irradiance and over temperature. The first is nearest to 1000 W/m2 and 25 C; each further one
// is the farthest from all selected so far (doi:10.1016/0304-3975(85)90224-5). Returns positions in
// rising order, or all of `among` if it has no more than `count`.
std::vector<int> CurveSubset(const std::vector<Conditions>& conditions,
                             const std::vector<int>& among, int count);

// Role and data of one curve in a family fit.
struct FamilyMember {
  CurveRole role = CurveRole::kFitted;
  std::string reason;
  JointCurve joint;  // conditions as stated, or guessed if not stated
  double short_circuit_current_A = kUnknown;
  bool irradiance_known = true;
  bool temperature_known = true;
  bool IsDark() const { return joint.irradiance_W_m2 <= 0; }
};

struct FamilyMembers {
  std::vector<FamilyMember> members;  // one for each curve of the set
  std::vector<int> fitted;            // positions in the set
  std::vector<int> held_out;
  double reference_current_A = 0;  // Isc at 1000 W/m2, estimated from the curves
  bool key_points = false;         // the residuals are those of key points
  bool stated_errors = false;      // every curve states sigma_A, which sets the weights
  std::vector<std::string> notes;  // assumptions that had to be made
};

// Conditions of every curve, as stated or, if not stated, as guessed.
std::vector<Conditions> ConditionsOf(const FamilyMembers& members);

// Sets the weights of all points. kAuto sets equal weights until SettleWeights selects them.
void WeighMembers(FamilyWeights weights, FamilyMembers* members);

// Selects the curves of a family fit. Errors: fewer than two light curves (with effects, dark
// curves count if there is a light one); duplicate ids, or ids to leave out that the set lacks;
// unusable curves.
Expected<FamilyMembers> MakeFamilyMembers(const CurveSet& set, const FamilyOptions& options);

}  // namespace lyrefit

#pragma once

#include <string>
#include <vector>

#include "lyrefit/family/family_options.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/refine/joint.h"

namespace lyrefit {

// What a curve is to a family fit.
struct FamilyMember {
  CurveRole role = CurveRole::kFitted;
  std::string reason;
  JointCurve joint;  // with the conditions as stated, or guessed where nobody stated them
  double short_circuit_current_A = kUnknown;
  bool irradiance_known = true;
  bool temperature_known = true;
  bool IsDark() const { return joint.irradiance_W_m2 <= 0; }
};

struct FamilyMembers {
  std::vector<FamilyMember> members;  // one for each curve of the set
  std::vector<int> fitted;            // positions in the set
  std::vector<int> held_out;
  double reference_current_A = 0;  // Isc at 1000 W/m2, from the data
  bool stated_errors = false;      // every curve states sigma_A, which decides the weights
  std::vector<std::string> notes;  // what had to be assumed
};

// Of every curve: as stated, or guessed where nobody stated them.
std::vector<Conditions> ConditionsOf(const FamilyMembers& members);

// The weights of all points; kAuto: equal ones, until residuals decide (SettleWeights).
void WeighMembers(FamilyWeights weights, FamilyMembers* members);

// Errors: fewer than two light curves (with effects dark ones count, beside a light one), ids that
// occur twice or not at all, unusable curves.
Expected<FamilyMembers> MakeFamilyMembers(const CurveSet& set, const FamilyOptions& options);

}  // namespace lyrefit

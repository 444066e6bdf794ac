#include "faults/score.h"

#include <algorithm>
#include <map>

namespace faults {
namespace {

bool Holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Factor from `unit` to the unit `plain`; 0 if the dimensions differ.
double FactorTo(const std::string& plain, const std::string& unit) {
  if (unit == plain || (plain == "1" && unit.empty())) return 1;
  if (plain == "1") return unit == "%" ? 0.01 : 0;
  static const std::map<std::string, std::string> kOther = {
      {"K", "K/sun"}, {"S", "S/sun"}, {"W/m2", "W/m^2"}};
  const auto other = kOther.find(plain);
  if (other != kOther.end() && unit == other->second) return 1;
  if (plain == "K" && unit == "K/(kW/m^2)") return 1;
  if (plain == "1/K") return unit == "%/K" ? 0.01 : 0;
  if (unit.size() > plain.size() && unit.substr(unit.size() - plain.size()) == plain) {
    const std::string prefix = unit.substr(0, unit.size() - plain.size());
    static const std::map<std::string, double> kPrefixes = {
        {"m", 1e-3}, {"u", 1e-6}, {"n", 1e-9}, {"p", 1e-12}, {"k", 1e3}};
    const auto found = kPrefixes.find(prefix);
    if (found != kPrefixes.end()) return found->second;
  }
  return 0;
}

}  // namespace

std::vector<Claim> Counted(const Case& made, const Answer& answer) {
  std::vector<Claim> claims;
  for (const Claim& claim : answer.claims) {
    if (!(made.second_diode && claim.id == "second_diode")) claims.push_back(claim);
  }
  return claims;
}

bool Names(const Claim& claim, const Cause& cause) {
  if (Holds(cause.acceptable, claim.id)) return true;
  if (!Holds(claim.equivalents, cause.name)) return false;
  int strangers = 1;  // the first name
  for (const std::string& name : claim.equivalents) strangers += !Holds(cause.acceptable, name);
  return strangers <= 2;
}

CaseScore ScoreCase(const Case& made, const Answer& answer, std::size_t which) {
  CaseScore score;
  const std::vector<Claim> claims = Counted(made, answer);
  if (claims.empty()) return score;
  const Claim& first = claims.front();
  score.detected = true;
  score.first = first.id;
  score.set_size = 1 + static_cast<int>(first.equivalents.size());
  if (which >= made.causes.size()) return score;
  const Cause& cause = made.causes[which];
  score.first_right = Holds(cause.acceptable, first.id);
  score.in_set = first.id == cause.name || Holds(first.equivalents, cause.name);
  score.named = std::any_of(claims.begin(), claims.end(),
                            [&](const Claim& claim) { return Names(claim, cause); });
  return score;
}

std::optional<Sized> SizeOf(const Cause& cause, const Answer& answer) {
  if (cause.size.unit == nullptr) return std::nullopt;
  for (const Claim& claim : answer.claims) {
    if (claim.id != cause.name || claim.strengths.empty()) continue;
    const Strength& strength = claim.strengths.front();
    const double factor = FactorTo(cause.size.unit, strength.unit);
    if (factor == 0) return std::nullopt;
    return Sized{factor * strength.value, factor * strength.low, factor * strength.high};
  }
  return std::nullopt;
}

}  // namespace faults

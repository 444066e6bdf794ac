#include "faults/field_score.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace faults::field {
namespace {

// Assigns a quantity to a parameter of a claim by a substring of its name; the first match counts.
struct Meaning {
  const char* part;
  const char* quantity;
  bool missing;  // the parameter is 1 - quantity
};
constexpr Meaning kMeanings[] = {
    {"deficit", "light", true},          {"shading_depth", "light", true},
    {"light", "light", false},           {"share", "share", false},
    {"width", "width", false},           {"spread", "width", false},
    {"relative_step", "step", false},    {"depth", "dip", false},
    {"relative_change", "drift", false}, {"relative_gain", "gain", false}};

struct Said {
  const char* quantity;
  std::string group;  // digits of the parameter name, which distinguish the groups
  double value, low, high;
};

std::string Digits(const std::string& name) {
  std::string digits;
  for (const char letter : name) {
    if (std::isdigit(static_cast<unsigned char>(letter))) digits += letter;
  }
  return digits;
}

std::vector<Said> SaidBy(const Claim& claim) {
  std::vector<Said> said;
  for (const Strength& strength : claim.strengths) {
    const double unit = strength.unit == "%" ? 0.01 : 1;
    for (const Meaning& meaning : kMeanings) {
      if (strength.name.find(meaning.part) == std::string::npos) continue;
      Said one{meaning.quantity, Digits(strength.name), unit * strength.value, unit * strength.low,
               unit * strength.high};
      if (meaning.missing) {
        one = {one.quantity, one.group, 1 - one.value, 1 - one.high, 1 - one.low};
      }
      said.push_back(one);
      break;
    }
  }
  const std::vector<Said> all = said;
  const auto absent = [&](const Said& one) {  // a group without cells
    return std::any_of(all.begin(), all.end(), [&](const Said& other) {
      return other.group == one.group && other.quantity == std::string("share") && other.value <= 0;
    });
  };
  said.erase(std::remove_if(said.begin(), said.end(), absent), said.end());
  return said;
}

const Said* Nearest(const std::vector<Said>& said, const std::string& quantity, double truth) {
  const Said* nearest = nullptr;
  for (const Said& one : said) {
    if (one.quantity != quantity) continue;
    if (nearest && std::fabs(one.value - truth) >= std::fabs(nearest->value - truth)) continue;
    nearest = &one;
  }
  return nearest;
}

std::vector<Compared> Compare(const Truth& truth, const Claim& claim) {
  const std::vector<Said> said = SaidBy(claim);
  std::vector<Compared> compared;
  for (const Figure& figure : truth.figures) {
    const Said* nearest = Nearest(said, figure.quantity, figure.value);
    if (nearest == nullptr) continue;
    const bool interval = nearest->high > nearest->low;
    const bool holds = interval && nearest->low <= figure.value && figure.value <= nearest->high;
    compared.push_back({figure.quantity, figure.value, nearest->value, interval, holds});
  }
  return compared;
}

bool Counts(const Case& made, const Claim& claim) {
  if (claim.id == "quantisation" || claim.id == "outliers") return false;
  return !(made.kind == "clean_dd" && claim.id == "second_diode");
}

}  // namespace

CaseScore ScoreCase(const Case& made, const Answer& answer) {
  CaseScore score;
  const auto is_accepted = [&](const std::string& id) {
    const auto& accepted = made.truth.accepted;
    return std::find(accepted.begin(), accepted.end(), id) != accepted.end();
  };
  for (const Claim& claim : answer.claims) {
    if (!Counts(made, claim)) continue;
    const bool right = is_accepted(claim.id);
    if (score.claims++ == 0) {
      score.first = claim.id;
      score.first_right = right;
    }
    const bool in_set =
        !right && std::any_of(claim.beside.begin(), claim.beside.end(), is_accepted);
    score.in_set += in_set;
    score.spurious += !right && !in_set;
    if (right && !score.any_right) score.compared = Compare(made.truth, claim);
    score.any_right |= right;
  }
  score.named = score.claims > 0;
  const Recoverable& said = answer.recoverable;
  if (score.first_right && std::isfinite(said.low)) {
    const bool least = !std::isfinite(said.value);
    const double lost = made.truth.lost_W, whole = made.truth.power_W;
    const bool holds = said.low <= lost && (least || lost <= said.high);
    score.compared.push_back({least ? "least power" : "power", lost / whole,
                              (least ? said.low : said.value) / whole, true, holds});
  }
  return score;
}

}  // namespace faults::field

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "lyrefit/base/distributions.h"
#include "plant/campaign.h"

namespace lyrefit {
namespace {

constexpr double kTestedFigures = 4;  // Isc, Voc, FF, Pmax
constexpr double kSides = 2;
// What less light alone does at standard conditions that are reached with a wrong irradiance, per
// ln(Isc): Voc falls by n k T / q of about 0.9 V of 40 V and less, FF rises by the part of the
// power that the series resistance takes.
constexpr double kVocPerLight = 0.045;
constexpr double kFillPerLight = -0.06;
// Change of ln(Voc) that a wrong temperature may look like: 6 K. More is missing or added cells.
constexpr double kVocByTemperature = 0.018;
// A loss of FF is by resistance if less than this part of it is in Imp / Isc: added resistance
// moves Vmp, added shunt conductance and mismatch of currents move Imp.
constexpr double kCurrentPart = 0.5;
constexpr const char kResistanceCause[] = "series_resistance";

// Half-widths of intervals of a string's own changes.
struct Halves {
  Halves(const CampaignChange& change, double t95, double t_level) {
    for (int q = 0; q < kCampaignRatios; ++q) {
      half[q] = t95 * change.sigma[q];
      limit[q] = t_level * change.sigma[q];
    }
  }
  std::array<double, kCampaignRatios> half{};   // 95 %
  std::array<double, kCampaignRatios> limit{};  // of what is usual
};

// Sets the numbers of substrings that the change of Voc may mean. False: none, or a wrong
// temperature may be the cause too.
bool FindSteps(double voc, double half, int substrings, CampaignChange* change) {
  if (substrings < 2 || std::fabs(voc) - half < kVocByTemperature) return false;
  const double most = substrings * (1 - std::exp(voc - half));
  const double least = substrings * (1 - std::exp(voc + half));
  change->steps_low = static_cast<std::int32_t>(std::ceil(least));
  change->steps_high = static_cast<std::int32_t>(std::floor(most));
  if (change->steps_low <= change->steps_high) return true;
  change->steps_low = change->steps_high = 0;
  return false;
}

CampaignKind FillFactorKind(const CampaignChange& change, const Halves& of, bool new_cause,
                            const std::string& cause) {
  if (new_cause) {
    return cause == kResistanceCause ? CampaignKind::kSeriesResistance
                                     : CampaignKind::kShuntOrMismatch;
  }
  const double fill = change.own[kCFillFactor];
  if (std::fabs(fill) < of.half[kCFillFactor]) return CampaignKind::kFillFactor;
  const double part = change.own[kImpPerIsc] / fill;
  const double half = of.half[kImpPerIsc] / std::fabs(fill);
  if (part + half < kCurrentPart) return CampaignKind::kSeriesResistance;
  if (part - half > kCurrentPart) return CampaignKind::kShuntOrMismatch;
  return CampaignKind::kFillFactor;
}

CampaignKind KindOf(const CampaignString& before, const CampaignString& after, const Halves& of,
                    CampaignChange* change) {
  const auto& own = change->own;
  const auto beyond = [&](int q, double value) { return std::fabs(value) > of.limit[q]; };
  const bool isc = beyond(kCIsc, own[kCIsc]);
  const double light = isc ? own[kCIsc] : 0;
  const double voc_left = own[kCVoc] - kVocPerLight * light;
  const double fill_left = own[kCFillFactor] - kFillPerLight * light;
  const bool voc = beyond(kCVoc, own[kCVoc]) && beyond(kCVoc, voc_left);
  change->adjusted = !isc && !beyond(kCVoc, own[kCVoc]);
  const bool fill =
      change->adjusted ? beyond(kAdjustedFill, own[kAdjustedFill])
                       : beyond(kCFillFactor, own[kCFillFactor]) && beyond(kCFillFactor, fill_left);
  if (!isc && !voc && !fill && !beyond(kCPmax, own[kCPmax])) return CampaignKind::kNone;
  if (before.repeat || after.repeat) return CampaignKind::kMeasurement;
  const bool new_cause = !after.cause.empty() && after.cause != before.cause;
  const bool steps = voc && FindSteps(voc_left, of.half[kCVoc], after.bypass_diodes, change);
  if (steps && !isc && !fill) return CampaignKind::kSubstrings;
  if (isc && !voc && !fill) return CampaignKind::kLight;
  const bool mostly_fill = !voc || std::fabs(own[kCVoc]) < 0.5 * std::fabs(own[kCFillFactor]);
  if (fill && !isc && mostly_fill) return FillFactorKind(*change, of, new_cause, after.cause);
  if (voc && !isc && !fill) return CampaignKind::kVoltage;
  return voc || fill ? CampaignKind::kSeveral : CampaignKind::kPower;
}

// Power lost by the figures that changed; by Pmax if none did. Voc and FF within what is usual count
// as unchanged, give or take this part of their intervals.
constexpr double kUnchangedPart = 0.5;

void SetLost(const CampaignString& before, const Halves& of, CampaignChange* change) {
  double own = 0, squares = 0;
  bool changed = false;
  const int fill = change->adjusted ? int{kAdjustedFill} : int{kCFillFactor};
  for (const int q : {int{kCIsc}, int{kCVoc}, fill}) {
    if (std::fabs(change->own[q]) > of.limit[q]) {
      changed = true;
      own += change->own[q];
      squares += of.half[q] * of.half[q];
    } else if (q != kCIsc) {
      squares += std::pow(kUnchangedPart * of.half[q], 2);
    }
  }
  if (!changed) {
    own = change->own[kCPmax];
    squares = of.half[kCPmax] * of.half[kCPmax];
  }
  const double power_W = before.values[kCPmax], half = std::sqrt(squares);
  change->lost_W = power_W * -std::expm1(own);
  change->lost_low_W = power_W * -std::expm1(own + half);
  change->lost_high_W = power_W * -std::expm1(own - half);
}

bool IsNamed(CampaignKind kind) {
  return kind != CampaignKind::kNotCompared && kind != CampaignKind::kNone &&
         kind != CampaignKind::kNew && kind != CampaignKind::kRenamed;
}

void SetRanks(const std::vector<CampaignString>& after, Campaign* campaign) {
  std::vector<std::int32_t> named;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (IsNamed(campaign->changes[i].kind)) named.push_back(static_cast<std::int32_t>(i));
  }
  std::sort(named.begin(), named.end(), [&](std::int32_t one, std::int32_t other) {
    const double a = campaign->changes[one].lost_W, b = campaign->changes[other].lost_W;
    return a != b ? a > b : after[one].id < after[other].id;
  });
  for (std::size_t k = 0; k < named.size(); ++k) {
    campaign->changes[named[k]].rank = static_cast<std::int32_t>(k) + 1;
  }
}

}  // namespace

void DecideKinds(const std::vector<CampaignString>& before,
                 const std::vector<CampaignString>& after, std::size_t compared,
                 Campaign* campaign) {
  const double tail =
      campaign->level / (kSides * kTestedFigures * std::max(static_cast<double>(compared), 1.0));
  double degrees = 0, t95 = 0, t_level = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    CampaignChange& change = campaign->changes[i];
    if (change.before < 0 || !change.why_not.empty()) continue;
    if (change.degrees != degrees) {
      degrees = change.degrees;
      t95 = StudentQuantile(0.975, degrees);
      t_level = StudentQuantile(1 - tail, degrees);
    }
    change.t95 = t95;
    const Halves of(change, t95, t_level);
    change.kind = KindOf(before[change.before], after[i], of, &change);
    SetLost(before[change.before], of, &change);
  }
  FindExchanged(before, after, campaign);
  SetRanks(after, campaign);
}

}  // namespace lyrefit

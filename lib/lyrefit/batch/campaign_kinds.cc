#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "lyrefit/base/distributions.h"
#include "lyrefit/batch/campaign.h"

namespace lyrefit {
namespace {

constexpr double kTestedFigures = 4;  // Isc, Voc, FF, Pmax
constexpr double kSides = 2;
// What less light alone does at standard conditions that are reached with a wrong irradiance, per
// ln(Isc): Voc falls by n k T / q of about 0.9 V of 40 V and less, FF rises by the part of the
// power that the series resistance takes.
constexpr double kVocPerLight = 0.045;
constexpr double kFillPerLight = -0.06;
// A step of Voc is one of k substrings if its 95 % interval is narrower than this part of a
// substring.
constexpr double kNarrowStep = 0.45;
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

// Number of substrings that the change of Voc means; 0: none that the data decide.
int StepsOf(double voc, double half, int substrings) {
  if (substrings < 2) return 0;
  const double part = 1 - std::exp(voc);
  const double one = 1.0 / substrings;
  const double steps = std::round(part / one);
  if (steps == 0 || half > kNarrowStep * one) return 0;
  return std::fabs(part - steps * one) <= half ? static_cast<int>(steps) : 0;
}

CampaignKind FillFactorKind(const CampaignChange& change, const Halves& of, bool new_cause,
                            const std::string& cause) {
  if (new_cause) {
    return cause == kResistanceCause ? CampaignKind::kSeriesResistance
                                     : CampaignKind::kShuntOrMismatch;
  }
  const double fill = change.own[kCFillFactor];
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
  const bool fill = beyond(kCFillFactor, own[kCFillFactor]) && beyond(kCFillFactor, fill_left);
  if (!isc && !voc && !fill && !beyond(kCPmax, own[kCPmax])) return CampaignKind::kNone;
  if (before.repeat || after.repeat) return CampaignKind::kMeasurement;
  const bool new_cause = !after.cause.empty() && after.cause != before.cause;
  change->steps = voc ? StepsOf(voc_left, of.half[kCVoc], after.bypass_diodes) : 0;
  if (change->steps != 0 && !isc && !fill) return CampaignKind::kSubstrings;
  if (isc && !voc && !fill) return CampaignKind::kLight;
  const bool mostly_fill = !voc || std::fabs(own[kCVoc]) < 0.5 * std::fabs(own[kCFillFactor]);
  if (fill && !isc && mostly_fill) return FillFactorKind(*change, of, new_cause, after.cause);
  if (voc && !isc && !fill) return CampaignKind::kVoltage;
  return voc || fill ? CampaignKind::kSeveral : CampaignKind::kPower;
}

// Power lost, from Pmax / Isc where the current did not change.
void SetLost(const CampaignString& before, const Halves& of, CampaignChange* change) {
  const double power_W = before.values[kCPmax];
  const bool current = change->kind == CampaignKind::kNone ||
                       change->kind == CampaignKind::kPower ||
                       std::fabs(change->own[kCIsc]) > of.limit[kCIsc];
  const int q = current ? int{kCPmax} : int{kPmaxPerIsc};
  const double own = change->own[q], half = of.half[q];
  change->lost_W = power_W * (1 - std::exp(own));
  change->lost_low_W = power_W * (1 - std::exp(own + half));
  change->lost_high_W = power_W * (1 - std::exp(own - half));
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
    const Halves of(change, t95, t_level);
    change.kind = KindOf(before[change.before], after[i], of, &change);
    SetLost(before[change.before], of, &change);
  }
  FindExchanged(before, after, campaign);
  SetRanks(after, campaign);
}

}  // namespace lyrefit

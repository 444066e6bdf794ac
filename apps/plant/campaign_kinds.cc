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
// What no mechanism explains better than this is several at once, or another.
constexpr double kLeastGoodness = 1e-6;

// Half-widths of intervals of a string's own changes.
struct Halves {
  Halves(const CampaignChange& change, double t95, double t_level) {
    for (int q = 0; q < kCampaignRatios; ++q) {
      half[q] = t95 * change.sigma[q];
      limit[q] = t_level * change.sigma[q];
    }
  }
  bool Beyond(int q, double value) const { return std::fabs(value) > limit[q]; }

  std::array<double, kCampaignRatios> half{};   // 95 %
  std::array<double, kCampaignRatios> limit{};  // of what is usual
};

// Whether any figure changed by more than is usual, and than less light explains.
bool HasChanged(const Halves& of, CampaignChange* change) {
  const auto& own = change->own;
  const bool isc = of.Beyond(kCIsc, own[kCIsc]);
  const double light = isc ? own[kCIsc] : 0;
  const double voc_left = own[kCVoc] - kVocPerLight * light;
  const double fill_left = own[kCFillFactor] - kFillPerLight * light;
  const bool voc = of.Beyond(kCVoc, own[kCVoc]) && of.Beyond(kCVoc, voc_left);
  change->adjusted = !isc && !of.Beyond(kCVoc, own[kCVoc]);
  const bool fill = change->adjusted ? of.Beyond(kAdjustedFill, own[kAdjustedFill])
                                     : of.Beyond(kCFillFactor, own[kCFillFactor]) &&
                                           of.Beyond(kCFillFactor, fill_left);
  return isc || voc || fill || of.Beyond(kCPmax, own[kCPmax]);
}

// The change that power is judged by: of Pmax, or of Pmax / Isc where that of Isc is an error of
// light. A series resistance changes nothing but the fill factor.
int PowerOf(const CampaignChange& change, const Halves& of) {
  if (change.kind == CampaignKind::kLight || change.kind == CampaignKind::kOtherModules) {
    return kCPmax;
  }
  if (change.kind == CampaignKind::kSeriesResistance) {
    return change.adjusted ? int{kAdjustedFill} : int{kCFillFactor};
  }
  return of.Beyond(kCIsc, change.own[kCIsc]) ? int{kCPmax} : int{kPmaxPerIsc};
}

// What all sweeps share, taken off the earlier one.
SweepFigures WithCommon(SweepFigures sweep, const CampaignChange& change) {
  sweep.log_isc += change.common[kCIsc];
  sweep.log_voc += change.common[kCVoc];
  sweep.imp_per_isc *= std::exp(change.common[kImpPerIsc]);
  sweep.vmp_per_voc *= std::exp(change.common[kVmpPerVoc]);
  for (std::size_t k = 0; k < sweep.currents.size(); ++k) {
    sweep.currents[k] += change.common[kCurrents + k];
  }
  return sweep;
}

// Finds what makes the later sweep of the earlier one, or the reverse.
void FindMechanisms(const CampaignString& before, const CampaignString& after, bool shapes,
                    const Halves& of, CampaignChange* change) {
  SweepFigures earlier = WithCommon(SweepOf(before), *change), later = SweepOf(after);
  if (!shapes) earlier.currents.clear(), later.currents.clear();
  SweepScatter scatter = {change->sigma[kCIsc], change->sigma[kCVoc], change->sigma[kCFillFactor],
                          change->sigma[kImpPerIsc], change->sigma[kVmpPerVoc]};
  for (int k = 0; k < kSparklinePoints; ++k) scatter.currents[k] = change->sigma[kCurrents + k];
  const StringFacts facts = {after.bypass_diodes, before.values[kCVoc]};
  // Power tells losses and gains apart where it can, else the better fit.
  const int q = PowerOf(*change, of);
  const double power = std::fabs(change->own[q]) > of.half[q] ? change->own[q] : 0;
  std::vector<MechanismFit> losses, gains;
  if (power <= 0) losses = FitMechanisms(earlier, later, scatter, facts);
  if (power >= 0) gains = FitMechanisms(later, earlier, scatter, facts);
  change->gain = losses.empty() || (!gains.empty() && gains.front().misfit < losses.front().misfit);
  change->fits = std::move(change->gain ? gains : losses);
}

// The kind of the mechanisms that are likely: of one, or of a set that has a name.
CampaignKind KindOf(const CampaignChange& change) {
  std::array<double, kMechanisms> of{};
  for (const MechanismFit& fit : change.fits) of[static_cast<int>(fit.mechanism)] = fit.probability;
  const auto at = [&](Mechanism one) { return of[static_cast<int>(one)]; };
  const MechanismFit& first = change.fits.front();
  if (first.goodness < kLeastGoodness) return CampaignKind::kSeveral;
  if (first.probability >= kSureOfMechanism) return KindOf(first.mechanism);
  if (at(Mechanism::kSubstrings) + at(Mechanism::kTemperature) >= kSureOfMechanism) {
    return CampaignKind::kVoltage;
  }
  const double leaks = at(Mechanism::kShunt) + at(Mechanism::kMismatch);
  if (leaks >= kSureOfMechanism) return CampaignKind::kShuntOrMismatch;
  return leaks + at(Mechanism::kSeriesResistance) >= kSureOfMechanism ? CampaignKind::kFillFactor
                                                                      : CampaignKind::kSeveral;
}

// How much more, or less, a mechanism costs at standard conditions than at those of a sweep: between
// two factors. A series resistance takes I Rs of Vmp. A leak takes a current in proportion to the
// voltage, or, where cells break through, to a high power of it.
struct Factors {
  double low = 1, high = 1;
};
Factors AtStandardConditions(Mechanism mechanism, const CampaignString& sweep) {
  constexpr double kVmpPerK = -0.0042;
  constexpr double kSteepestLeak = 4;
  if (!(sweep.irradiance_W_m2 > 0)) return {};
  const double light = sweep.irradiance_W_m2 / 1000;
  const double warmer = std::isfinite(sweep.temperature_C) ? sweep.temperature_C - 25.0 : 0;
  const double vmp = 1 + kVmpPerK * warmer;  // of that at 25 C
  if (mechanism == Mechanism::kSeriesResistance) return {vmp / light, vmp / light};
  if (mechanism != Mechanism::kShunt) return {};
  const double ohmic = light / vmp, steepest = light * std::pow(vmp, -kSteepestLeak);
  return {std::min(ohmic, steepest), std::max(ohmic, steepest)};
}

void SetLost(const CampaignString& before, const CampaignString& after, const Halves& of,
             CampaignChange* change) {
  const int q = change->fits.empty() ? int{kCPmax} : PowerOf(*change, of);
  const Factors at = change->fits.empty() ? Factors()
                                          : AtStandardConditions(change->fits.front().mechanism,
                                                                 change->gain ? before : after);
  const double measured = change->kind == CampaignKind::kTemperature ? 0 : change->own[q];
  const double own = 0.5 * (at.low + at.high) * measured;
  // The common change is a median, of which the variance is pi / 2 of that of a mean.
  constexpr double kOfMedian = 1.5708;
  // What a resistance takes is known to a fifth: its place and the light at it are not.
  constexpr double kOfResistance = 0.2;
  const double of_size =
      change->kind == CampaignKind::kSeriesResistance ? kOfResistance : 0.5 * (at.high - at.low);
  const double half =
      of.half[q] * std::sqrt(1 + (change->peers > 0 ? kOfMedian / change->peers : 0)) +
      of_size * std::fabs(measured);
  const double power_W = before.values[kCPmax];
  const auto lost = [&](double change_of_log) { return 0 - power_W * std::expm1(change_of_log); };
  change->lost_W = lost(own);
  change->lost_low_W = lost(own + half);
  change->lost_high_W = lost(own - half);
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

CampaignKind KindOf(Mechanism mechanism) {
  switch (mechanism) {
    case Mechanism::kLight:
      return CampaignKind::kLight;
    case Mechanism::kSubstrings:
      return CampaignKind::kSubstrings;
    case Mechanism::kTemperature:
      return CampaignKind::kTemperature;
    case Mechanism::kSeriesResistance:
      return CampaignKind::kSeriesResistance;
    case Mechanism::kShunt:
      return CampaignKind::kShunt;
    case Mechanism::kMismatch:
      return CampaignKind::kMismatch;
    case Mechanism::kOtherModules:
      break;
  }
  return CampaignKind::kOtherModules;
}

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
    const CampaignString& earlier = before[change.before];
    if (!HasChanged(of, &change)) {
      change.kind = CampaignKind::kNone;
    } else if (earlier.repeat || after[i].repeat) {
      change.kind = CampaignKind::kMeasurement;
    } else {
      FindMechanisms(earlier, after[i], campaign->shapes, of, &change);
      change.kind = change.fits.empty() ? CampaignKind::kNone : KindOf(change);
    }
    SetLost(earlier, after[i], of, &change);
  }
  FindExchanged(before, after, campaign);
  SetRanks(after, campaign);
}

}  // namespace lyrefit

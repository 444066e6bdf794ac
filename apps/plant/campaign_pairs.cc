#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/distributions.h"
#include "lyrefit/batch/addition.h"
#include "plant/campaign.h"

namespace lyrefit {
namespace {

// Figures that belong to a string, in the order of CampaignRatio, without the light of its place.
constexpr int kProfile[] = {kCIsc, kCVoc, kCFillFactor, kVmpPerVoc};
constexpr double kProfileSize = 4;
// Two strings differ by the errors of two places, one string by those of one.
constexpr double kWiderAcross = 1.3;
// Tail probability of chi-squared below which two profiles are not of one string.
constexpr double kLeastFit = 0.05;
// A second partner that fits nearly as well leaves the pair undecided: the difference of
// chi-squared, a ratio of likelihoods of 150.
constexpr double kApart = 10;
// More changed strings are not paired.
constexpr std::size_t kMostPaired = 5000;

double LogOf(const CampaignString& string, int q) {
  if (q == kVmpPerVoc) return std::log(double{string.values[kCVmp]} / string.values[kCVoc]);
  return std::log(double{string.values[q]});
}

// Chi-squared of the hypothesis that `later` is the string that was measured as `earlier`.
// `common` and `sigma`: of their places.
struct Place {
  std::array<double, kCampaignRatios> common{}, sigma{};
};

double Misfit(const CampaignString& earlier, const CampaignString& later, const Place& at) {
  double sum = 0;
  for (const int q : kProfile) {
    const double change = LogOf(later, q) - LogOf(earlier, q) - at.common[q];
    const double z = change / at.sigma[q];
    sum += z * z;
  }
  return sum;
}

Place BetweenOf(const CampaignChange& one, const CampaignChange& other, double wider) {
  Place place;
  for (int q = 0; q < kCampaignRatios; ++q) {
    place.common[q] = 0.5 * (one.common[q] + other.common[q]);
    place.sigma[q] = wider * std::max(one.sigma[q], other.sigma[q]);
  }
  return place;
}

constexpr std::size_t kMostPartners = 3;

// Partners of a string that fit, with chi-squared of the pair; the best first.
using Partners = std::vector<std::pair<double, std::int32_t>>;

// Those that fit about as well as the best.
std::vector<std::int32_t> LikelyOf(Partners partners) {
  std::sort(partners.begin(), partners.end());
  std::vector<std::int32_t> likely;
  for (const auto& [misfit, other] : partners) {
    if (misfit - partners.front().first <= kApart) likely.push_back(other);
  }
  return likely;
}

// One mechanism explains the change.
bool HasName(const CampaignChange& change) {
  switch (change.kind) {
    case CampaignKind::kSeveral:
    case CampaignKind::kFillFactor:
    case CampaignKind::kOtherModules:
      return false;
    default:
      return true;
  }
}

// Strings that differ from their own past in more than the light of their place.
bool MayBeExchanged(const CampaignChange& change) {
  switch (change.kind) {
    case CampaignKind::kSubstrings:
    case CampaignKind::kVoltage:
    case CampaignKind::kSeriesResistance:
    case CampaignKind::kShunt:
    case CampaignKind::kMismatch:
    case CampaignKind::kShuntOrMismatch:
    case CampaignKind::kFillFactor:
    case CampaignKind::kSeveral:
      return true;
    default:
      return false;
  }
}

void FindRenamed(const std::vector<CampaignString>& before,
                 const std::vector<CampaignString>& after, Campaign* campaign) {
  std::map<std::string, std::vector<std::int32_t>> gone, fresh;
  for (const std::int32_t k : campaign->gone) gone[ParentOf(before[k].id)].push_back(k);
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (campaign->changes[i].kind != CampaignKind::kNew) continue;
    fresh[ParentOf(after[i].id)].push_back(static_cast<std::int32_t>(i));
  }
  // A string of the same group gives what is common and what is usual there.
  std::map<std::string, std::int32_t> like;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (campaign->changes[i].degrees > 0) {
      like.emplace(ParentOf(after[i].id), static_cast<std::int32_t>(i));
    }
  }
  for (const auto& [group, ids] : fresh) {
    const auto left = gone.find(group);
    const auto other = like.find(group);
    if (ids.size() != 1 || left == gone.end() || left->second.size() != 1) continue;
    if (other == like.end()) continue;
    CampaignChange& change = campaign->changes[ids.front()];
    const CampaignChange& usual = campaign->changes[other->second];
    const double misfit =
        Misfit(before[left->second.front()], after[ids.front()], BetweenOf(usual, usual, 1));
    if (!std::isfinite(misfit)) continue;  // a sweep without figures
    if (!(ChiSquaredTail(misfit, kProfileSize) > kLeastFit)) continue;
    change.kind = CampaignKind::kRenamed;
    change.partner = left->second.front();
  }
}

}  // namespace

void FindExchanged(const std::vector<CampaignString>& before,
                   const std::vector<CampaignString>& after, Campaign* campaign) {
  auto& changes = campaign->changes;
  FindRenamed(before, after, campaign);
  std::vector<std::int32_t> changed;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (MayBeExchanged(changes[i])) changed.push_back(static_cast<std::int32_t>(i));
  }
  if (changed.size() < 2 || changed.size() > kMostPaired) return;
  const auto count = static_cast<double>(changed.size());
  const double pairs = count * (count - 1) / 2;
  // The swap has to be better than two changes by the factor pairs / level in likelihood.
  const double least_gain = 2 * std::log(pairs / campaign->level) + kApart;
  std::map<std::int32_t, Partners> partners;
  for (std::size_t a = 0; a < changed.size(); ++a) {
    for (std::size_t b = a + 1; b < changed.size(); ++b) {
      const std::int32_t i = changed[a], j = changed[b];
      if (ParentOf(after[i].id) != ParentOf(after[j].id)) continue;  // cables end in one combiner
      const Place at = BetweenOf(changes[i], changes[j], kWiderAcross);
      const double crossed = Misfit(before[changes[j].before], after[i], at) +
                             Misfit(before[changes[i].before], after[j], at);
      const double kept = Misfit(before[changes[i].before], after[i], at) +
                          Misfit(before[changes[j].before], after[j], at);
      if (kept - crossed < least_gain) continue;
      if (!(ChiSquaredTail(crossed, 2 * kProfileSize) > kLeastFit)) continue;
      partners[i].emplace_back(crossed, j);
      partners[j].emplace_back(crossed, i);
    }
  }
  for (const auto& [i, found] : partners) {
    const std::vector<std::int32_t> likely = LikelyOf(found);
    if (likely.size() != 1 || LikelyOf(partners.at(likely.front())) != std::vector{i}) continue;
    // Two faults that each have a name are as likely: the pair stays open.
    if (HasName(changes[i]) || HasName(changes[likely.front()])) continue;
    changes[i].kind = CampaignKind::kExchanged;
    changes[i].partner = likely.front();
  }
  for (const auto& [i, found] : partners) {
    if (changes[i].kind == CampaignKind::kExchanged) continue;
    for (const std::int32_t other : LikelyOf(found)) {
      const bool free = changes[other].kind != CampaignKind::kExchanged;
      if (free && changes[i].maybe.size() < kMostPartners) changes[i].maybe.push_back(other);
    }
  }
}

}  // namespace lyrefit

#include "plant/campaign.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "lyrefit/base/distributions.h"
#include "lyrefit/base/median.h"
#include "lyrefit/batch/addition.h"
#include "plant/neighbours.h"

namespace lyrefit {
namespace {

constexpr int kTested = 4;  // Isc, Voc, FF, Pmax
constexpr double kTwoSided = 2;
constexpr double kLeastScatter = 1e-4;  // resolution of figures that are equal in most strings
constexpr double kLeastCurrentScatter = 0.0016;  // resolution of a sparkline, twice
constexpr double kMostDegrees = 1e6;             // where Student's t is normal

using Changes = std::vector<CampaignChange>;
using Indices = std::vector<std::int32_t>;
using Ratios = std::array<double, kCampaignChanges>;

// Logarithms of the ratios of one string in one campaign, and its currents.
Ratios LogRatiosOf(const CampaignString& string) {
  std::array<double, kCampaignKept> logs{};
  for (int q = 0; q < kCampaignKept; ++q) {
    logs[q] = string.values[q] > 0 ? std::log(double{string.values[q]}) : kUnknown;
  }
  Ratios ratios = {logs[kCIsc],
                   logs[kCVoc],
                   logs[kCFillFactor],
                   logs[kCPmax],
                   logs[kCImp] - logs[kCIsc],
                   logs[kCVmp] - logs[kCVoc],
                   logs[kCFillFactor],
                   logs[kCPmax] - logs[kCIsc]};
  const std::vector<double> currents = SweepOf(string).currents;
  for (int k = 0; k < kSparklinePoints; ++k) {
    ratios[kCurrents + k] = currents.empty() ? kUnknown : currents[k];
  }
  return ratios;
}

// Reported standard uncertainty of each change, if no error is common to both campaigns. Those of
// ratios in which light cancels are that of the fill factor, those of currents what one instrument
// repeats.
Ratios ReportedSigma(const CampaignString& before, const CampaignString& after) {
  Ratios sigma{};
  for (int q = 0; q <= kCPmax; ++q) {
    sigma[q] = 0.5 * std::hypot(before.expanded[q] / before.values[q],
                                after.expanded[q] / after.values[q]);
  }
  constexpr double kCurrentRepeats = 0.005;
  for (int q = kImpPerIsc; q < kCampaignRatios; ++q) sigma[q] = sigma[kCFillFactor];
  std::fill(sigma.begin() + kCurrents, sigma.end(), kCurrentRepeats);
  return sigma;
}

// Median of sorted values without the one at `left_out`.
double MedianWithout(const std::vector<double>& sorted, std::size_t left_out) {
  const std::size_t count = sorted.size() - 1;
  const auto at = [&](std::size_t k) { return sorted[k < left_out ? k : k + 1]; };
  return count % 2 == 1 ? at(count / 2) : 0.5 * (at(count / 2 - 1) + at(count / 2));
}

// The mean of the middle half of sorted values without the one at `left_out`: currents are rounded
// to 1/255, of which a median would be one again.
double MiddleWithout(const std::vector<double>& sorted, std::size_t left_out) {
  const std::size_t count = sorted.size() - 1, first = count / 4, last = count - count / 4;
  double sum = 0;
  for (std::size_t k = first; k < last; ++k) sum += sorted[k < left_out ? k : k + 1];
  return sum / static_cast<double>(last - first);
}

std::vector<double> SortedOf(const std::vector<Ratios>& values, const Indices& members, int q) {
  std::vector<double> sorted;
  sorted.reserve(members.size());
  for (const std::int32_t i : members) sorted.push_back(values[i][q]);
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

// The later strings that can be compared, by the levels above them.
struct Compared {
  std::vector<Ratios> raw;      // change r
  std::vector<Ratios> weights;  // w
  std::vector<Ratios> sigmas;   // reported
  std::map<std::string, Indices> groups;
  Indices all;
  bool shapes = true;  // the currents of all sweeps are known

  int changes() const { return shapes ? int{kCampaignChanges} : int{kCampaignRatios}; }
};

void SetOwn(const Compared& compared, const Indices& members, CampaignReference reference,
            const Indices& peers, Changes* changes) {
  const std::vector<Ratios>& raw = compared.raw;
  for (int q = 0; q < compared.changes(); ++q) {
    const std::vector<double> sorted = SortedOf(raw, peers, q);
    const auto middle = q < kCampaignRatios ? MedianWithout : MiddleWithout;
    for (const std::int32_t i : members) {
      const auto place = std::lower_bound(sorted.begin(), sorted.end(), raw[i][q]);
      const double common = reference == CampaignReference::kNothing
                                ? 0
                                : middle(sorted, static_cast<std::size_t>(place - sorted.begin()));
      (*changes)[i].common[q] = static_cast<float>(common);
      (*changes)[i].own[q] = static_cast<float>(raw[i][q] - common);
      (*changes)[i].reference = reference;
      (*changes)[i].peers = reference == CampaignReference::kNothing
                                ? 0
                                : static_cast<std::int32_t>(peers.size()) - 1;
    }
  }
}

double ScatterOf(const Compared& compared, const Changes& changes, const Indices& members, int q) {
  std::vector<double> sizes;
  sizes.reserve(members.size());
  for (const std::int32_t i : members) {
    sizes.push_back(changes[i].own[q] / compared.weights[i][q]);
  }
  return std::fmax(RobustScale(std::move(sizes)),
                   q < kCampaignRatios ? kLeastScatter : kLeastCurrentScatter);
}

// Own changes of strings that have one reference, and their scatter. `groups`: number of medians.
void SetScatter(const Compared& compared, const Indices& members, std::size_t groups,
                Changes* changes) {
  const double degrees =
      std::clamp(kMadEfficiency * static_cast<double>(members.size() - groups), 1.0, kMostDegrees);
  for (int q = 0; q < compared.changes(); ++q) {
    const double scatter = ScatterOf(compared, *changes, members, q);
    for (const std::int32_t i : members) {
      (*changes)[i].sigma[q] = static_cast<float>(scatter * compared.weights[i][q]);
    }
  }
  for (const std::int32_t i : members) (*changes)[i].degrees = degrees;
}

// A group that scatters more than the plant by more than chance has its own scatter.
void WidenByGroup(const Compared& compared, const Indices& members, Changes* changes) {
  constexpr double kChance = 2;  // standard deviations
  const double spread = 1 / std::sqrt(2 * kMadEfficiency * static_cast<double>(members.size() - 1));
  for (int q = 0; q < compared.changes(); ++q) {
    const double own = ScatterOf(compared, *changes, members, q);
    for (const std::int32_t i : members) {
      float& sigma = (*changes)[i].sigma[q];
      double wider_by = own * compared.weights[i][q];
      if (q == kCVoc) wider_by = std::min(wider_by, kTemperatureSigma);
      const auto wider = static_cast<float>(wider_by);
      if (wider > sigma * (1 + kChance * spread)) sigma = wider;
    }
  }
}

// Adjusts the fill factor by least squares over the strings within some standard deviations, which
// are found again with the result.
void AdjustFill(const Indices& members, Changes* changes) {
  constexpr int kLeastStrings = 30;
  constexpr int kRounds = 4;
  constexpr double kInside = 3;
  double by_isc = 0, by_voc = 0;
  if (static_cast<int>(members.size()) < kLeastStrings) return;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> sizes;
    const auto left = [&](const CampaignChange& change) {
      return change.own[kCFillFactor] - by_isc * change.own[kCIsc] - by_voc * change.own[kCVoc];
    };
    for (const std::int32_t i : members) sizes.push_back(left((*changes)[i]));
    const double scatter = RobustScale(std::move(sizes));
    double ii = 0, iv = 0, vv = 0, fi = 0, fv = 0;
    for (const std::int32_t i : members) {
      const CampaignChange& change = (*changes)[i];
      const double isc = change.own[kCIsc], voc = change.own[kCVoc];
      if (std::fabs(isc) > kInside * change.sigma[kCIsc] ||
          std::fabs(voc) > kInside * change.sigma[kCVoc] ||
          std::fabs(left(change)) > kInside * scatter) {
        continue;
      }
      const double fill = change.own[kCFillFactor];
      ii += isc * isc, iv += isc * voc, vv += voc * voc, fi += fill * isc, fv += fill * voc;
    }
    const double determinant = ii * vv - iv * iv;
    if (!(determinant > 1e-9 * ii * vv)) return;
    by_isc = (fi * vv - fv * iv) / determinant;
    by_voc = (fv * ii - fi * iv) / determinant;
  }
  for (const std::int32_t i : members) {
    CampaignChange& change = (*changes)[i];
    change.own[kAdjustedFill] = static_cast<float>(
        change.own[kCFillFactor] - by_isc * change.own[kCIsc] - by_voc * change.own[kCVoc]);
  }
}

void SetWeights(Compared* compared) {
  for (int q = 0; q < kCampaignChanges; ++q) {
    std::vector<double> known;
    for (const std::int32_t i : compared->all) {
      if (compared->sigmas[i][q] > 0) known.push_back(compared->sigmas[i][q]);
    }
    const double usual = Median(std::move(known));
    for (const std::int32_t i : compared->all) {
      const double weight = compared->sigmas[i][q] / usual;
      compared->weights[i][q] = weight > 1 ? weight : 1;
    }
  }
}

using ById = std::map<std::string, Indices>;

// A campaign may repeat a part of the plant: only strings of a group with later ones are gone.
void FindGone(const std::vector<CampaignString>& before, const std::vector<CampaignString>& after,
              const ById& later, Campaign* campaign) {
  std::set<std::string> groups;
  for (const CampaignString& string : after) groups.insert(ParentOf(string.id));
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (later.count(before[k].id) > 0) continue;
    if (groups.count(ParentOf(before[k].id)) > 0) {
      campaign->gone.push_back(static_cast<std::int32_t>(k));
    } else {
      ++campaign->not_repeated;
    }
  }
}

// Adds the string at index `k` of the later campaign, if both sweeps have all figures.
void AddPair(const CampaignString& before, const CampaignString& after, std::size_t k,
             CampaignChange* change, Compared* compared) {
  const Ratios now = LogRatiosOf(after), then = LogRatiosOf(before);
  bool known = true, known_then = true;
  for (int q = 0; q < kCampaignChanges; ++q) {
    compared->raw[k][q] = now[q] - then[q];
    if (q >= kCampaignRatios) continue;
    known = known && std::isfinite(now[q]);
    known_then = known_then && std::isfinite(then[q]);
  }
  if (!known || !known_then) {
    change->why_not = known ? "the earlier sweep has no figures at standard conditions"
                            : "this sweep has no figures at standard conditions";
    return;
  }
  compared->shapes = compared->shapes && std::isfinite(compared->raw[k][kCurrents]);
  compared->sigmas[k] = ReportedSigma(before, after);
  compared->groups[ParentOf(after.id)].push_back(static_cast<std::int32_t>(k));
  compared->all.push_back(static_cast<std::int32_t>(k));
}

// Pairs each later string with its earlier one.
Compared PairById(const std::vector<CampaignString>& before,
                  const std::vector<CampaignString>& after, Campaign* campaign) {
  ById earlier, later;
  for (std::size_t k = 0; k < before.size(); ++k) {
    earlier[before[k].id].push_back(static_cast<std::int32_t>(k));
  }
  for (std::size_t k = 0; k < after.size(); ++k) {
    later[after[k].id].push_back(static_cast<std::int32_t>(k));
  }
  Compared compared;
  for (auto* part : {&compared.raw, &compared.weights, &compared.sigmas}) {
    part->resize(after.size());
  }
  for (std::size_t k = 0; k < after.size(); ++k) {
    CampaignChange& change = campaign->changes[k];
    const auto found = earlier.find(after[k].id);
    if (found == earlier.end()) {
      change.kind = CampaignKind::kNew;
    } else if (found->second.size() > 1 || later[after[k].id].size() > 1) {
      change.why_not = "several curves have this id";
    } else {
      change.before = found->second.front();
      AddPair(before[change.before], after[k], k, &change, &compared);
    }
  }
  FindGone(before, after, later, campaign);
  return compared;
}

// Common change of some strings. Its interval has the reported uncertainty of one string, since an
// error of the light or of a sensor may be common to all.
CampaignGroup CommonOf(const Compared& compared, const std::string& name, const Indices& members) {
  CampaignGroup group;
  group.name = name;
  group.strings = static_cast<std::int64_t>(members.size());
  for (int q = 0; q < kCampaignRatios; ++q) {
    std::vector<double> raw, sigma;
    for (const std::int32_t i : members) {
      raw.push_back(compared.raw[i][q]);
      sigma.push_back(compared.sigmas[i][q]);
    }
    group.shift[q] = Median(std::move(raw));
    const double half = 2 * Median(std::move(sigma));
    group.low[q] = group.shift[q] - half;
    group.high[q] = group.shift[q] + half;
  }
  return group;
}

// Groups whose common change differs from that of the plant by more than is usual among groups.
void FindGroups(const Compared& compared, Campaign* campaign) {
  for (const auto& [name, members] : compared.groups) {
    if (name.empty() || static_cast<int>(members.size()) <= kLeastPeers) continue;
    campaign->groups.push_back(CommonOf(compared, name, members));
  }
  const auto count = static_cast<double>(campaign->groups.size());
  if (count <= kLeastPeers) return;
  for (int q = 0; q <= kCPmax; ++q) {
    std::vector<double> shifts;
    for (const CampaignGroup& group : campaign->groups) shifts.push_back(group.shift[q]);
    const double middle = Median(shifts);
    for (double& shift : shifts) shift = std::fabs(shift - middle);
    const double scatter = RobustScale(shifts);
    const double degrees = std::max(kMadEfficiency * (count - 1), 1.0);
    const double t = StudentQuantile(1 - campaign->level / (kTwoSided * kTested * count), degrees);
    for (std::size_t g = 0; g < shifts.size(); ++g) {
      if (shifts[g] > t * scatter) campaign->groups[g].differs = true;
    }
  }
}

// Own changes of strings of groups that are large enough.
void CompareInGroups(const Compared& compared, const std::vector<const Indices*>& groups,
                     Changes* changes) {
  Indices all;
  for (const Indices* members : groups) {
    SetOwn(compared, *members, CampaignReference::kGroup, *members, changes);
    all.insert(all.end(), members->begin(), members->end());
  }
  if (all.empty()) return;
  SetScatter(compared, all, groups.size(), changes);
  AdjustFill(all, changes);
  SetScatter(compared, all, groups.size(), changes);
  for (const Indices* members : groups) WidenByGroup(compared, *members, changes);
}

// Own changes of the others, which scatter as all strings do against the plant; of a plant of few
// strings the changes themselves, with their reported uncertainty.
void CompareInPlant(const Compared& compared, const Indices& members, Changes* changes) {
  if (members.empty()) return;
  if (static_cast<int>(compared.all.size()) > kLeastPeers) {
    Changes against = *changes;
    SetOwn(compared, compared.all, CampaignReference::kPlant, compared.all, &against);
    SetScatter(compared, compared.all, 1, &against);
    AdjustFill(compared.all, &against);
    SetScatter(compared, compared.all, 1, &against);
    for (const std::int32_t i : members) (*changes)[i] = against[i];
    return;
  }
  SetOwn(compared, members, CampaignReference::kNothing, compared.all, changes);
  for (const std::int32_t i : members) {
    for (int q = 0; q < kCampaignChanges; ++q) {
      (*changes)[i].sigma[q] = static_cast<float>(compared.sigmas[i][q]);
    }
    (*changes)[i].degrees = kMostDegrees;
  }
}

}  // namespace

Campaign CompareCampaigns(const std::vector<CampaignString>& before,
                          const std::vector<CampaignString>& after, double level) {
  Campaign campaign;
  campaign.level = level;
  campaign.changes.resize(after.size());
  Compared compared = PairById(before, after, &campaign);
  if (!compared.all.empty()) {
    SetWeights(&compared);
    campaign.shapes = compared.shapes;
    campaign.plant = CommonOf(compared, "", compared.all);
    Indices others;
    std::vector<const Indices*> groups;
    for (const auto& [name, members] : compared.groups) {
      if (static_cast<int>(members.size()) > kLeastPeers) {
        groups.push_back(&members);
      } else {
        others.insert(others.end(), members.begin(), members.end());
      }
    }
    CompareInGroups(compared, groups, &campaign.changes);
    CompareInPlant(compared, others, &campaign.changes);
    FindGroups(compared, &campaign);
  }
  DecideKinds(before, after, compared.all.size(), &campaign);
  return campaign;
}

}  // namespace lyrefit

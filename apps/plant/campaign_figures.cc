#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/median.h"
#include "lyrefit/batch/addition.h"
#include "lyrefit/batch/sparkline.h"
#include "plant/campaign.h"

namespace lyrefit {
namespace {

// Currents of a sweep in parts of Isc; empty: unknown.
std::vector<double> CurrentsOf(const CampaignString& string) {
  std::vector<double> currents = ReadSparkline(string.sparkline);
  if (currents.empty() || !(currents.front() > 0)) return {};
  const double isc = currents.front();
  for (double& current : currents) current /= isc;
  return currents;
}

// ln of what a figure at these conditions is of that at standard conditions, for a usual module of
// crystalline silicon: only differences between neighbours are taken of it.
double UsualLog(const CampaignString& string, int q) {
  constexpr double kIscPerK = 0.0005, kVocPerK = -0.003, kPmaxPerK = -0.004;
  const double light = std::log(string.irradiance_W_m2 / 1000.0);
  const double warmer = string.temperature_C - 25.0;
  const double isc = light + kIscPerK * warmer;
  const double voc = kVocPerLight * light + std::log1p(kVocPerK * warmer);
  const double fill = kFillPerLight * light + (kPmaxPerK - kVocPerK - kIscPerK) * warmer;
  switch (q) {
    case kCVoc:
    case kCVmp:
      return voc;
    case kCFillFactor:
      return fill;
    case kCPmax:
      return isc + voc + fill;
    default:
      return isc;
  }
}

// How one figure of a string was carried, less what is usual at its conditions; NaN: unknown.
double CarriedLog(const CampaignString& string, int q) {
  return std::log(double{string.values[q]} / string.measured[q]) + UsualLog(string, q);
}

}  // namespace

void CarryInOneWay(std::vector<CampaignString>* strings) {
  std::map<std::string, int> ways;
  for (const CampaignString& string : *strings) {
    if (string.values[kCPmax] > 0) ++ways[string.procedure];
  }
  if (ways.size() < 2) return;
  const auto most = std::max_element(
      ways.begin(), ways.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  struct Usual {
    std::vector<double> logs[kCampaignKept], expanded[kCampaignKept];
  };
  std::map<std::string, Usual> groups;  // the plant has no name
  for (const CampaignString& string : *strings) {
    if (string.procedure != most->first || !std::isfinite(CarriedLog(string, kCPmax))) continue;
    for (Usual* usual : {&groups[ParentOf(string.id)], &groups[""]}) {
      for (int q = 0; q < kCampaignKept; ++q) {
        usual->logs[q].push_back(CarriedLog(string, q));
        usual->expanded[q].push_back(string.expanded[q] / string.values[q]);
      }
    }
  }
  for (CampaignString& string : *strings) {
    if (string.procedure == most->first || !(string.irradiance_W_m2 > 0)) continue;
    const auto own = groups.find(ParentOf(string.id));
    const Usual& usual = own != groups.end() ? own->second : groups[""];
    if (usual.logs[0].empty()) continue;
    for (int q = 0; q < kCampaignKept; ++q) {
      if (!(string.values[q] > 0) || !(string.measured[q] > 0)) continue;
      const double log = Median(usual.logs[q]) - UsualLog(string, q);
      string.values[q] = static_cast<float>(string.measured[q] * std::exp(log));
      string.expanded[q] = static_cast<float>(string.values[q] * Median(usual.expanded[q]));
    }
  }
}

SweepFigures SweepOf(const CampaignString& string) {
  return {std::log(double{string.values[kCIsc]}), std::log(double{string.values[kCVoc]}),
          double{string.values[kCImp]} / string.values[kCIsc],
          double{string.values[kCVmp]} / string.values[kCVoc], CurrentsOf(string)};
}

}  // namespace lyrefit

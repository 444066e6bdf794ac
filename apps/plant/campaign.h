#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/batch/result_row.h"
#include "plant/campaign_summary.h"

namespace lyrefit {

// Comparison of a campaign with an earlier one: the same strings, one sweep each.
//
// The change of a figure is r = ln(later / earlier), both at standard conditions. Rating and
// coefficients are common to both, so that their errors cancel. An error of a campaign or of a
// combiner (a reference cell that drifted or was recalibrated, a sensor set up anew) shifts all
// strings alike. The common change of a string is the median r of the others of its group, if at
// least kLeastPeers are compared; else of the others of the plant. Its own change is d = r - median.
//
// The usual scatter is s = 1.4826 median |d / w| over the plant, or over its own group if that is
// larger by more than chance (neighbours.h). w is the reported uncertainty of r over the median of
// the plant, at least 1: figures that are less sure than usual have a wider limit. The interval of d
// is d +- t s w with Student's t at 95 % and the degrees of freedom of neighbours.h. A string is
// changed if one of Isc, Voc, FF, Pmax exceeds t s w with t at level / (8 strings). So the level is
// the probability that any string of a plant without a change is called changed (Bonferroni). Fewer
// strings than kLeastPeers + 1 have no common change: r itself is compared with its reported
// uncertainty.
//
// Errors of light and temperature of a single sweep move Isc, Voc and FF together. The adjusted fill
// factor is d(FF) - a d(Isc) - b d(Voc), with a and b by least squares over the strings that did not
// change. It takes the place of FF where Isc and Voc are within what is usual; its scatter is smaller.
//
// Power lost at standard conditions is P (1 - exp(d)), P of the earlier campaign and d the sum over
// those of Isc, Voc and FF that changed. Voc and FF within what is usual count as unchanged, with half
// their intervals. If no figure changed, d is that of Pmax.

// Figures that are kept of a string: those of kCampaignFigures, and the maximum power point.
enum CampaignFigure { kCIsc, kCVoc, kCFillFactor, kCPmax, kCImp, kCVmp, kCampaignKept };

// Changes that are formed of them: Isc, Voc, FF, Pmax, Imp / Isc, Vmp / Voc, and FF adjusted.
enum CampaignRatio { kImpPerIsc = 4, kVmpPerVoc, kAdjustedFill, kCampaignRatios };

// A string in one campaign: about 150 bytes.
struct CampaignString {
  std::string id;
  std::string cause;                            // of the diagnosis; empty: none
  std::array<float, kCampaignKept> values{};    // NaN: unknown
  std::array<float, kCampaignKept> expanded{};  // their uncertainties, k = 2
  std::int32_t bypass_diodes = 0;               // 0: unknown
  bool repeat = false;                          // light or conditions changed during the sweep
};

enum class CampaignKind {
  kNotCompared,
  kNone,
  kLight,
  kSubstrings,
  kVoltage,
  kSeriesResistance,
  kShuntOrMismatch,
  kFillFactor,
  kSeveral,
  kPower,
  kMeasurement,
  kExchanged,
  kRenamed,
  kNew
};

// Reference of a string's own change.
enum class CampaignReference { kNothing, kPlant, kGroup };

// The comparison of one string. Changes are natural logarithms.
struct CampaignChange {
  CampaignKind kind = CampaignKind::kNotCompared;
  CampaignReference reference = CampaignReference::kNothing;
  std::int32_t before = -1;         // index of the string in the earlier campaign; -1: none
  std::vector<std::int32_t> maybe;  // strings of the later campaign it may be exchanged with
  std::int32_t partner = -1;  // exchanged: index in the later campaign; renamed: in the earlier
  // Substrings that are missing (> 0) or came back (< 0): the whole numbers in the interval.
  std::int32_t steps_low = 0, steps_high = 0;
  std::int32_t rank = 0;                        // 1: the largest loss; 0: not changed
  std::array<float, kCampaignRatios> common{};  // common change
  std::array<float, kCampaignRatios> own{};     // own change
  std::array<float, kCampaignRatios> sigma{};   // scatter of the own change
  double degrees = 0;                           // of freedom of the scatter
  double t95 = kUnknown;  // Student's t of the intervals: half-width over sigma
  bool adjusted = false;  // the fill factor is judged by the adjusted one
  double lost_W = kUnknown, lost_low_W = kUnknown, lost_high_W = kUnknown;
  std::string why_not;  // reason if it is not compared
};

struct CampaignGroup {
  std::string name;  // empty: the plant
  std::int64_t strings = 0;
  std::array<double, kCampaignRatios> shift{}, low{}, high{};  // common change with its interval
  bool differs = false;                                        // from the plant
};

struct Campaign {
  double level = 0;
  std::vector<CampaignChange> changes;  // one for each later string
  CampaignGroup plant;
  std::vector<CampaignGroup> groups;
  // Indices of strings of the earlier campaign only, of groups with a later string.
  std::vector<std::int32_t> gone;
  std::int64_t not_repeated = 0;  // number of those of groups without a later string
};

// Compares two campaigns. `level`: see above. The result does not depend on the order of `before`,
// except for its indices.
Campaign CompareCampaigns(const std::vector<CampaignString>& before,
                          const std::vector<CampaignString>& after, double level);

// campaign_columns.cc: the columns, the cells of one string, and the summary.
std::vector<ResultColumn> CampaignColumns();
std::vector<ResultCell> CampaignCells(const Campaign& campaign,
                                      const std::vector<CampaignString>& before,
                                      const std::vector<CampaignString>& after, std::size_t i);
// All members but those of the earlier run.
CampaignSummary SummariseCampaign(const Campaign& campaign,
                                  const std::vector<CampaignString>& before,
                                  const std::vector<CampaignString>& after);

// campaign_kinds.cc: what changed, the power lost by it, and the ranks. `compared`: number of strings
// with changes.
void DecideKinds(const std::vector<CampaignString>& before,
                 const std::vector<CampaignString>& after, std::size_t compared,
                 Campaign* campaign);

// campaign_pairs.cc: names exchanged and renamed strings.
void FindExchanged(const std::vector<CampaignString>& before,
                   const std::vector<CampaignString>& after, Campaign* campaign);

}  // namespace lyrefit

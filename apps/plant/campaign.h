#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/batch/result_row.h"
#include "plant/campaign_shape.h"
#include "plant/campaign_summary.h"

namespace lyrefit {

// Comparison of a campaign with an earlier one: the same strings, one sweep each.
//
// The change of a figure is r = ln(later / earlier), both at standard conditions, to which all
// sweeps of a campaign are carried in one way: the procedure of most of them. Where another one was
// recommended, as for a sweep with a cause of its own, the measured figure is carried as those of
// its group were. Rating and coefficients are common to both, so that their errors cancel. An error of a campaign or of a
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
// What changed is the mechanism (campaign_shape.h) that makes the later sweep of the earlier one, or
// the reverse for a gain; what all sweeps of the group share is taken off first. Several that the
// sweeps do not tell apart are a set.
//
// Power lost at standard conditions is P (1 - exp(d)), P of the earlier campaign. d is the own change
// of Pmax, or of Pmax / Isc where Isc is within what is usual: then its change is an error of the
// light. That of a series resistance is the change of FF. It is scaled from the conditions of the
// sweep to standard conditions: what a resistance takes grows with the current, what a leak takes
// with the voltage, by a law between two that widen the interval. A temperature that was read wrong
// costs nothing.

// Figures that are kept of a string: those of kCampaignFigures, and the maximum power point.
enum CampaignFigure { kCIsc, kCVoc, kCFillFactor, kCPmax, kCImp, kCVmp, kCampaignKept };

// Changes that are formed of them: Isc, Voc, FF, Pmax, Imp / Isc, Vmp / Voc, FF adjusted, and
// Pmax / Isc. Differences of the currents of both sweeps, in parts of Isc, follow.
enum CampaignRatio {
  kImpPerIsc = 4,
  kVmpPerVoc,
  kAdjustedFill,
  kPmaxPerIsc,
  kCampaignRatios,
  kCurrents = kCampaignRatios,
  kCampaignChanges = kCurrents + kSparklinePoints
};

// A string in one campaign: about 260 bytes.
struct CampaignString {
  std::string id;
  std::string cause;                             // of the diagnosis; empty: none
  std::string procedure;                         // that carried it to standard conditions
  std::array<float, kCampaignKept> values{};     // NaN: unknown
  std::array<float, kCampaignKept> expanded{};   // their uncertainties, k = 2
  std::array<float, kCampaignKept> measured{};   // as read; 0 or NaN: unknown
  float irradiance_W_m2 = 0, temperature_C = 0;  // of the sweep; 0 W/m2: unknown
  std::string sparkline;                         // currents of the sweep; empty: unknown
  std::int32_t bypass_diodes = 0;                // 0: unknown
  bool repeat = false;                           // light or conditions changed during the sweep
};

enum class CampaignKind {
  kNotCompared,
  kNone,
  kLight,
  kSubstrings,
  kVoltage,
  kTemperature,
  kSeriesResistance,
  kShunt,
  kMismatch,
  kShuntOrMismatch,
  kFillFactor,
  kOtherModules,
  kSeveral,
  kMeasurement,
  kExchanged,
  kRenamed,
  kNew
};

template <>
struct EnumTable<CampaignKind> {
  static constexpr EnumText<CampaignKind> kRows[] = {
      {CampaignKind::kNone, "none"},
      {CampaignKind::kLight, "light"},
      {CampaignKind::kSubstrings, "substrings"},
      {CampaignKind::kVoltage, "voltage"},
      {CampaignKind::kTemperature, "temperature"},
      {CampaignKind::kSeriesResistance, "series_resistance"},
      {CampaignKind::kShunt, "shunt"},
      {CampaignKind::kMismatch, "mismatch"},
      {CampaignKind::kShuntOrMismatch, "shunt_or_mismatch"},
      {CampaignKind::kFillFactor, "fill_factor"},
      {CampaignKind::kOtherModules, "other_modules"},
      {CampaignKind::kSeveral, "several"},
      {CampaignKind::kMeasurement, "measurement"},
      {CampaignKind::kExchanged, "exchanged"},
      {CampaignKind::kRenamed, "renamed"},
      {CampaignKind::kNew, "new"}};
};

// The kind of a mechanism that is named alone.
CampaignKind KindOf(Mechanism mechanism);
// It is from this probability.
inline constexpr double kSureOfMechanism = 0.8;

// Reference of a string's own change.
enum class CampaignReference { kNothing, kPlant, kGroup };

// The comparison of one string. Changes are natural logarithms.
struct CampaignChange {
  CampaignKind kind = CampaignKind::kNotCompared;
  CampaignReference reference = CampaignReference::kNothing;
  std::int32_t before = -1;         // index of the string in the earlier campaign; -1: none
  std::vector<std::int32_t> maybe;  // strings of the later campaign it may be exchanged with
  std::int32_t partner = -1;  // exchanged: index in the later campaign; renamed: in the earlier
  std::vector<MechanismFit> fits;  // what makes one sweep of the other, the most probable first
  bool gain = false;               // the mechanisms were there before
  std::int32_t rank = 0;           // 1: the largest loss; 0: not changed
  std::array<float, kCampaignChanges> common{};  // common change
  std::array<float, kCampaignChanges> own{};     // own change
  std::array<float, kCampaignChanges> sigma{};   // scatter of the own change
  std::int32_t peers = 0;  // strings whose median is the common change; 0: there is none
  double degrees = 0;      // of freedom of the scatter
  double t95 = kUnknown;   // Student's t of the intervals: half-width over sigma
  bool adjusted = false;   // the fill factor is judged by the adjusted one
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
  bool shapes = false;                  // the currents of all sweeps are known
  std::vector<CampaignChange> changes;  // one for each later string
  CampaignGroup plant;
  std::vector<CampaignGroup> groups;
  // Indices of strings of the earlier campaign only, of groups with a later string.
  std::vector<std::int32_t> gone;
  std::int64_t not_repeated = 0;  // number of those of groups without a later string
};

// Compares two campaigns. `level`: see above. The result does not depend on the order of `before`,
// except for its indices. The figures of both have to be carried in one way.
Campaign CompareCampaigns(const std::vector<CampaignString>& before,
                          const std::vector<CampaignString>& after, double level);

// Carries the figures of all strings of a campaign to standard conditions in one way (see above).
void CarryInOneWay(std::vector<CampaignString>* strings);

// The sweep of a string for the mechanisms.
SweepFigures SweepOf(const CampaignString& string);

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

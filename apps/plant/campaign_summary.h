// Experimental: may change in a minor version (data/stable).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"
#include "lyrefit/model/cause.h"

namespace LYREFIT_PUBLIC lyrefit {

// Figures at standard conditions whose changes are reported, in this order.
inline constexpr std::array<const char*, 4> kCampaignFigures = {"Isc", "Voc", "FF", "Pmax"};

// A change in percent with its 95 % interval.
struct PercentChange {
  double value = kUnknown;  // of the later over the earlier figure, less 1
  double low = kUnknown;    // lower end of the interval
  double high = kUnknown;   // upper end of the interval
};

// The change that all strings of a plant or of a group share.
struct CommonChange {
  std::string name;          // the levels of the ids above the strings; empty: the whole plant
  std::int64_t strings = 0;  // number of strings that were compared
  std::array<PercentChange, kCampaignFigures.size()> percent;  // of each figure
  std::string sentence;                                        // what it may come from
};

// A string that changed by more than is usual, or that can only be named.
struct StringChange {
  std::int64_t rank = 0;  // 1: the largest loss; 0: no power is known
  std::string id;         // its name in the later campaign
  Cause cause;            // its id as in the column change_kind, its power: lost; negative: gained
  double isc_percent = kUnknown;  // its own change of Isc, in percent
  double voc_percent = kUnknown;  // its own change of Voc, in percent
  double ff_percent = kUnknown;   // its own change of FF, adjusted if Isc and Voc did not change
};

// A campaign compared with an earlier one of the same plant.
struct CampaignSummary {
  std::string before_version;    // of lyrefit, that wrote the earlier results; empty: no comparison
  std::int64_t before_rows = 0;  // number of earlier rows
  std::string before_first_date;  // of the earlier sweeps, as written
  std::string before_last_date;   // of the earlier sweeps, as written
  double level = 0;               // probability that any string without a change is called changed
  std::int64_t compared = 0;      // number of strings with figures in both campaigns
  std::int64_t changed = 0;       // of `compared`: by more than is usual
  double lost_W = 0;              // sum over strings that lost power
  double gained_W = 0;            // sum over strings that gained power
  CommonChange plant;             // of all strings
  std::vector<CommonChange> groups;   // those that differ from the plant
  std::vector<StringChange> changes;  // at most kMostChanges, by rank
  std::int64_t gone = 0;          // number of earlier strings without a later one in a later group
  std::int64_t not_repeated = 0;  // number of earlier strings of groups without a later string
  std::int64_t fresh = 0;         // number of later strings without an earlier one
  std::vector<std::string> gone_ids;                           // the first kMostChanges of them
  std::vector<std::string> fresh_ids;                          // the first kMostChanges of them
  std::vector<std::pair<std::string, std::string>> exchanged;  // pairs of strings
  std::vector<std::string> remarks;                            // what the reader has to know
};

// Number of strings that the summary lists.
constexpr std::size_t kMostChanges = 500;

}  // namespace lyrefit

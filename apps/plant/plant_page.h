// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cstdint>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Writes the page of the results in a folder from RunBatch or MergeShards: one HTML file that loads
// nothing. Verdict, pictures and tables are readable on paper, in mail and without scripts; with
// scripts results.csv, which is in the page unchanged, is a table to search, filter and sort. The
// page links to the pages of single strings. Returns the number of rows. Memory does not grow with
// it. Errors: a file of the results that is missing or not as expected, a page that cannot be
// written.
//
// Any columns are allowed. These names have a meaning if they exist:
//   id                       '/' separates the levels of the plant's tree
//   status                   "fine" or another status, with its reason in `reason`
//   zone                     "pass...", "undecided" or "fail...": against the rating
//   cause, cause_title, cause_about, cause_sentence, action, probability, equivalents, separate_by
//   plan_cause, plan_cause_title, ...
//                            what the curve shows, and what plan and neighbours show: together
//                            one verdict (string_verdict.h)
//   date                     ISO 8601
//   first, last              times of a trend
//   loss_..._percent, reference_power_W, loss_now_total_percent, largest_loss, onset_date
//                            energy that a trend says is lost, by part, to what most, and since when
//   with a zone or a plan, the strings that need a visit rank by what they lose; else
//   performance_factor, loss_now_total_percent, group_deviation_percent,
//   recoverable_power_W, lack_of_fit_percent
//                            the column that ranks the worst strings
//   Pmax_stc_W, recoverable_power_W, below_rating_W
//   group_flag, group_outlier, group_Isc_percent, ...
//                            whether and how a string differs from those of the same combiner
//   change_lost_W, change_kind
//                            what changed since earlier results; campaign.json has the rest
//   sparkline                the curve, by Sparkline()
//   page                     the string's own page: a path from the folder of the results
Expected<std::int64_t> WritePlantPage(const std::string& folder, const std::string& file,
                                      const std::string& plant);

// The relative URL from the folder of `file` to `folder`, with '/' at its end; "" if both are
// equal.
std::string UrlFrom(const std::string& file, const std::string& folder);

}  // namespace lyrefit

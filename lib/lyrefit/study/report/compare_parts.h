#pragma once

#include <string>
#include <vector>

#include "lyrefit/report/document.h"
#include "lyrefit/study/comparison.h"

// What the documents on comparisons share.
namespace lyrefit {

// "measured-current", with the effects that every model has.
std::string ObjectiveText(const CompareOptions& options);

// "rtc_france, double-diode model, bounds literature"
std::string ProblemTitle(const ProblemResult& problem);

// Of how many runs the figures of a problem are: "50", or "12 to 13 of 50" where it was cut short.
std::string RunsText(const Comparison& comparison, const ProblemResult& problem);

// What is doubtful, and whether the study was cut short.
std::vector<std::string> CompareBanners(const Comparison& comparison);

// The fields that hold for every table: objective, budget, seed.
void AddSetUp(const Comparison& comparison, Section* section);

// A section under the problem's title, with the field that says what its runs are measured against.
Section ProblemSection(const Comparison& comparison, const ProblemResult& problem);

// compare_ranks.cc: Friedman and Wilcoxon of one problem, and what the polish left of the ranking in
// one sentence; each without blocks where there is nothing to say.
Section RankSection(const ProblemResult& problem);
Section PolishVerdict(const ProblemResult& problem);

// The same file: a sentence for each of `names`, as the ranks count them, that is better than others
// beyond chance.
std::vector<std::string> WinnerSentences(const std::vector<std::string>& names,
                                         const Ranking& ranking);

// pool_document.cc: problems of many local optima; nothing where there are none.
std::vector<Section> PoolSections(const Comparison& comparison);

}  // namespace lyrefit

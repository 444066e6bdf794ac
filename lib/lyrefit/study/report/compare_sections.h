#pragma once

#include <string>
#include <vector>

#include "lyrefit/study/comparison.h"

// What the texts on comparisons share. Sections end with a newline, or are empty where there is
// nothing to say.
namespace lyrefit {

// "rtc_france, double-diode model, bounds literature"
std::string ProblemTitle(const ProblemResult& problem);

// Of how many runs the figures of a problem are: "50", or "12 to 13 of 50" where it was cut short.
std::string RunsText(const Comparison& comparison, const ProblemResult& problem);

// "INTERRUPTED: ..." or nothing.
std::string InterruptedLine(const Comparison& comparison);

// The facts that hold for every table: objective, budget, seed, target.
std::string SetUpSection(const Comparison& comparison);

// What the runs of a problem are measured against.
std::string ReferenceField(const Comparison& comparison, const ProblemResult& problem);

// compare_overview.cc: every curve, model and algorithm in one table, where there is more than one
// curve.
std::string OverviewSection(const Comparison& comparison);

// compare_ranks.cc: Friedman and Wilcoxon of one problem.
std::string RankSection(const ProblemResult& problem);

// The same file: one line for each of `names`, as the ranks count them, that is better than others
// beyond chance.
std::string WinnersText(const std::vector<std::string>& names, const Ranking& ranking);

// pool_text.cc: problems of many basins; nothing where there are none.
std::string PoolSections(const Comparison& comparison);

// What the polish left of the ranking, in one sentence.
std::string PolishVerdict(const ProblemResult& problem);

}  // namespace lyrefit

#pragma once

#include <map>
#include <string>
#include <vector>

namespace lyrefit {

// How often a cause is in a sweep at a size that matters, and on what the number rests.
struct CausePrior {
  const char* id;
  double probability;
  const char* source;
};

// The default table. Orders of magnitude: a factor of three changes few verdicts, since the
// evidence of a fault above the floors is usually larger by far.
const std::vector<CausePrior>& DefaultPriors();

// Of a cause that is in no table, such as an effect of one's own.
constexpr double kOtherPrior = 0.02;
// That something is there which no effect of the catalogue describes.
constexpr double kUnknownPrior = 0.003;
// That a given sweep contains a wrong reading.
constexpr double kWrongReadingPrior = 0.05;

// Prior probability of a cause: from `own`, else from the table.
double PriorOf(const std::string& id, const std::map<std::string, double>& own);

}  // namespace lyrefit

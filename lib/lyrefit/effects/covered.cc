#include "lyrefit/effects/covered.h"

#include <algorithm>

namespace lyrefit {

double ShareLeft(double share, int which, int groups, int first) {
  constexpr double kMost = 0.999;  // the law needs cells without the effect
  const double taken = std::clamp(share * groups - (which - first), 0.0, which < first ? 0.0 : 1.0);
  return std::min((share - taken / groups) * groups / (groups - 1), kMost);
}

bool GoneWithTheFirst(double*, int which, int) { return which > 0; }

bool SecondIsShare(double* p, int which, int groups) {
  p[1] = ShareLeft(p[1], which, groups);
  return p[1] > 1e-3;
}

}  // namespace lyrefit

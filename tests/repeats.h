#pragma once

#include <algorithm>

namespace lyrefit {

// How often to repeat what only makes a claim surer: a tenth where the sanitizers make all slow.
constexpr int Repeats(int often) {
#ifdef LYREFIT_SANITIZED
  return std::max(1, often / 10);
#else
  return often;
#endif
}

}  // namespace lyrefit

#include "lyrefit/curve/assumption.h"

#include <algorithm>

namespace lyrefit {

void Forget(About about, std::vector<Assumption>* assumptions) {
  const auto concerned = [about](const Assumption& one) { return one.about == about; };
  assumptions->erase(std::remove_if(assumptions->begin(), assumptions->end(), concerned),
                     assumptions->end());
}

std::vector<std::string> SentencesOf(const std::vector<Assumption>& assumptions) {
  std::vector<std::string> sentences;
  sentences.reserve(assumptions.size());
  for (const Assumption& one : assumptions) sentences.push_back(one.sentence);
  return sentences;
}

}  // namespace lyrefit

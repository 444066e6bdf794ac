#include "lyrefit/curve/left_temperature.h"

namespace lyrefit {
namespace {

constexpr char kLeftEnd[] = " speaks of a temperature, not clearly of the cells: not used";

}  // namespace

Assumption LeftTemperature(const std::string& line) {
  return {line + kLeftEnd, About::kTemperature};
}

bool IsLeftTemperature(const Assumption& assumption) {
  const std::string& sentence = assumption.sentence;
  const std::string end = kLeftEnd;
  return assumption.about == About::kTemperature && sentence.size() >= end.size() &&
         sentence.compare(sentence.size() - end.size(), end.size(), end) == 0;
}

}  // namespace lyrefit

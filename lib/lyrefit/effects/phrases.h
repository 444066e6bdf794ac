#pragma once

#include <string>
#include <vector>

#include "lyrefit/effects/fitted_effect.h"

// Phrases from which effects say their size (Effect::in_words).
namespace lyrefit {

// What in_words returns: phrases, the most important first.
using Phrases = std::vector<std::string>;

// Times a factor.
Sized Scaled(const Sized& size, double factor);

// "71 % (69 to 73)", without an interval that rounding hides.
std::string PercentWithRange(const Sized& part, int digits);

// Light that is left where `factor` times the deficit is missing.
std::string LightLeft(double deficit, const Sized& reported, double factor = 1);

// "1 of 3 substrings", or "33 % of the cells" if the share is no whole number of substrings.
std::string PartOfCells(const Readings& readings, double share);

// ", on 40 % of its cells"; nothing if a shade covers all of them.
std::string CoveredPart(double part);

// Three digits without an exponent.
std::string PlainDigits(double value);

// "3.2 K (2.9 to 3.5)"
std::string WithUnit(const Sized& size, const char* unit);

// A difference as a positive size and one of two words for its sign.
std::string SignedSize(const Sized& size, const char* unit, const char* above, const char* below);

// "5.02 A", "1.3 mA", "8.2 uA"
std::string AmpereText(double value);

// "was 14.0 % (13.8 to 14.2) weaker than before". `limit`: the largest change that a fit can have,
// which an interval reaches where the readings do not determine it.
std::string LightChange(const Sized& part, double limit, const char* than);

// Voltage of the device at a reading, and at the reading nearest to the moment that is the second
// parameter.
double VoltageAt(const FittedEffect& of, const Reading& reading);
double VoltageAtMoment(const FittedEffect& of);

}  // namespace lyrefit

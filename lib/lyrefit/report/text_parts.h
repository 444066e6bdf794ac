#pragma once

#include <string>
#include <vector>

#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/device/device.h"

// What the text writers share.
namespace lyrefit {

// "single-diode"
std::string ModelTitle(Model model);

// "1 cell", "3 cells"
std::string Plural(std::size_t count, const std::string& noun);

// The lines "curve" and "conditions" of a report's head.
std::string CurveFields(const IvCurve& curve);

// A proved bound, which must not be rounded up.
std::string BoundText(double bound);

// A title and a list of sentences; nothing without sentences.
std::string List(const std::string& title, const std::vector<std::string>& sentences);

}  // namespace lyrefit

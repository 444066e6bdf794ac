#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/read_curve.h"
#include "lyrefit/curve/text_encoding.h"

// What a file holds, where it cannot be read twice. JSON is known by its text.
namespace lyrefit {

// As ReadCurve reads it.
Expected<IvCurve> CurveOfFile(const DecodedText& text, const std::string& path,
                              const ReadOptions& options);

// As HoldsCurveSet and ReadCurveSet understand it.
bool TextHoldsCurveSet(const DecodedText& text, const std::string& path,
                       const ReadOptions& options);
Expected<CurveSet> CurveSetOfFile(const DecodedText& text, const std::string& path,
                                  const ReadOptions& options);

// The set that a pipe holds, or its one curve as a set; reads it once.
Expected<CurveSet> ReadCurvesOfStream(const std::string& path, const ReadOptions& options);

}  // namespace lyrefit

#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/text_encoding.h"

// Reading from text that is already in memory, for sources that cannot be read twice. JSON is
// detected by parsing.
namespace lyrefit {

// Interprets the text as ReadCurve would interpret a file.
Expected<IvCurve> CurveOfFile(const DecodedText& text, const std::string& path,
                              const ReadOptions& options);

// Interpret the text as HoldsCurveSet and ReadCurveSet would interpret a file.
bool TextHoldsCurveSet(const DecodedText& text, const std::string& path,
                       const ReadOptions& options);
Expected<CurveSet> CurveSetOfFile(const DecodedText& text, const std::string& path,
                                  const ReadOptions& options);

}  // namespace lyrefit

#pragma once

#include <cstdint>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// A UTF-8 text and a remark on its decoding.
struct DecodedText {
  std::string text;
  std::string remark;             // sentence on the decoding; empty if the bytes were UTF-8
  Setup setup = Setup::kUnknown;  // of the measurement, where the layout tells it
};

// Converts to UTF-8 from UTF-8 or UTF-16 of either byte order, with or without a byte order mark.
// Other text is read as Windows-1252, which includes Latin-1. Errors: no content; binary content
// (zero bytes, a zip archive such as an Excel workbook). `path` is only used in errors.
Expected<DecodedText> DecodeText(std::string bytes, const std::string& path);

// Reads and converts a file of at most `largest_bytes`.
Expected<DecodedText> ReadDecodedFile(const std::string& path, std::uintmax_t largest_bytes);

}  // namespace lyrefit

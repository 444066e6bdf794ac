#pragma once

#include <cstdint>
#include <string>

#include "lyrefit/base/error.h"

namespace lyrefit {

// A text in UTF-8 and how it came to be.
struct DecodedText {
  std::string text;
  std::string remark;  // plain sentence on the decoding; empty where the bytes were UTF-8
};

// Makes UTF-8 of what programs write: UTF-8 with or without a byte order mark, UTF-16 of either
// byte order with or without one, else Windows-1252, of which Latin-1 is a part. Errors: nothing in
// it, or no text (zero bytes, a zip archive such as an Excel workbook); `path` is only for them.
Expected<DecodedText> DecodeText(std::string bytes, const std::string& path);

// The same for a file of at most `largest_bytes`.
Expected<DecodedText> ReadDecodedFile(const std::string& path, std::uintmax_t largest_bytes);

}  // namespace lyrefit

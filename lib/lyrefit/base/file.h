#pragma once

#include <cstdint>
#include <string>

#include "lyrefit/base/error.h"

namespace lyrefit {

// The whole file as text. Refuses what is missing, a folder, unreadable, larger than
// `largest_bytes`, empty, or binary (holds a NUL byte); strips a UTF-8 byte order mark.
Expected<std::string> ReadTextFile(const std::string& path, std::uintmax_t largest_bytes);

// Writes all of `text` or nothing: into a temporary file beside `path`, renamed when complete.
Expected<void> WriteTextFile(const std::string& path, const std::string& text);

}  // namespace lyrefit

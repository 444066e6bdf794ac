#pragma once

#include <cstdint>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// The whole file as it is. Refuses what is missing, a folder, unreadable or larger than
// `largest_bytes`.
Expected<std::string> ReadFileBytes(const std::string& path, std::uintmax_t largest_bytes);

// The whole file as text. Refuses what is missing, a folder, unreadable, larger than
// `largest_bytes`, empty, or binary (holds a NUL byte); strips a UTF-8 byte order mark.
Expected<std::string> ReadTextFile(const std::string& path, std::uintmax_t largest_bytes);

// Writes all of `text` or nothing: into a file that has no name until it is complete, so that
// nothing is left of it if the process is killed. Where the file system knows no such files, into
// NAME.PID-COUNT.tmp beside `path`; the next one to write `path` removes what dead processes left.
// A full disk or a limit of the file size is an error that leaves the old file as it was.
Expected<void> WriteTextFile(const std::string& path, const std::string& text);

}  // namespace lyrefit

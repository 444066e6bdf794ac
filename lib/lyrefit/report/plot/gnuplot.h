#pragma once

#include <string>

#include "lyrefit/base/error.h"

namespace lyrefit {

// Runs gnuplot on `script` and returns the picture, which the script must leave on standard output.
// Reads no start-up files. Fails where gnuplot is not installed or does not understand the script.
Expected<std::string> RunGnuplot(const std::string& script);

}  // namespace lyrefit

// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <string_view>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// A text as valid UTF-8: each byte that is not UTF-8 becomes U+FFFD. Names are read from files and
// may contain any bytes.
std::string Readable(std::string_view text);

}  // namespace lyrefit

#pragma once

#include <string>
#include <string_view>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// A text as UTF-8. Names come from files, and files hold anything: a byte that is no UTF-8 becomes
// U+FFFD.
std::string Readable(std::string_view text);

}  // namespace lyrefit

#pragma once

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// "0.1.0", the version of the project in CMakeLists.txt.
const char* Version();

}  // namespace lyrefit

#pragma once

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// The project's version in CMakeLists.txt, such as "1.0.0".
const char* Version();

}  // namespace lyrefit

#pragma once

namespace lyrefit {

// "0.1.0", the version of the project in CMakeLists.txt.
const char* Version();

}  // namespace lyrefit

#include "lyrefit/base/version.h"

namespace lyrefit {

const char* Version() { return LYREFIT_VERSION; }

}  // namespace lyrefit

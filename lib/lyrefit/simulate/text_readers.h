// Experimental: may change in a minor version (data/stable).
#pragma once

#include "lyrefit/base/public.h"
#include "lyrefit/estimate/fit/text_readers.h"

namespace LYREFIT_PUBLIC lyrefit {

// The readers of this library: effects of the catalogue (effects/catalogue.h), files of error sizes
// (error_file.h).
const TextReaders& AllTextReaders();

}  // namespace lyrefit

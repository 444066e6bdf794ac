// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

struct EffectUse;
struct ErrorSpec;

// Functions that read the texts of options which need more than the core: a file or the catalogue of
// effects. OptionText::read receives them; simulate/text_readers.h has those of the library.
struct TextReaders {
  // "shading:d=0.3,w=0.2:0.4". Errors: no such effect, a malformed text.
  Expected<EffectUse> (*effect)(const std::string& text);
  // "white", "field" or the path of a file. Errors: those of the file.
  Expected<ErrorSpec> (*errors)(const std::string& name);
};

}  // namespace lyrefit

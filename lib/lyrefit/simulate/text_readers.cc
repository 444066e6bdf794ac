#include "lyrefit/simulate/text_readers.h"

#include "lyrefit/settings/error_file.h"
#include "lyrefit/effects/read_effect_use.h"

namespace lyrefit {

const TextReaders& AllTextReaders() {
  static constexpr TextReaders kReaders{&ReadEffectUse, &ErrorsNamed};
  return kReaders;
}

}  // namespace lyrefit

#include "lyrefit/simulate/text_readers.h"

#include "lyrefit/effects/catalogue.h"
#include "lyrefit/settings/error_file.h"

namespace lyrefit {

const TextReaders& AllTextReaders() {
  static constexpr TextReaders kReaders{&ReadEffectUse, &ErrorsNamed};
  return kReaders;
}

}  // namespace lyrefit

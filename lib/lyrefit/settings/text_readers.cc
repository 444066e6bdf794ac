#include "lyrefit/settings/text_readers.h"

#include "lyrefit/settings/error_file.h"
#include "lyrefit/settings/read_effect_use.h"

namespace lyrefit {

const TextReaders& AllTextReaders() {
  static constexpr TextReaders kReaders{&ReadEffectUse, &ErrorsNamed};
  return kReaders;
}

}  // namespace lyrefit

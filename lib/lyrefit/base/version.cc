#include "lyrefit/base/version.h"

#include "lyrefit/base/address.h"

namespace lyrefit {

const char* Version() { return LYREFIT_VERSION; }

const Addresses& PublishedAt() {
  static constexpr Addresses kAddresses{LYREFIT_ADDRESS, LYREFIT_SOURCE, LYREFIT_SITE,
                                        LYREFIT_RELEASES, LYREFIT_TRACKER};
  return kAddresses;
}

}  // namespace lyrefit

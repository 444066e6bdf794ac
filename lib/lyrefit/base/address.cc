#include "lyrefit/base/address.h"

namespace lyrefit {

const Addresses& PublishedAt() {
  static constexpr Addresses kAddresses{LYREFIT_ADDRESS, LYREFIT_SOURCE, LYREFIT_SITE,
                                        LYREFIT_RELEASES, LYREFIT_TRACKER};
  return kAddresses;
}

}  // namespace lyrefit

#pragma once

#include "lyrefit/certify/certify.h"
#include "lyrefit/read/read_curve.h"

namespace lyrefit {

// The certificate of the RTC France cell with n in [1, 2]; computed once, in some hundredths of a
// second.
inline const Certificate& RtcCertificate() {
  static const Certificate certificate =
      *Certify(*ReadCurve(std::string(LYREFIT_DATA_DIR) + "/rtc_france"));
  return certificate;
}

}  // namespace lyrefit

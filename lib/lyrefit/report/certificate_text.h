#pragma once

#include <string>

#include "lyrefit/certify/certify.h"

namespace lyrefit {

// A certificate for a terminal of 100 columns: what was asked, the floor and the diodes that attain
// it, what proves it, and how each model stands. Ends with a newline.
std::string CertificateText(const Certificate& certificate);

// One line: the floor, and each model's RMSE with its gap.
std::string BriefCertificate(const Certificate& certificate);

}  // namespace lyrefit

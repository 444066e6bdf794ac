#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/certify/certify.h"
#include "lyrefit/report/plot/figure.h"

namespace lyrefit {

// The proof of the floor: over n the cosine between the dual vector and a diode's column, which is
// zero at the diodes of the floor and above zero nowhere.
Figure CertificateFigure(const Certificate& certificate);

// Draws it into `path`, a .svg or .png file. Errors as of DrawFigure.
Expected<void> PlotCertificate(const Certificate& certificate, const std::string& path);

}  // namespace lyrefit

#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/certify/certify.h"

namespace lyrefit {

// Draws the proof of the floor into `path`, a .svg or .png file: over n the cosine between the dual
// vector and a diode's column, which is zero at the diodes of the floor and above zero nowhere.
// Errors as of PlotFit.
Expected<void> PlotCertificate(const Certificate& certificate, const std::string& path);

}  // namespace lyrefit

// Experimental: may change in a minor version (data/stable).
#pragma once

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/translate/translate_options.h"
#include "lyrefit/translate/translation_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// Translates a measured curve by every procedure that the data allow, with the uncertainty of its
// key points, and recommends one of them (recommend.h). A procedure that cannot be computed has its
// reason in `why_not`. Errors: an invalid or dark curve, readings that end before maximum power,
// unknown irradiance or temperature, options outside their ranges, implausible coefficients, an
// invalid rating.
Expected<TranslationReport> TranslateCurve(const IvCurve& given, const TranslateOptions& asked = {},
                                           const Observer& observer = {});

}  // namespace lyrefit

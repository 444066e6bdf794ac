#pragma once

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/translate/translate_options.h"
#include "lyrefit/translate/translation_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// A measured curve at other conditions by every procedure that the data allow, side by side, each
// with the uncertainty of its key points; one of them is recommended (recommend.h). Procedures that
// cannot be computed say why.
// Errors: an unusable or dark curve, one that ends before its maximum power, irradiance or temperature
// that nobody stated, options outside their ranges, coefficients that no device has, a rating that is
// none.
Expected<TranslationReport> TranslateCurve(const IvCurve& curve,
                                           const TranslateOptions& options = {},
                                           const Observer& observer = {});

}  // namespace lyrefit

#pragma once

// The public header of lyrefit: what reading, fitting, simulating, certifying and diagnosing I-V
// curves takes, and how to write what came out.
//
//   #include <iostream>
//   #include "lyrefit/lyrefit.h"
//
//   int main() {
//     const auto curve = lyrefit::ReadCurve("data/rtc_france");
//     if (!curve) return std::cerr << curve.error().ToString() << '\n', 1;
//     const auto report = lyrefit::Fit(*curve);
//     if (!report) return std::cerr << report.error().ToString() << '\n', 1;
//     std::cout << lyrefit::FullReport(*report);
//   }
//
// Nothing here throws or prints: a mistake in a file or an option comes back as an Error with one
// sentence, a search or polish that ended badly is part of the report. FitOptions says what can be
// chosen, FitReport what is known afterwards. FitAuto chooses among one, two and three diodes.
// FitFamily fits one device to curves under different irradiance and temperature. Certify proves
// how low a curve's RMSE can go. FitDataSheet finds a device from a data sheet alone, and the family
// that it is one of. Diagnose says what the model gets wrong in a measurement and why.
// TranslateCurve carries a curve to standard or any conditions, with its uncertainty. FitDocument,
// FamilyDocument and their kin are the reports as data, for DrawText, DrawMarkdown and DrawHtml.
//
// Beside it: family/pvlib_parameters.h hands a device to pvlib, family/fit_individually.h fits every curve
// of a set on its own, certify/cause_floor.h and certify/concave_floor.h prove how low a cause can
// bring it, diagnose/reference.h holds a sweep against reference sweeps of the same module,
// and study.h (another library, lyrefit::study) compares searches and checks publications.

#include "lyrefit/certify/certify.h"
#include "lyrefit/curve/read_curve.h"
#include "lyrefit/curve/write_curve.h"
#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/family/data_sheet.h"
#include "lyrefit/family/fit_family.h"
#include "lyrefit/fit/fit.h"
#include "lyrefit/fit/simulate.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/report/plots.h"
#include "lyrefit/translate/translate.h"

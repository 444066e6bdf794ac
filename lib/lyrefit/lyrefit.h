#pragma once

// The beginner's door to lyrefit: everything that reading, fitting, simulating, certifying,
// comparing and diagnosing I-V curves takes.
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
// FitFamily fits one device to curves under different irradiance and temperature.
// Certify proves how low a curve's RMSE can go, Compare runs searches (yours as well) against each
// other, Audit checks published parameters. FitDataSheet finds a device from a data sheet alone,
// PvlibParameters hands one to pvlib. Diagnose says what the model gets wrong in a measurement and
// why.

#include "lyrefit/certify/certify.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/nearest_curve.h"
#include "lyrefit/curve/read_curve.h"
#include "lyrefit/curve/write_curve.h"
#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/diagnose/healthy.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/family/coefficients.h"
#include "lyrefit/family/data_sheet.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/family/fit_family.h"
#include "lyrefit/family/fit_free.h"
#include "lyrefit/family/pvlib_parameters.h"
#include "lyrefit/family/read_pvlib.h"
#include "lyrefit/fit/fit.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/fit/simulate.h"
#include "lyrefit/law/translation.h"
#include "lyrefit/report/audit_csv.h"
#include "lyrefit/report/audit_json.h"
#include "lyrefit/report/audit_text.h"
#include "lyrefit/report/certificate_plot.h"
#include "lyrefit/report/certificate_text.h"
#include "lyrefit/report/compare_csv.h"
#include "lyrefit/report/compare_json.h"
#include "lyrefit/report/compare_plot.h"
#include "lyrefit/report/compare_text.h"
#include "lyrefit/report/data_sheet_text.h"
#include "lyrefit/report/diagnosis_plot.h"
#include "lyrefit/report/diagnosis_text.h"
#include "lyrefit/report/family_csv.h"
#include "lyrefit/report/family_plot.h"
#include "lyrefit/report/family_text.h"
#include "lyrefit/report/healthy_text.h"
#include "lyrefit/report/json.h"
#include "lyrefit/report/plot.h"
#include "lyrefit/report/text_report.h"
#include "lyrefit/study/audit.h"
#include "lyrefit/study/compare.h"

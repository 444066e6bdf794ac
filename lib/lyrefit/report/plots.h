#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/report/figure.h"

// The pictures of the records: a function that makes the figure, which is data, and one that draws
// it into `path`, a .svg or .png file, with the errors of DrawFigure.
namespace LYREFIT_PUBLIC lyrefit {

struct Certificate;
struct CurveSet;
struct DataSheetFit;
struct Diagnosis;
struct FamilyReport;
struct FitReport;
struct TranslationReport;

// A fit: above, current and power over voltage, measured points and the model; below, the residuals
// with a band of +- the solved-current RMSE.
Figure FitFigure(const FitReport& report);
Expected<void> PlotFit(const FitReport& report, const std::string& path,
                       PlotPoints points = PlotPoints::kThinned);

// The fit of `set`, coloured by cell temperature: measured points and model of up to twelve curves
// spread over the irradiances; over irradiance, the RMSE of each curve and its mean residual.
Figure FamilyFigure(const FamilyReport& report, const CurveSet& set);
Expected<void> PlotFamily(const FamilyReport& report, const CurveSet& set, const std::string& path,
                          PlotPoints points = PlotPoints::kThinned);

// The diagnosis, coloured by curve, or by direction where one curve was swept both ways: measured
// points, base model and the model with its causes; below, what either leaves, in % of Isc. Where a
// cause acts most there is a band of its colour and its title stands beneath.
Figure DiagnosisFigure(const Diagnosis& diagnosis);
Expected<void> PlotDiagnosis(const Diagnosis& diagnosis, const std::string& path,
                             PlotPoints points = PlotPoints::kThinned);

// The proof of the floor: over n the cosine between the dual vector and a diode's column, which is
// zero at the diodes of the floor and above zero nowhere.
Figure CertificateFigure(const Certificate& certificate);
Expected<void> PlotCertificate(const Certificate& certificate, const std::string& path);

// The family of a data sheet: above, over voltage, curves of members and how far they are from that
// of the member that beta_oc picks, and over n what becomes of the power; below, over n, beta_oc and
// the parameters. A band holds the n that the rounding of the sheet allows.
Figure DataSheetFigure(const DataSheetFit& fit);
Expected<void> PlotDataSheet(const DataSheetFit& fit, const std::string& path);

// A curve at other conditions: the readings and what each procedure makes of them, the recommended
// one drawn thick; the maximum power points are marked.
Figure TranslationFigure(const TranslationReport& report);
Expected<void> PlotTranslation(const TranslationReport& report, const std::string& path,
                               PlotPoints points = PlotPoints::kThinned);

}  // namespace lyrefit

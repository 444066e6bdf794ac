// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/report/figure.h"

// Pictures of the records. One function makes the figure, which is data; another draws it into
// `path`, a .svg or .png file, with the errors of DrawFigure.
namespace LYREFIT_PUBLIC lyrefit {

struct CellReport;
struct Certificate;
struct CurveSet;
struct DataSheetFit;
struct Diagnosis;
struct FamilyReport;
struct FitReport;
struct TranslationReport;
struct TrendReport;
struct TwoJunctionReport;

// A fit. Above: current and power over voltage, measured points and model. Below: residuals with a
// band of +- the solved-current RMSE.
Figure FitFigure(const FitReport& report);
Expected<void> PlotFit(const FitReport& report, const std::string& path,
                       PlotPoints points = PlotPoints::kThinned);

// A family fit of `set`, coloured by cell temperature. Measured points and model of up to twelve
// curves spread over the irradiances; RMSE and mean residual of each curve over irradiance.
Figure FamilyFigure(const FamilyReport& report, const CurveSet& set);
Expected<void> PlotFamily(const FamilyReport& report, const CurveSet& set, const std::string& path,
                          PlotPoints points = PlotPoints::kThinned);

// A fit of two junctions: measured points and model of every curve, and residuals.
Figure TwoJunctionFigure(const TwoJunctionReport& report);
Expected<void> PlotTwoJunctions(const TwoJunctionReport& report, const std::string& path,
                                PlotPoints points = PlotPoints::kThinned);

// A diagnosis, coloured by curve, or by direction if one curve was swept both ways. Above: measured
// points, base model and the model with causes. Below: the residuals of both in % of Isc. A band in
// the cause's colour marks where it acts most, with its title below.
Figure DiagnosisFigure(const Diagnosis& diagnosis);
Expected<void> PlotDiagnosis(const Diagnosis& diagnosis, const std::string& path,
                             PlotPoints points = PlotPoints::kThinned);

// The proof of the floor: the cosine between the dual vector and a diode's column over n, which is
// zero at the diodes of the floor and positive nowhere.
Figure CertificateFigure(const Certificate& certificate);
Expected<void> PlotCertificate(const Certificate& certificate, const std::string& path);

// A laboratory cell: its lit curves, open-circuit voltages over light with the junction's n, the
// dark curve, and for each brightest lit sweep the fill factor from the ideal to the measured one.
Figure CellFigure(const CellReport& report);
Expected<void> PlotCell(const CellReport& report, const std::string& path,
                        PlotPoints points = PlotPoints::kThinned);

// The family of devices of a data sheet. Above: over voltage, curves of members and their
// differences from the member selected by beta_oc; over n, the powers. Below: over n, beta_oc and
// the parameters. A band marks the n allowed by the rounding of the sheet.
Figure DataSheetFigure(const DataSheetFit& fit);
Expected<void> PlotDataSheet(const DataSheetFit& fit, const std::string& path);

// A translated curve: the readings and the result of each procedure, the recommended one as a thick
// line; maximum power points are marked.
Figure TranslationFigure(const TranslationReport& report);
Expected<void> PlotTranslation(const TranslationReport& report, const std::string& path,
                               PlotPoints points = PlotPoints::kThinned);

// A trend: the daily losses by part, then every quantity with its regression and the days of its
// changes.
Figure TrendFigure(const TrendReport& report);
Expected<void> PlotTrend(const TrendReport& report, const std::string& path,
                         PlotPoints points = PlotPoints::kThinned);

}  // namespace lyrefit

// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/devices/cell_report.h"
#include "lyrefit/devices/data_sheet.h"
#include "lyrefit/devices/fit_two_junctions.h"
#include "lyrefit/report/document.h"
#include "lyrefit/report/figure.h"

// Laboratory cells, two junctions and data sheets as documents, as text, JSON, CSV and pictures. The
// conventions are those of report/documents.h, json.h, csv.h and plots.h.
namespace LYREFIT_PUBLIC lyrefit {

// A fit of two junctions: parameters, which measurement would decide those that are not
// identifiable, and every curve with its light and the junction that limits.
Document TwoJunctionDocument(const TwoJunctionReport& report);
std::string TwoJunctionText(const TwoJunctionReport& report, Length length = Length::kWhole);
std::string BriefTwoJunctions(const TwoJunctionReport& report);

// A laboratory cell: sweeps, hysteresis, ideality, series resistance, losses of the fill factor,
// superposition. The brief text has its main figures.
Document CellDocument(const CellReport& report);
std::string CellText(const CellReport& report, Length length = Length::kWhole);
std::string BriefCell(const CellReport& report);

// The device fitted to a data sheet, and its values beside the printed ones.
Document DataSheetDocument(const DataSheetFit& fit);
std::string DataSheetText(const DataSheetFit& fit);

// Parameters and curves of a fit of two junctions. Every RMSE is a pair; its measured current is
// null. The light of a curve that is not stated is null.
std::string TwoJunctionJson(const TwoJunctionReport& report);

// A laboratory cell. `main`, `sweep`, `lit`, `dark`, `forward` and `reverse` are indices into
// `sweeps`. Parameters of a fit have the interval to believe, and `covariance` is in their order.
std::string CellJson(const CellReport& report);

// The fitted parameters, and each check: the stated value beside that of the device.
std::string DataSheetJson(const DataSheetFit& fit);

// One row for each sweep of a cell, with its figures; n, Rs_ohm and Rsh_ohm are those of the fit and
// empty where they are void.
std::string CellCsv(const CellReport& report);

// One row for each parameter.
std::string DataSheetCsv(const DataSheetFit& fit);

// A fit of two junctions: measured points and model of every curve, and residuals.
Figure TwoJunctionFigure(const TwoJunctionReport& report);
Expected<void> PlotTwoJunctions(const TwoJunctionReport& report, const std::string& path,
                                PlotPoints points = PlotPoints::kThinned);

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

}  // namespace lyrefit

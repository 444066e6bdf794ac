#pragma once

#include <string>
#include <vector>

#include "lyrefit/devices/cell_report.h"
#include "lyrefit/report/document.h"

// Functions shared by the document, tables and pictures of a cell.

namespace lyrefit {

// cell_verdict.cc: the result in a few sentences: efficiency, hysteresis, ideality, largest loss of fill factor.
std::string CellVerdict(const CellReport& report);

// cell_sections.cc: the resistances, the fill factor and its losses, superposition.
Section SeriesResistanceSection(const CellReport& report);
Section FillFactorSection(const CellReport& report);
Section SuperpositionSection(const CellReport& report);
// cell_sections.cc: one model for all measurements, and what each of them adds.
Section JointSection(const CellReport& report);

// A lit sweep of a series over hours, in parts of the first one of its direction and light.
struct HourRow {
  int sweep;  // index into CellReport::sweeps
  double hours;
  double since_h;  // the first one
  double voc;
  double isc;
  double ff;
  double power;
};

// The series by rising hours; empty: all sweeps are of one time, or none is known.
std::vector<HourRow> RowsOfHours(const CellReport& report);

// ", as a lit cell 2 K warmer than the dark one makes it"; empty: the joint estimate needs none.
std::string WarmthText(const CellReport& report);

// "12.3 %" of a fraction; "-" for NaN.
std::string PercentText(double fraction, int digits = 3);
// "1.52 (1.48 .. 1.56)"; without an interval the value alone, "-" for NaN.
std::string RangedText(const Ranged& ranged, int digits = 4);

// cell_plot.cc: the picture for pages.
block::Figure FigureBlock(const CellReport& report);

// A number that tables have of one sweep of a cell.
struct CellField {
  const char* name;  // of its column
  const char* unit;
  const char* doc;
  double (*value)(const CellSweep& sweep);  // NaN: unknown, or void
};

// Key points, resistances and the fit's parameters of a sweep, in the order of the columns.
const std::vector<CellField>& CellFields();

// Why n and Rs of the fit of a sweep are void, joined with "; ".
std::string VoidReasons(const CellSweep& sweep);

}  // namespace lyrefit

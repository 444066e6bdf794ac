#pragma once

#include <string>

#include "lyrefit/devices/data_sheet.h"
#include "lyrefit/report/document.h"

// Functions shared by the document and the picture of a data sheet.
namespace lyrefit {

// data_sheet_plot.cc: the picture of a data-sheet fit. data_sheet_document.cc: a table of some
// members by rising n.
block::Figure FigureBlock(const DataSheetFit& fit);
block::Table MemberTable(const DataSheetFit& fit);
// Conditions that differ from the reference: "200 W/m2", "50 C".
std::string ConditionsText(const MemberConditions& at);

}  // namespace lyrefit

#pragma once
// Functions shared by the document and the picture of a data sheet.

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/devices/data_sheet.h"
#include "lyrefit/devices/data_sheet_family.h"
#include "lyrefit/family/key_point_solver.h"
#include "lyrefit/model/translation.h"
#include "lyrefit/report/document.h"

namespace lyrefit {

// data_sheet_plot.cc: the picture of a data-sheet fit. data_sheet_document.cc: a table of some
// members by rising n.
block::Figure FigureBlock(const DataSheetFit& fit);
block::Table MemberTable(const DataSheetFit& fit);
// Conditions that differ from the reference: "200 W/m2", "50 C".
std::string ConditionsText(const MemberConditions& at);

// A sheet with the translation and the equations that find its members and translate them to other
// conditions.
struct SheetSolver {
  const DataSheet& sheet;
  Translation translation;  // De Soto, one diode
  KeyPointSheet points;
};

ReferenceDevice DeviceOf(const DataSheetMember& member);

// The family of a sheet, with the member `device` that beta_oc selects. Adds the members at
// `lowest_n` and `highest_n`, the range of n that the rounding allows, clipped to the family. Adds
// none if both ends are equal.
Expected<DataSheetFamily> FamilyOfSheet(const DataSheet& sheet, ConstantSet constants,
                                        const ReferenceDevice& device, double lowest_n,
                                        double highest_n);

}  // namespace lyrefit

#pragma once

#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/family/data_sheet.h"
#include "lyrefit/family/data_sheet_family.h"
#include "lyrefit/family/key_point_curve.h"
#include "lyrefit/law/translation.h"

namespace lyrefit {

// A sheet with what its members are solved and carried to other conditions with.
struct SheetSolver {
  const DataSheet& sheet;
  Translation translation;  // De Soto, one diode
  KeyPointSheet points;
};

ReferenceDevice DeviceOf(const DataSheetMember& member);

// The family with the member that beta_oc picks, which is `device`, and those at the ends of the n
// that the rounding allows, as far as they are members: none if the ends are the same.
Expected<DataSheetFamily> FamilyOfSheet(const DataSheet& sheet, ConstantSet constants,
                                        const ReferenceDevice& device, double lowest_n,
                                        double highest_n);

}  // namespace lyrefit

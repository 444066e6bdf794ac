#pragma once

#include <string>

#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// What stands on a page that somebody signs and no curve says of itself. Nothing is computed from
// it: a calibration counts by the options of UncertaintyOptions.
struct FieldNotes {
  std::string tracer;
  std::string serial;
  std::string calibration;
  std::string operated_by;
  std::string remark;
};

inline constexpr OptionRow<FieldNotes> kFieldNotesTable[] = {
    OptionRow<FieldNotes>("Printed on the page"),
    {"tracer", "TEXT", "the instrument, as it is called", &FieldNotes::tracer},
    {"serial", "TEXT", "its serial number", &FieldNotes::serial},
    {"calibration", "TEXT", "its calibration: certificate, date", &FieldNotes::calibration},
    {"operator", "TEXT", "who measured", &FieldNotes::operated_by},
    {"remark", "TEXT", "whatever else is to be read on the page", &FieldNotes::remark},
};

}  // namespace lyrefit

// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Notes of the operator for the printed page. They enter no computation: the uncertainty of a
// calibration is set in UncertaintyOptions.
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

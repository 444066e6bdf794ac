// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/read/module_sheet.h"
#include "lyrefit/read/read_pvlib.h"

namespace LYREFIT_PUBLIC lyrefit {

// Module files of other programs. The content decides, not the ending of the name:
//
//   JSON                          pvlib's parameters, see ReadPvlibParameters
//   PVObject_=pvModule ...        a PVsyst .PAN file: its electrical part, see read_pan.h
//   Name,...,a_ref,... (CSV)      SAM's library of CEC modules, or some rows of it, see
//                                 cec_library.h; FILE#NAME is the module NAME of several
//
// Text is UTF-8, UTF-16 or Windows-1252.

// Reads the shared parameters of a module. Errors, with line and column if known: none of these
// files; what the reader of each refuses.
Expected<NamedParameters> ReadModuleParameters(const std::string& file);

// Reads the data sheet that a module file repeats: of a .PAN file, of a row of SAM's library, or of
// the key "cec" in the JSON that PvlibJson writes. Values that the file does not state are NaN.
Expected<ModuleSheet> ReadModuleSheet(const std::string& file);

// Whether a file holds a module rather than a fit report. Errors: an unreadable file.
Expected<bool> HoldsModule(const std::string& file);

// The file in FILE#NAME; `file` itself if there is a file of that name, or no "#".
std::string FileOfModule(const std::string& file);

}  // namespace lyrefit

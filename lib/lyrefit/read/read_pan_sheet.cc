#include <cmath>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/data_sheet_values.h"
#include "lyrefit/read/pan_values.h"
#include "lyrefit/read/read_pan.h"

namespace lyrefit {

Expected<ModuleSheet> ReadPanSheet(const std::string& text, const std::string& path) {
  TRY(const PanObject pan, ParsePan(text, path));
  TRY(CheckPanReference(pan));
  ModuleSheet module;
  module.name = NameOfPan(pan);
  module.technology = pan.Text("Technol");
  DataSheet& sheet = module.sheet;
  TRY(sheet.cells_in_series, TakePanCells(pan));
  TRY(const PanPoints p, TakePanPoints(pan));
  TRY(const double alpha, TakeCurrentTempco(pan, p.isc));
  TRY(const double beta, TakeVoltageTempco(pan, p.voc));
  sheet.values = {p.isc, p.voc, p.imp, p.vmp, alpha, beta};
  const auto half = [&](const char* key) { return HalfUnit(pan.Text(key)); };
  sheet.half_unit = {half("Isc"),          half("Voc"),
                     half("Imp"),          half("Vmp"),
                     1e-3 * half("muISC"), std::isnan(beta) ? 0 : 1e-3 * half("muVocSpec")};
  TRY(sheet.gamma_pmp_percent_K, TakePowerTempco(pan));
  TRY(module.rated_power_W, pan.Number({"PNom", "a power in W", 0}));
  if (const auto fits = CheckDataSheetPoints(sheet.values); !fits) {
    return Fail(fits.error().message, path);
  }
  return module;
}

}  // namespace lyrefit

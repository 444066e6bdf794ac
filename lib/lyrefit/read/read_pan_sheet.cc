#include <fmt/format.h>

#include <cmath>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/data_sheet_values.h"
#include "lyrefit/model/coefficients.h"
#include "lyrefit/read/pan_values.h"
#include "lyrefit/read/read_pan.h"

namespace lyrefit {

Expected<ModuleSheet> ReadPanSheet(const std::string& text, const std::string& path) {
  TRY(const PanObject pan, ParsePan(text, path));
  TRY(CheckPanReference(pan));
  ModuleSheet module;
  module.name = NameOfPan(pan);
  DataSheet& sheet = module.sheet;
  sheet.technology = pan.Text("Technol");
  TRY(sheet.cells_in_series, TakePanCells(pan));
  TRY(const PanPoints p, TakePanPoints(pan));
  TRY(const double alpha, TakeCurrentTempco(pan, p.isc));
  TRY(double beta, TakeVoltageTempco(pan, p.voc));
  const bool stated = !std::isnan(beta);
  const auto model = ReadPanParameters(text, path);
  module.has_model = model.has_value();
  if (!stated && model) {
    beta = CoefficientsAtReference(model->translation, model->shared).beta_oc_V_K;
    module.assumptions.push_back(fmt::format(
        "muVocSpec is not stated: beta_oc of {:.4g} V/K is that of the file's own model (RSerie, "
        "RShunt, Gamma, muGamma)",
        beta));
  }
  sheet.values = {p.isc, p.voc, p.imp, p.vmp, alpha, beta};
  const auto half = [&](const char* key) { return HalfUnit(pan.Text(key)); };
  sheet.half_unit = {half("Isc"), half("Voc"),          half("Imp"),
                     half("Vmp"), 1e-3 * half("muISC"), stated ? 1e-3 * half("muVocSpec") : 0};
  TRY(sheet.gamma_pmp_percent_K, TakePowerTempco(pan));
  TRY(module.rated_power_W, pan.Number({"PNom", "a power in W", 0}));
  if (const auto fits = CheckDataSheetPoints(sheet.values); !fits) {
    return Fail(fits.error().message, path);
  }
  return module;
}

}  // namespace lyrefit

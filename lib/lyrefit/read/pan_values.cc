#include "lyrefit/read/pan_values.h"

#include <fmt/format.h>

#include <cmath>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"
#include "lyrefit/model/translation.h"

namespace lyrefit {
namespace {

constexpr double kMostPanCells = 100000;
// Relative to Isc and Voc. Values in other units are beyond: a muISC in uA/K, a muVocSpec in %/K.
constexpr double kLargestTempco_1_K = 0.005;
constexpr double kSmallestVocTempco_1_K = 1e-4;
constexpr double kLargestVocTempco_1_K = 0.01;

}  // namespace

Expected<PanPoints> TakePanPoints(const PanObject& pan) {
  PanPoints p = {};
  TRY(p.isc, pan.Required({"Isc", "a current in A", 0}));
  TRY(p.voc, pan.Required({"Voc", "a voltage in V", 0}));
  TRY(p.imp, pan.Required({"Imp", "a current in A", 0}));
  TRY(p.vmp, pan.Required({"Vmp", "a voltage in V", 0}));
  if (p.imp >= p.isc) return pan.Refuse(*pan.Find("Imp"), "a current below Isc");
  if (p.vmp >= p.voc) return pan.Refuse(*pan.Find("Vmp"), "a voltage below Voc");
  return p;
}

Expected<int> TakePanCells(const PanObject& pan) {
  const PanNumber cells = {"NCelS", "a number of cells in series", 1, false, kMostPanCells};
  TRY(const double found, pan.Required(cells));
  if (found != std::floor(found)) return pan.Refuse(*pan.Find("NCelS"), "a whole number of cells");
  return static_cast<int>(found);
}

Expected<void> CheckPanReference(const PanObject& pan) {
  const struct {
    const char* key;
    double ours;
    const char* expected;
  } references[] = {{"GRef", kReferenceIrradiance_W_m2, "the reference 1000 W/m2"},
                    {"TRef", kReferenceTemperature_C, "the reference 25 C"}};
  for (const auto& [key, ours, expected] : references) {
    TRY(const auto found, pan.Number({key, expected}));
    if (found && *found != ours) return pan.Refuse(*pan.Find(key), expected);
  }
  return {};
}

Expected<double> TakeCurrentTempco(const PanObject& pan, double isc_A) {
  const double most = 1e3 * kLargestTempco_1_K * isc_A;
  return pan.Required({"muISC", "a coefficient in mA/K", -most, false, most})
      .map([](double milliampere) { return 1e-3 * milliampere; });
}

Expected<double> TakeVoltageTempco(const PanObject& pan, double voc_V) {
  const std::string expected = "a negative coefficient in mV/K";
  TRY(const auto found, pan.Number({"muVocSpec", expected.c_str()}));
  if (!found || *found == 0) return kUnknown;
  const double relative_1_K = -1e-3 * *found / voc_V;
  if (relative_1_K > kSmallestVocTempco_1_K && relative_1_K < kLargestVocTempco_1_K) {
    return 1e-3 * *found;
  }
  return pan.Refuse(*pan.Find("muVocSpec"),
                    fmt::format("{} of a Voc of {:g} V, not in percent", expected, voc_V));
}

Expected<std::optional<double>> TakePowerTempco(const PanObject& pan) {
  TRY(const auto found, pan.Number({"muPmpReq", "a coefficient in %/K", -2, false, 2}));
  return found && *found != 0 ? found : std::nullopt;
}

std::string NameOfPan(const PanObject& pan) {
  const std::string maker = pan.Text("Manufacturer"), model = pan.Text("Model");
  return maker + (maker.empty() || model.empty() ? "" : " ") + model;
}

}  // namespace lyrefit

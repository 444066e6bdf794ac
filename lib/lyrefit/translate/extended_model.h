#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/law/device.h"
#include "lyrefit/translate/procedures.h"

namespace lyrefit {

// The device that a diagnosis found, without what belongs to the sweep: light that stepped or
// drifted, offsets and ranges of the instrument, wrong sensors. What is in the device (shade, low
// shunt, weak cells, a second diode) acts at the target as it did in the light of the sweep. The
// diodes follow light and temperature by De Soto's law. Of the shunt, as much as healthy modules have
// (Voc / (25 Isc); half of it beside a leak) is in proportion to 1 / G, as De Soto has it; what leaks
// more is ohmic, constant.
struct ExtendedModel {
  Device device;                   // with the causes that stay, its law at (G1, T1)
  std::vector<double> parameters;  // in its order and its numbers
  double source_irradiance_W_m2 = 0;
  double source_temperature_C = 25;
  int cells_in_series = 1;
  double healthy_shunt_S = 0;         // largest conductance that goes with the light
  std::vector<std::string> kept;      // titles of causes
  std::vector<std::string> removed;   // the same of those taken out
  std::optional<BetaAnchor> bandgap;  // of its first diode; none: as stated
  std::string cause;                  // id of the first one, what alternatives differ in
};

// `inputs` as settled; `anchored`: the band gap is such that Voc moves by beta.
struct ExtendedInputs {
  TranslationInputs inputs;
  bool anchored = true;
};

// Of a diagnosis with DiagnoseOptions::extend. Errors: an extended model that is not usable, of
// several curves, a law that does not stand without what is taken out.
Expected<std::shared_ptr<const ExtendedModel>> MakeExtendedModel(const IvCurve& curve,
                                                                 const Diagnosis& diagnosis,
                                                                 const ExtendedInputs& inputs);

// The same of a fit with effects: one more name for what was found.
Expected<std::shared_ptr<const ExtendedModel>> MakeExtendedModel(const IvCurve& curve,
                                                                 const FitReport& fit,
                                                                 const ExtendedInputs& inputs);

// Key points at the target. Where nothing was taken out of the readings, theirs times model at the
// target / model at the source, as DiodeKeyPoints has it; else the model's own.
Expected<KeyPoints> ExtendedKeyPoints(const PreparedCurve& curve, const TranslationInputs& inputs,
                                      int alternative);

// 400 even points at the target, from short circuit to beyond open circuit.
Expected<CurvePoints> ExtendedPoints(const PreparedCurve& curve, const TranslationInputs& inputs,
                                     int alternative);

}  // namespace lyrefit

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/model/device.h"
#include "lyrefit/translate/procedures.h"

namespace lyrefit {

// The diagnosed device without the causes that belong to the sweep: irradiance steps and drifts,
// offsets and ranges of the instrument, wrong sensors. Causes in the device (shade, low shunt, weak
// cells, a second diode) act at the target as they did during the sweep. The diodes follow
// irradiance and temperature by De Soto's law. Shunt conductance up to that of normal modules, Voc
// / (25 Isc), is in proportion to G, as in De Soto's law; beside a leak only half of it is. The
// rest is constant.
struct ExtendedModel {
  Device device;                   // with the causes that stay; its law refers to (G1, T1)
  std::vector<double> parameters;  // in the order and the internal units of `device`
  double source_irradiance_W_m2 = 0;
  double source_temperature_C = 25;
  int cells_in_series = 1;
  double healthy_shunt_S = 0;         // largest conductance in proportion to irradiance
  std::vector<std::string> kept;      // titles of the causes in the device
  std::vector<std::string> removed;   // titles of the causes of the sweep
  std::optional<BetaAnchor> bandgap;  // of the first diode; none: as stated
  std::string cause;                  // id of the first cause, in which the alternatives differ
};

// `inputs` as completed by SettleInputs; `anchored`: the band gap is fitted so that Voc follows
// beta.
struct ExtendedInputs {
  TranslationInputs inputs;
  bool anchored = true;
};

// The model of a diagnosis that was made with DiagnoseOptions::extend. Errors: an extended model
// that is not usable or is of several curves, a law that is invalid without the removed causes, a
// parameter without a value in the report.
Expected<std::shared_ptr<const ExtendedModel>> MakeExtendedModel(const IvCurve& curve,
                                                                 const Diagnosis& diagnosis,
                                                                 const ExtendedInputs& inputs);

// The model of a fit with effects, for an alternative cause.
Expected<std::shared_ptr<const ExtendedModel>> MakeExtendedModel(const IvCurve& curve,
                                                                 const FitReport& fit,
                                                                 const ExtendedInputs& inputs);

// Key points at the target. Where no cause was removed, they are those of the readings, times the
// model's at the target over the model's at the source (ScaledKeyPoints). Else they are the
// model's. `alternative`: index into PreparedCurve::models.
Expected<KeyPoints> ExtendedKeyPoints(const PreparedCurve& curve, const TranslationInputs& inputs,
                                      int alternative);

// Up to 400 points at even voltages at the target, from short circuit to beyond open circuit.
Expected<CurvePoints> ExtendedPoints(const PreparedCurve& curve, const TranslationInputs& inputs,
                                     int alternative);

}  // namespace lyrefit

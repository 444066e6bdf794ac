#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/setting_text.h"
#include "lyrefit/fit/effect_text.h"
#include "lyrefit/law/device.h"
#include "lyrefit/law/extension.h"

namespace LYREFIT_PUBLIC lyrefit {

// One law behind many curves (extended_set.h) and the one of them to be simulated; at conditions of
// one's own choice where the options' differ from those it was taken under.
struct SharedLaw {
  Law law;  // of the whole set
  double reference_K = 298.15;
  CurveSet set;
  int curve = 0;  // position in the set
};

// The device that is simulated, the sky above it, and the noise.
struct SimulateOptions {
  Model model = Model::kSingleDiode;
  std::map<std::string, double> parameters;  // by symbol or name: all of the model, n per cell
  Conditions conditions;
  ConstantSet constants = ConstantSet::kCodata;
  std::vector<double> voltage_V;  // empty: `points` even steps from 0 to 2 % beyond open circuit
  int points = 100;
  // Effects beside the diodes; every parameter of them is held at one value, those not given at the
  // effect's usual one, but its strength, the first, must be given. They act as in `taken`, a
  // measurement with its order and times, whose readings are simulated where no voltages are given;
  // without it, as in the simulated sweep itself.
  std::vector<EffectUse> with;
  std::optional<IvCurve> taken;
  // In the place of `taken`: the parameters are then those at the reference, alpha and EgRef among
  // them.
  std::optional<SharedLaw> shared;
  bool force_effects = false;  // also those that such data cannot show
  // Cells that are not alike (law/string_layout.h); none: all have the parameters above.
  std::shared_ptr<const StringLayout> layout;
  // Independent Gaussian noise on every current, of the two parts' root of the sum of squares.
  double noise_A = 0;              // standard deviation, constant part
  double noise_relative = 0;       // standard deviation, part of |current|
  std::uint64_t seed = 0;          // of the noise
  std::string name = "simulated";  // of the curve made
};

inline constexpr OptionRow<SimulateOptions> kSimulateOptionTable[] = {
    OptionRow<SimulateOptions>("Device"),
    {"model", "NAME", "number of diodes", EnumOption<&SimulateOptions::model>()},
    {"set", "P=VALUE", "value of one parameter, Iph=0.76; once for each",
     AssignmentsOption<&SimulateOptions::parameters>()},
    {"constants", "NAME", "values of k and q", EnumOption<&SimulateOptions::constants>()},
    {"with", kEffectsUnit, kEffectsDoc, EffectsOption<&SimulateOptions::with>()},
    {"force", "", "also effects that such data cannot show", &SimulateOptions::force_effects,
     OptionTrait::kNoFlag},
    OptionRow<SimulateOptions>("Points"),
    {"points", "N", "points from 0 V to a little beyond open circuit", &SimulateOptions::points,
     OptionTrait::kUnchecked},
    OptionRow<SimulateOptions>("Noise"),
    {"noise-A", "S", "standard deviation of the current in A", &SimulateOptions::noise_A,
     OptionTrait::kUnchecked},
    {"noise-relative", "R", "standard deviation as a part of the current",
     &SimulateOptions::noise_relative, OptionTrait::kUnchecked},
    {"seed", "S", "seed of the noise", &SimulateOptions::seed, OptionTrait::kUnchecked},
};

// The curve of a device under the given conditions: I(V) solved to rounding, then noise. Same
// options, same bits. Errors: a parameter missing, unknown or outside its physical range, no
// open-circuit voltage to end at, options outside their ranges.
Expected<IvCurve> Simulate(const SimulateOptions& options);

// Model, parameters, conditions, constants and effects of a JSON fit report, ready to be simulated:
// with effects its own readings, to 1e-9 of their currents. Of a report of many curves, a family's
// or a diagnosis', `curve` is the id of one. An infinite shunt resistance, null in JSON, is read
// back as infinite. Errors besides: an effect nobody knows, effects in a report of another version
// of lyrefit, no such curve.
Expected<SimulateOptions> ReadFitForSimulation(const std::string& path,
                                               const std::string& curve = "");
// The same from the text of a report, which errors call `path`.
Expected<SimulateOptions> ReadFitTextForSimulation(const std::string& text, const std::string& path,
                                                   const std::string& curve = "");

}  // namespace lyrefit

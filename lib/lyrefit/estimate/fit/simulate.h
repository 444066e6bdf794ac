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
#include "lyrefit/base/setting_text.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/estimate/fit/effect_text.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/model/device.h"
#include "lyrefit/model/device_effects.h"

namespace LYREFIT_PUBLIC lyrefit {

// One law of many curves (extended_set.h), and the curve of the set to simulate. Where the
// conditions in SimulateOptions differ from those of the measured curve, they replace them.
// Experimental.
struct SharedLaw {
  Law law;  // law of the whole set
  double reference_K = 298.15;
  CurveSet set;
  int curve = 0;  // index of the curve in the set
};

// Simulated device, operating conditions and noise.
struct SimulateOptions {
  Model model = Model::kSingleDiode;
  // Junctions in series; 2: a tandem of two unlike junctions with one diode each
  // (model/two_junctions.h), without effects or a layout. Its photocurrents are those in the light
  // to be simulated. Experimental.
  int junctions = 1;
  std::map<std::string, double> parameters;  // by symbol or name, n per cell
  Conditions conditions;
  ConstantSet constants = ConstantSet::kCodata;
  std::vector<double> voltage_V;  // empty: `points` even steps from 0 to 1.02 Voc
  int points = 100;
  // Effects in addition to the diodes. Each of their parameters has one value. The first one, the
  // strength, must be given; the others default to the effect's usual values. Effects act as in
  // `taken`, a measurement with the order and times of its readings. Without voltages, the readings
  // of `taken` are simulated. Without `taken`, effects act as in the simulated sweep itself.
  // Experimental, as their type is.
  std::vector<EffectUse> with;
  std::optional<IvCurve> taken;
  // Replaces `taken`. `parameters` are then those at the reference, including alpha and EgRef.
  // Experimental.
  std::optional<SharedLaw> shared;
  // PVsyst's recombination loss in the i-layer of thin films, with the parameters d2mutau and NsVbi
  // (V). Not beside effects or a layout.
  bool recombination = false;
  bool force_effects = false;  // also effects that the readings cannot show
  // Layout of unlike cells (model/law.h); none: all cells have the parameters above.
  // Experimental.
  std::shared_ptr<const StringLayout> layout;
  // Independent Gaussian noise of every current; the variances of the two parts add.
  double noise_A = 0;              // standard deviation, constant part
  double noise_relative = 0;       // standard deviation, relative to |current|
  std::uint64_t seed = 0;          // seed of the noise
  std::string name = "simulated";  // name of the simulated curve
};

inline constexpr OptionRow<SimulateOptions> kSimulateOptionTable[] = {
    OptionRow<SimulateOptions>("Device"),
    {"model", "NAME", "number of diodes", EnumOption<&SimulateOptions::model>()},
    {"junctions", "N",
     "junctions in series with a light each; 2: a tandem, Iph1, Is1, n1, Rsh1, Iph2, ... and Rs",
     &SimulateOptions::junctions, 1, 2, OptionTrait::kExperimental},
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

// Simulates the curve of a device under the given conditions: I(V) is solved to rounding, then
// noise is added. Equal options give equal bits. Errors: a parameter missing, unknown or outside
// its physical range; no open-circuit voltage to end at; options outside their ranges.
Expected<IvCurve> Simulate(const SimulateOptions& options);

// RMSE of given parameters on the readings of a curve, by both definitions and without weights, as
// a fit reports it. `parameters` are by symbol or name, in the units of SimulateOptions; the model
// is the smallest one of one, two and three diodes that has them all. Errors: an unusable curve; a
// parameter missing, unknown or outside its physical range.
Expected<RmsePair> RmseOf(const IvCurve& curve, const std::map<std::string, double>& parameters,
                          ConstantSet constants = ConstantSet::kCodata);

}  // namespace lyrefit

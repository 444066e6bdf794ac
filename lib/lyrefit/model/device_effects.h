// Experimental: may change in a minor version (data/stable).
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/model/device.h"
#include "lyrefit/model/law.h"
#include "lyrefit/model/reading.h"

namespace LYREFIT_PUBLIC lyrefit {

// An effect requested for a model, with ranges of its parameters. Keys are symbols or names, ranges
// [low, high] in reporting units. Equal ends fix the parameter.
struct EffectUse {
  const Effect* effect = nullptr;                           // from the catalogue, or user-defined
  std::map<std::string, std::pair<double, double>> ranges;  // by symbol or name
};

// A device with effects in the measurement of one curve (one sweep, or up and down) or of a set of
// curves (extended_set.h). Effects are computed in internal units (model/effect.h): voltages per
// cell, currents in current scales. Their parameters have internal units in the device's vector
// too; quote.h converts to reporting units and back.
struct DeviceEffects {
  Law law;  // including the effects
  Readings readings;
  std::vector<ReadingBlock> blocks;  // blocks of `readings`
  std::vector<EffectUse> uses;
  std::vector<ParameterBounds> bounds;  // of the effects' parameters, internal units
  std::vector<double> usual;            // start or fixed values of the same parameters
  std::shared_ptr<const CurveSet> set;  // curves of the readings; null: one curve
};

// Error if the effect has no parameter with this symbol or name.
Expected<void> CheckParameter(const EffectUse& use, const std::string& key);

// Adds effects, and optionally a cell layout, to `base` in the measurement of one curve. `force`:
// accepts effects that data of this type cannot show. Errors: an effect twice, two effects that
// exclude each other, an unknown parameter, a range outside its bounds, cell shares that sum to 1
// or more, more than 20 parameters in all, an effect these data cannot show (with the reason), a
// layout of another number of cells or together with an effect that divides the cells.
Expected<Device> Extend(const Device& base, Model model, ConstantSet constants,
                        const IvCurve& curve, const std::vector<EffectUse>& uses, bool force,
                        std::shared_ptr<const StringLayout> layout = nullptr);

// Adds effects to `base` in a measurement whose law and readings are set in `device_effects`.
// Errors: those of Extend.
Expected<Device> AddEffects(const Device& base, DeviceEffects device_effects,
                            const std::vector<EffectUse>& uses, bool force);

// Error if a fit cannot keep the requested ranges. A fit bounds parameters in internal units. The
// range of a reported value is therefore lost if its conversion depends on another, free parameter.
Expected<void> CheckFitRanges(const DeviceEffects& device_effects);

// Whether the k-th of the effects' parameters belongs to an effect with several free parameters.
// Their joint response is less linear than that of each alone, and parameters selected by trial are
// in no covariance.
bool OneOfSeveral(const DeviceEffects& device_effects, int k);

// Start points of a fit, over the effects' parameters: the usual values, then every probe of every
// effect with the other effects at their usual values.
std::vector<std::vector<double>> EffectStarts(const DeviceEffects& device_effects);

// Text of a request, as in flags: "shading:d=0.3,w=0.2:0.4".
std::string DescribeUse(const EffectUse& use);

// Appends the effects' parameters to the parameters of a device, with symbols like "shading.d" and
// names like "shading_shading_depth".
void AddInfos(const std::vector<EffectUse>& uses, std::vector<ParameterInfo>* infos);

// Currents at the measured readings, in ampere, and optionally the row-major Jacobian by all
// parameters. Columns of parameters with `fixed` 1 are 0. Returns false if the law cannot be
// evaluated. A workspace `kept` between calls for this device makes them faster (law.h).
bool ExtendedCurrents(const Device& device, const double* p, double* current_A, double* jacobian,
                      const std::vector<char>* fixed = nullptr, LawWorkspace* kept = nullptr);

// Currents at other voltages, in ampere, as one sweep at the mean rate and irradiance of the
// measurement. NaN if the law cannot be evaluated.
std::vector<double> ExtendedCurrents(const Device& device, const double* p,
                                     const std::vector<double>& voltage_V);

}  // namespace lyrefit

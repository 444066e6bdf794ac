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
#include "lyrefit/law/device.h"
#include "lyrefit/law/law.h"
#include "lyrefit/law/reading.h"

namespace LYREFIT_PUBLIC lyrefit {

// An effect that a model is to have, and what is known of its parameters: by symbol or name, in the
// units of reports, [low, high]; equal ends hold the parameter there.
struct EffectUse {
  const Effect* effect = nullptr;                           // of the catalogue, or one's own
  std::map<std::string, std::pair<double, double>> ranges;  // by symbol or name
};

// A device extended by effects in the measurement of one curve (one sweep, or up and down) or of a
// set of them (extended_set.h). Effects are computed in numbers of their own (law/effect.h:
// voltages per cell, currents in parts of a scale), in which their parameters stand in the device's
// vector; quote.h leads from there to the units of people and back.
struct Extension {
  Law law;  // with its effects
  Readings readings;
  std::vector<ReadingBlock> blocks;  // of those
  std::vector<EffectUse> uses;
  std::vector<ParameterBounds> bounds;  // of the effects' parameters, in numbers of their own
  std::vector<double> usual;            // where a fit begins or what it holds, the same
  std::shared_ptr<const CurveSet> set;  // the curves behind the readings; none: of one curve
};

// Whether the effect has a parameter of this symbol or name.
Expected<void> CheckParameter(const EffectUse& use, const std::string& key);

// `base` with the effects, and its cells as `layout` has them, as the curve was taken. `force`:
// also effects that data of this kind cannot show. Errors: no effect twice, none that cannot stand
// beside another, no parameter that is not the effect's, ranges inside its bounds, shares of cells
// that do not add up to more than 1, at most 20 parameters in all; an effect these data cannot
// show, and why; a layout of other cells, or beside an effect that splits them.
Expected<Device> Extend(const Device& base, Model model, ConstantSet constants,
                        const IvCurve& curve, const std::vector<EffectUse>& uses, bool force,
                        std::shared_ptr<const StringLayout> layout = nullptr);

// The same in a measurement whose law and readings stand in `extension` already.
Expected<Device> AddEffects(const Device& base, Extension extension,
                            const std::vector<EffectUse>& uses, bool force);

// Whether a fit can keep to the ranges that were asked for: it moves in the effects' own numbers,
// so what is reported of a parameter cannot be kept to where that depends on another one that is
// free.
Expected<void> CheckFitRanges(const Extension& extension);

// Whether the k-th of the effects' parameters is of an effect with several free ones: what they do
// together bends sooner than any of them alone, and what is settled by trying is in no covariance.
bool OneOfSeveral(const Extension& extension, int k);

// Where fits of the effects' parameters may begin: all at what is usual, then each probe of each
// effect beside the others so.
std::vector<std::vector<double>> EffectStarts(const Extension& extension);

// "shading:d=0.3,w=0.2:0.4", as it was asked for.
std::string DescribeUse(const EffectUse& use);

// Names of the effects' parameters, "shading.d" and "shading_shading_depth", after those of a
// device.
void AddInfos(const std::vector<EffectUse>& uses, std::vector<ParameterInfo>* infos);

// Currents at the measured readings, and their derivatives by all parameters where asked for, by
// those that are `held` (1) 0. False where the law cannot be evaluated. A workspace that is kept
// from one call to the next, of this device alone, makes them faster (law.h).
bool ExtendedCurrents(const Device& device, const double* p, double* current_A, double* jacobian,
                      const std::vector<char>* held = nullptr, LawWorkspace* kept = nullptr);

// At other voltages, read one after the other at the measurement's mean pace.
std::vector<double> ExtendedCurrents(const Device& device, const double* p,
                                     const std::vector<double>& voltage_V);

}  // namespace lyrefit

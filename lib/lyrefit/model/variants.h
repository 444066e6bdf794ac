#pragma once

#include <string>
#include <vector>

#include "lyrefit/model/device_effects.h"

namespace lyrefit {

// One way to fit the effects of a device: a set of free parameters for every effect. An effect
// that is requested by name only has several variants, from the shape of one lit sweep. Examples
// are either reverse law, or a shade over a whole substring or a fraction of it. There is one
// variant, the request itself, if ranges are given or the measurement has several conditions.
struct Variant {
  std::vector<ParameterBounds> bounds;  // of the effects' parameters, internal units; equal ends:
                                        // fixed
  std::vector<double> usual;            // start or fixed values
  int free = 0;
};

// All variants of a device's effects, without duplicates; at least one.
std::vector<Variant> VariantsOf(const DeviceEffects& device_effects);

// Start points in this variant, from the shape of the curve: all of the effects' parameters, within
// its bounds. Empty if no effect has starts from the shape.
std::vector<std::vector<double>> ShapePlaces(const DeviceEffects& device_effects,
                                             const Variant& variant);

// Reduces cell shares that sum to 1 or more, the largest first, until cells remain for the rest.
// `p`: the effects' parameters.
void LeaveARest(const DeviceEffects& device_effects, const std::vector<ParameterBounds>& bounds,
                double* p);

// Text that distinguishes the variant from others of these effects: "d, Vb, m, A free; chains 2".
std::string DescribeVariant(const DeviceEffects& device_effects, const Variant& variant);

}  // namespace lyrefit

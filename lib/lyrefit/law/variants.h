#pragma once

#include <string>
#include <vector>

#include "lyrefit/law/extension.h"

namespace lyrefit {

// An effect that is asked for by its name alone can be fitted in several ways: what of it is free
// follows from what the shape of one lit sweep suggests (one reverse law or the other, a shade that
// covers a substring or a part of it). A variant of an extension is one such choice for every effect.
// Where ranges were given, and of measurements that have no one shape, there is one variant: as asked.
struct Variant {
  std::vector<ParameterBounds> bounds;  // of the effects' parameters, in numbers of their own;
                                        // equal ends: held
  std::vector<double> usual;            // where a fit begins, or what it holds
  int free = 0;
};

// At least one, each once.
std::vector<Variant> VariantsOf(const Extension& extension);

// Where the shape of the curve suggests to begin in this variant: all of the effects' parameters,
// inside its bounds. Empty where no effect is seen in a shape.
std::vector<std::vector<double>> ShapePlaces(const Extension& extension, const Variant& variant);

// Makes shares of cells that add up to all of them or more smaller, the largest first, until some
// are left for the rest. `p`: the effects' parameters.
void LeaveARest(const Extension& extension, const std::vector<ParameterBounds>& bounds, double* p);

// "d, Vb, m, A free; chains 2": what tells the variant from others of the same extension.
std::string DescribeVariant(const Extension& extension, const Variant& variant);

}  // namespace lyrefit

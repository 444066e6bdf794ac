#pragma once

#include <vector>

#include "lyrefit/law/variants.h"
#include "lyrefit/law/parameter.h"
#include "lyrefit/search/search_summary.h"

namespace lyrefit {

// The box a search sees: one side for each parameter that is not fixed. A linear parameter is
// searched as it is, so that published boxes mean what they mean in the literature; a logarithmic
// one by ln(value / lower end), from 0; of one that is a whole number each value has a stretch of
// 1; and where effects have several variants these have a side, a stretch of 1 each.
class SearchSpace {
 public:
  // `fixed[i]` is the value of a fixed parameter, NaN for the others.
  SearchSpace(const std::vector<ParameterBounds>& bounds, const std::vector<double>& fixed);
  // Of an extended device: `bounds` and `fixed` are of its base, the effects are as in `variants`. The
  // extension must outlive the space.
  SearchSpace(const std::vector<ParameterBounds>& bounds, const std::vector<double>& fixed,
              const Extension& extension, std::vector<Variant> variants);

  const Box& box() const { return box_; }
  int dimensions() const { return static_cast<int>(box_.lower.size()); }
  // Device parameters of a point of the box, into `p` (as many as the device has).
  void ToParameters(const double* x, double* p) const;
  // A point of the box that stands for these parameters in a variant, as far as its sides know them;
  // those outside their ranges are moved inside. The middle of its stretch for a whole number.
  std::vector<double> FromParameters(const double* p, int variant) const;
  // Which of the variants a point is of.
  int VariantAt(const double* x) const;

 private:
  struct Side {
    int parameter = 0;
    double log_base = 0;  // lower end of a logarithmic one, else 0
    double first = 0;     // of whole numbers
    double whole = 0;
    int values = 0;
  };
  void AddSide(int parameter, const ParameterBounds& bounds);

  std::vector<double> fixed_;
  std::vector<Side> sides_;
  const Extension* extension_ = nullptr;
  std::vector<Variant> variants_;
  Box box_;
};

}  // namespace lyrefit

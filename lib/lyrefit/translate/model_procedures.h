#pragma once

#include <memory>
#include <optional>

#include "lyrefit/law/translation.h"
#include "lyrefit/translate/procedures.h"

namespace lyrefit {

// The single diode of the readings carried by a law (law/translation.h). Its five parameters at
// (G1, T1) and what the law needs besides give those at the reference:
//   De Soto   EgRef, dEgdT, alpha; Rsh in proportion to 1 / G
//   PVsyst    EgRef, mu_gamma, alpha; Rsh exponential in G, four times as large in the dark
// Key points are those of the true readings times model at the target / model at the source, so
// that what the fit misses of the curve stays; where the readings have none, the model's.
Expected<KeyPoints> DiodeKeyPoints(Procedure procedure, const PreparedCurve& curve,
                                   const TranslationInputs& inputs);

// The law behind kDeSoto and kPvsyst for a module of so many cells.
Expected<std::shared_ptr<const Translation>> LawOf(Procedure procedure, int cells_in_series);

// `measured` times what a model says of the step from `source` to `target`: so that what it misses
// of the curve stays. The model alone where the readings have no such point.
KeyPoints ScaledKeyPoints(const KeyPoints& measured, const KeyPoints& source,
                          const KeyPoints& target);

// 200 even points of the model at the target, beyond both axes.
Expected<CurvePoints> DiodePoints(Procedure procedure, const PreparedCurve& curve,
                                  const TranslationInputs& inputs);

// The band gap with which De Soto's law moves the Voc of this diode by `inputs.beta_oc_V_K` at 1000
// W/m2 and 25 C, and the slope of the ideality with which PVsyst's does. A fitted n is in De Soto's
// barrier too (n EgRef), where what bends n bends beta: so it is the coefficient that is held. None
// where no value between 0.3 and 4 eV (+-0.02 1/K) does it.
std::optional<BetaAnchor> AnchorBandgap(const SingleDiodeFit& diode, int cells,
                                        const TranslationInputs& inputs);
std::optional<BetaAnchor> AnchorMuGamma(const SingleDiodeFit& diode, int cells,
                                        const TranslationInputs& inputs);

}  // namespace lyrefit

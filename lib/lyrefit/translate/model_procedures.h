#pragma once

#include <memory>
#include <optional>

#include "lyrefit/model/translation.h"
#include "lyrefit/translate/procedures.h"

namespace lyrefit {

// Key points at the target by a law (model/translation.h) for the single diode of the readings. The
// reference parameters follow from the five parameters at (G1, T1) and the law's own inputs:
//   De Soto   EgRef, dEgdT, alpha; Rsh in proportion to 1 / G
//   PVsyst    EgRef, mu_gamma, alpha; Rsh exponential in G, four times as large in the dark
// The result is that of ScaledKeyPoints for the corrected readings.
Expected<KeyPoints> DiodeKeyPoints(Procedure procedure, const PreparedCurve& curve,
                                   const TranslationInputs& inputs);

// The law of kDeSoto or kPvsyst for a module with this number of cells in series.
Expected<std::shared_ptr<const Translation>> LawOf(Procedure procedure, int cells_in_series);

// `measured` times the model's ratio of `target` to `source`, which keeps the misfit of the model.
// The model's value where the readings lack a key point.
KeyPoints ScaledKeyPoints(const KeyPoints& measured, const KeyPoints& source,
                          const KeyPoints& target);

// 200 points of the model at even voltages at the target, from below 0 V to beyond Voc.
Expected<CurvePoints> DiodePoints(Procedure procedure, const PreparedCurve& curve,
                                  const TranslationInputs& inputs);

// The band gap (De Soto) or slope of the ideality (PVsyst) with which Voc follows
// `inputs.beta_oc_V_K` at 1000 W/m2 and 25 C. De Soto's barrier is n EgRef, so an error of the
// fitted n would change beta; the band gap is therefore fitted to keep beta. None where no band gap
// of 0.3 to 4 eV (slope within +-0.02 1/K) does so.
std::optional<BetaAnchor> AnchorBandgap(const SingleDiodeFit& diode, int cells,
                                        const TranslationInputs& inputs);
std::optional<BetaAnchor> AnchorMuGamma(const SingleDiodeFit& diode, int cells,
                                        const TranslationInputs& inputs);

}  // namespace lyrefit

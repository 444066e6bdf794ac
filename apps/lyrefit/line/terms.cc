#include <algorithm>
#include <vector>

#include "about.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

struct TermOfArt {
  const char* term;
  const char* means;
};

struct Chapter {
  const char* title;
  std::vector<TermOfArt> terms;
};

const Chapter kCurve = {
    "The curve",
    {{"I-V curve",
      "currents at voltages of one device under one light and temperature; current "
      "that is delivered counts positive"},
     {"Isc", "short-circuit current, at 0 V; nearly proportional to the irradiance"},
     {"Voc",
      "open-circuit voltage, at 0 A; falls by some 0.3 % per kelvin for silicon, rises with "
      "the logarithm of the light"},
     {"Vmp, Imp, Pmp", "voltage, current and power at the maximum power point; Pmax is Pmp"},
     {"fill factor", "Pmp / (Isc Voc): how square the curve is; 0.7 to 0.85 for good silicon"},
     {"irradiance, G",
      "light on the module's plane in W/m2; standard conditions are 1000 W/m2, "
      "the spectrum AM1.5G and cells at 25 C"},
     {"substring",
      "the cells of a module under one bypass diode, which conducts where they cannot "
      "carry the others' current: a step in the curve"}}};

const Chapter kModel = {
    "The model",
    {{"sd, dd, td",
      "single, double and triple diode: I = Iph - sum of Is (exp(Vd / (n Ns Vt)) - 1) - Vd / Rsh "
      "with Vd = V + I Rs"},
     {"Iph", "photocurrent in A: what the light generates; Isc is a little less"},
     {"Is1, Is2, Is3",
      "saturation current of each diode in A (also I0): recombination; doubles "
      "every few kelvin"},
     {"n1, n2, n3",
      "ideality factor of each diode, per cell: 1 where carriers recombine in the "
      "bulk or at surfaces, 2 in the depletion region"},
     {"Rs",
      "series resistance in ohm of the whole device: contacts, fingers, ribbons, leads; "
      "flattens the curve near Voc"},
     {"Rsh",
      "shunt resistance in ohm of the whole device: leakage beside the junction; tilts the "
      "curve near Isc. Infinite: none"},
     {"Vt", "thermal voltage k T / q of one cell: 25.7 mV at 25 C"},
     {"Ns", "cells in series: voltages of the module are Ns times those of a cell"},
     {"nNsVth", "n1 Ns Vt in V, as pvlib wants it"},
     {"desoto, pvsyst",
      "laws that say how parameters follow irradiance and temperature, so that "
      "one device serves all curves of a family"},
     {"alpha, beta, gamma", "temperature coefficients of Isc, of Voc and of Pmp"},
     {"translation",
      "a measured curve carried to other irradiance and temperature, by one of the procedures of "
      "IEC 60891 or by a model"},
     {"k = 2",
      "an expanded uncertainty: twice the standard one, some 95 % of a normal distribution"},
     {"EgRef", "band gap at 25 C in eV: 1.121 for silicon; how fast Is rises with temperature"}}};

const Chapter kFit = {
    "The fit",
    {{"objective",
      "the residual whose squares are summed. measured-current: the model's right "
      "side with the measured V and I put in, less I. solved-current: the model's "
      "current at the measured V, less I. Papers mostly give the least measured-current RMSE "
      "(fit --objective measured-current): compare like with like"},
     {"RMSE", "root mean square of the residuals of all readings, in A"},
     {"searched", "the best that the search found, before any polish"},
     {"refined",
      "after the polish: bounded least squares from the best candidates and other starts"},
     {"candidate",
      "one candidate of a search; a population moves for so many iterations. Evaluations count "
      "how often the objective was asked for"},
     {"lo, mlo",
      "the lyrebird optimizer, plain and modified (memory and diversity strategies); "
      "random and de are baselines"},
     {"std err",
      "standard error: one standard deviation of the estimate, from the noise in the "
      "readings"},
     {"95 % interval",
      "holds the truth in 95 of 100 such measurements, if the model is right. "
      "symmetric: estimate +- t times its standard error; profile: as far as the "
      "best fit with the parameter fixed there is not significantly worse"},
     {"not identifiable", "the readings leave the parameter open, however good the fit is"},
     {"at bound",
      "the best value within the bounds is one of their ends: the bounds speak, not "
      "the readings"},
     {"correlations",
      "of two estimates: near -1 or +1 the readings fix a combination of the two, "
      "not each"},
     {"AICc, BIC",
      "misfit plus a price for each free parameter: of two models the one with less "
      "is better supported. dAICc is the difference that an effect makes"},
     {"runs",
      "stretches of residuals of one sign: far fewer than expected means that the model "
      "misses a shape; Durbin-Watson near 2 means that neighbours are independent"},
     {"held out", "error on readings that were not fitted: what a prediction errs by"}}};

const Chapter kDiagnosis = {
    "The diagnosis",
    {{"effect",
      "something real that the diodes do not describe: shading, a drifting lamp, a wrong "
      "sensor; lyrefit diagnose --list names them"},
     {"cause",
      "an effect that is named: by the readings and by how common it is, it acts with a "
      "probability of at least 80 %, and it is large enough to matter"},
     {"probability",
      "of a cause: how sure the report is that it acts, all effects of the catalogue and none "
      "together making 100 %; of a hundred causes stated with 90 %, ninety should be there"},
     {"misfit", "of an effect: how much of the residuals it takes away, in units of the noise"},
     {"kept",
      "the part of an effect's signature that the base model cannot imitate: near 0 it is "
      "nearly invisible"},
     {"to gain",
      "what the device would give more in watts, in the light of the sweep, without the cause"},
     {"error of Pmax of the base model",
      "what the model without the cause gets wrong in Pmp, in parts or percent: not a loss"},
     {"misfit in % of Isc",
      "root mean square of what a model misses beyond noise; of healthy modules a single diode "
      "misses 0.05 to 0.20 %"},
     {"equivalents",
      "other effects that these readings cannot tell from the cause; to tell says "
      "which measurement would"}}};

const Chapter kStudy = {
    "Proofs and studies",
    {{"floor",
      "the lowest RMSE (of the objective named beside it) that any number of diodes can reach "
      "within the bounds of n and Rs; no fit of sd, dd or td lies below it, and the best of one of "
      "them, which certify proves too, may lie above"},
     {"gap",
      "relative distance of what was reached from what was proved: 0 means that nothing "
      "better exists"},
     {"certified", "the gap is at most 1e-9, or rounding"},
     {"hit", "a run that ended within 1e-6 or 1e-9 of the reference"}}};

}  // namespace

std::string Glossary() {
  std::string text = "Terms, and the columns of the tables\n";
  for (const Chapter* chapter : {&kCurve, &kModel, &kFit, &kDiagnosis, &kStudy}) {
    text += std::string("\n") + chapter->title + "\n";
    for (const TermOfArt& term : chapter->terms) {
      std::string first = "  " + std::string(term.term);
      first.resize(std::max<std::size_t>(first.size() + 2, 22), ' ');
      text += Wrap(first, term.means);
    }
  }
  return text;
}

}  // namespace lyrefit

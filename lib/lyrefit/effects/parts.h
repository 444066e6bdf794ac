#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/effects/fitted_effect.h"
#include "lyrefit/model/effect.h"

namespace lyrefit {

// What files of effects share.

// One line for each of them, in the order of reports.
#define LYREFIT_EFFECTS(ENTRY)     \
  ENTRY(SecondDiode)               \
  ENTRY(NonohmicShunt)             \
  ENTRY(Breakdown)                 \
  ENTRY(Collection)                \
  ENTRY(Photoshunt)                \
  ENTRY(BackContact)               \
  ENTRY(RsCurrent)                 \
  ENTRY(DistributedRs)             \
  ENTRY(AgedContacts)              \
  ENTRY(SeriesResistance)          \
  ENTRY(Shading)                   \
  ENTRY(Mismatch)                  \
  ENTRY(Substrings)                \
  ENTRY(CoveredEdge)               \
  ENTRY(WeakCell)                  \
  ENTRY(DimCells)                  \
  ENTRY(Scatter)                   \
  ENTRY(LeakyCell)                 \
  ENTRY(GradedShunt)               \
  ENTRY(BypassOpen)                \
  ENTRY(BypassShort)               \
  ENTRY(OpenSubstring)             \
  ENTRY(Drift)                     \
  ENTRY(IrradianceStep)            \
  ENTRY(CloudEdge)                 \
  ENTRY(Transient)                 \
  ENTRY(TemperatureDrift)          \
  ENTRY(Hysteresis)                \
  ENTRY(Capacitance)               \
  ENTRY(TimingSkew)                \
  ENTRY(Clip)                      \
  ENTRY(RangeSwitch)               \
  ENTRY(Outliers)                  \
  ENTRY(Quantisation)              \
  ENTRY(VoltageBins)               \
  ENTRY(CurrentOffset)             \
  ENTRY(VoltageOffset)             \
  ENTRY(SensorOffset)              \
  ENTRY(SensorNonlinearity)        \
  ENTRY(TemperatureOffset)         \
  ENTRY(TemperatureGradient)       \
  ENTRY(Bandgap)                   \
  ENTRY(IscTemperatureCoefficient) \
  ENTRY(TemperatureOrCells)        \
  ENTRY(UnknownStructure)

#define LYREFIT_DECLARE_EFFECT(name) Effect name();
LYREFIT_EFFECTS(LYREFIT_DECLARE_EFFECT)
#undef LYREFIT_DECLARE_EFFECT

// Relative standard deviation of the light inferred from the level of a plateau, without the fit's
// own error. It has two sources. Photocurrents of a module's cells differ by some parts in a
// thousand: cells are sorted into classes of half a percent, and the weakest cell determines a
// substring's plateau. The module also departs from its diode model. The five parameters absorb
// most of that, down to 1 to 2 parts in a thousand, but not differences between plateaus, which are
// several times larger.
constexpr double kCellScatter = 0.007;
constexpr double kSubstringScatter = 0.0063;

// Reasons that several effects share; empty if the data can show the effect.
using WhyNot = std::optional<std::string>;
WhyNot NeedsLight(const DataTraits& traits);
WhyNot NeedsOneLitCondition(const DataTraits& traits);  // effects of one sweep
WhyNot NeedsModule(const DataTraits& traits);           // cells in series, one lit condition
WhyNot NeedsManyCells(const DataTraits& traits);        // so many that they form a distribution
WhyNot NeedsBypassDiodes(const DataTraits& traits);
WhyNot NeedsBypassedModule(const DataTraits& traits);  // with bypass diodes, or as if it had some
WhyNot NeedsUpDown(const DataTraits& traits);
WhyNot NeedsLightLevels(const DataTraits& traits);   // two irradiances; a dark curve counts
WhyNot NeedsIrradiances(const DataTraits& traits);   // several irradiances
WhyNot NeedsTemperatures(const DataTraits& traits);  // several temperatures

// On what the priors of several effects rest (Effect::prior).
inline constexpr char kShadePrior[] = "soiling, snow and shade: most frequent in field sweeps";
inline constexpr char kFaultPrior[] = "IEA PVPS T13-01:2014, section 5: failures per module";
inline constexpr char kCellPrior[] =
    "not rare in cells; modules are sorted, seldom above the floors";
inline constexpr char kSkyPrior[] = "moving clouds: a few in a hundred sweeps of 0.1 to 30 s";
inline constexpr char kLampPrior[] = "clouds, seldom gone within a sweep; lamps falter less";
inline constexpr char kTracerPrior[] = "properties of tracers, per instrument";

// Where factors of priors count (PriorFactor).
bool InFlasher(const Circumstances& at);
bool InInverter(const Circumstances& at);
bool SlowOutdoors(const Circumstances& at);
bool ModuleInLaboratory(const Circumstances& at);
bool AsNew(const Circumstances& at);     // less than a year in the field
bool OfOldAge(const Circumstances& at);  // more than ten years
bool OfThinFilm(const Circumstances& at);
bool Heterojunction(const Circumstances& at);

// On what the factors of several effects rest.
inline constexpr char kPulsePrior[] =
    "the light of a flash is held or recorded within milliseconds";
inline constexpr char kUnlikePrior[] =
    "nothing shades a flasher: cells that give less, as common as weak cells";
inline constexpr char kRoomPrior[] = "nothing shades a laboratory unless it is put there";
inline constexpr char kLaboratoryLampPrior[] = "lamps falter less than the sky: as in cells";
inline constexpr char kRegistersPrior[] = "registers of an inverter hold whole steps";
inline constexpr char kInfantPrior[] =
    "IEA PVPS T13-01:2014, section 6: infant failures are glass, interconnects and handling; "
    "corrosion and potential-induced degradation take years";
inline constexpr char kWornPrior[] =
    "IEA PVPS T13-01:2014, section 6, and Jordan et al. 2017, doi:10.1002/pip.2866: corrosion, "
    "interconnects and diodes of modules over ten years";

// Probes of one parameter each.
std::vector<Probe> Strengths(const std::vector<double>& values);

// What in_words (Effect::in_words) returns: phrases, the most important first.
using Phrases = std::vector<std::string>;

// Times a factor.
Sized Scaled(const Sized& size, double factor);

// "71 % (69 to 73)", without an interval that rounding hides.
std::string PercentWithRange(const Sized& part, int digits);

// Light that is left where `factor` times the deficit is missing.
std::string LightLeft(double deficit, const Sized& reported, double factor = 1);

// "1 of 3 substrings", or "33 % of the cells" if the share is no whole number of substrings.
std::string PartOfCells(const Readings& readings, double share);

// ", on 40 % of its cells"; nothing if a shade covers all of them.
std::string CoveredPart(double part);

// Three digits without an exponent.
std::string PlainDigits(double value);

// "3.2 K (2.9 to 3.5)"
std::string WithUnit(const Sized& size, const char* unit);

// A difference as a positive size and one of two words for its sign.
std::string SignedSize(const Sized& size, const char* unit, const char* above, const char* below);

// "5.02 A", "1.3 mA", "8.2 uA"
std::string AmpereText(double value);

// "was 14.0 % (13.8 to 14.2) weaker than before". `limit`: the largest change that a fit can have,
// which an interval reaches where the readings do not determine it.
std::string LightChange(const Sized& part, double limit, const char* than);

// Voltage of the device at a reading, and at the reading nearest to the moment that is the second
// parameter.
double VoltageAt(const FittedEffect& of, const Reading& reading);
double VoltageAtMoment(const FittedEffect& of);

}  // namespace lyrefit

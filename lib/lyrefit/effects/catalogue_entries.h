#pragma once

#include "lyrefit/model/effect.h"

namespace lyrefit {

// One line for each file of the catalogue, in the order of reports.
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

}  // namespace lyrefit

#pragma once

#include "lyrefit/law/effect.h"

namespace lyrefit {

// One function for each file of the catalogue.
Effect SecondDiode();
Effect NonohmicShunt();
Effect Breakdown();
Effect Collection();
Effect Photoshunt();
Effect BackContact();
Effect RsCurrent();
Effect DistributedRs();
Effect Shading();
Effect Mismatch();
Effect Drift();
Effect IrradianceStep();
Effect Transient();
Effect TemperatureDrift();
Effect Capacitance();
Effect TimingSkew();
Effect Clip();
Effect Outliers();
Effect Quantisation();
Effect CurrentOffset();
Effect VoltageOffset();
Effect SensorOffset();
Effect SensorNonlinearity();
Effect TemperatureOffset();
Effect TemperatureGradient();
Effect Bandgap();
Effect IscTemperatureCoefficient();
Effect TemperatureOrCells();
Effect UnknownStructure();

}  // namespace lyrefit

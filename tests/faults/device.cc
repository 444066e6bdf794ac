#include "faults/device.h"

#include <array>
#include <cmath>

namespace faults {
namespace {

constexpr double kThermalVoltage = kBoltzmannOverCharge * kReferenceK;

void DrawLayout(const DeviceWish& wish, Random* random, Device* device) {
  if (!wish.module) {
    device->photocurrent =
        device->thin_film ? random->LogUniform(0.008, 0.2) : random->LogUniform(0.1, 12);
    return;
  }
  constexpr std::array<int, 8> kCells = {20, 36, 40, 48, 54, 60, 72, 96};
  device->cells = kCells[random->Index(kCells.size())];
  const bool by_three = device->cells % 3 == 0;
  device->substrings = wish.bypass ? (by_three && random->Chance(0.8) ? 3 : 2) : 0;
  device->photocurrent = random->LogUniform(2, 12);
}

}  // namespace

bool SetSecondDiode(double saturation, Device* device) {
  const double at_open = device->photocurrent - device->conductance * device->open_circuit;
  const double second = saturation * std::expm1(device->open_circuit / (2 * kThermalVoltage));
  if (second > 0.97 * at_open) return false;
  device->saturation_2 = saturation;
  device->saturation =
      (at_open - second) / std::expm1(device->open_circuit / (device->ideality * kThermalVoltage));
  return true;
}

Device DrawDevice(const DeviceWish& wish, Random* random) {
  Device device;
  device.thin_film = !wish.crystalline && !wish.second_diode && random->Chance(0.25);
  DrawLayout(wish, random, &device);
  const double current = device.photocurrent;
  if (device.thin_film) {
    device.ideality = random->Uniform(1.3, 1.7);
    device.open_circuit = random->Uniform(0.58, 0.85);
    device.bandgap_eV = device.open_circuit > 0.72 ? 1.45 : 1.15;
    device.isc_tempco_per_K = random->Uniform(1e-4, 4e-4);
  } else {
    device.ideality = random->Uniform(1.02, wish.second_diode ? 1.15 : 1.5);
    device.open_circuit = random->Uniform(0.56, 0.70);
    device.isc_tempco_per_K = random->Uniform(4e-4, 6e-4);
  }
  device.resistance = random->LogUniform(0.006, 0.04) / current;
  device.conductance = random->LogUniform(0.01, 0.12) * current;
  SetSecondDiode(0, &device);
  if (wish.second_diode) {
    const double most = current / std::expm1(device.open_circuit / (2 * kThermalVoltage));
    SetSecondDiode(most * random->LogUniform(0.02, 0.4), &device);
  }
  return device;
}

}  // namespace faults

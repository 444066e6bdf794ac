#include "lyrefit/model/coefficients.h"

#include "lyrefit/model/model_points.h"

namespace lyrefit {

TemperatureCoefficients CoefficientsAtReference(const Translation& translation,
                                                const std::vector<double>& shared,
                                                double half_step_K) {
  const auto at = [&](double difference_K) {
    const TranslatedDevice device = TranslateTo(translation, shared, kReferenceIrradiance_W_m2,
                                                kReferenceTemperature_K + difference_K);
    return ModelKeyPoints(device.device, device.parameters.data());
  };
  const KeyPoints cold = at(-half_step_K);
  const KeyPoints reference = at(0);
  const KeyPoints hot = at(half_step_K);
  const double step = 2 * half_step_K;
  return {(hot.short_circuit_current_A - cold.short_circuit_current_A) / step,
          (hot.open_circuit_voltage_V - cold.open_circuit_voltage_V) / step,
          100 * (hot.max_power_W - cold.max_power_W) / (step * reference.max_power_W)};
}

}  // namespace lyrefit

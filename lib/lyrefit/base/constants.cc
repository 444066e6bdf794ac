#include "lyrefit/base/constants.h"

#include <glog/logging.h>

namespace lyrefit {

double ThermalVoltage(double temperature_K, ConstantSet constants) {
  CHECK_GT(temperature_K, 0);
  switch (constants) {
    case ConstantSet::kCodata:
      return 1.380649e-23 / 1.602176634e-19 * temperature_K;
    case ConstantSet::kLiterature:
      return 1.3806503e-23 / 1.60217646e-19 * temperature_K;
    case ConstantSet::kPaper:
      return 1.38065e-23 / 1.60217e-19 * temperature_K;
  }
  LOG(FATAL) << "unknown set of constants";
}

}  // namespace lyrefit

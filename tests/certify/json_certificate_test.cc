#include "lyrefit/report/json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "sample_certificate.h"

#include "lyrefit/certify/certificate_documents.h"

namespace lyrefit {
namespace {

using nlohmann::json;

// The check that the header describes, done with the JSON alone: the dual vector is feasible and
// proves the floor.
TEST(CertificateJson, ProvesTheFloorToAnyoneWhoCanMultiply) {
  const json j = json::parse(CertificateJson(RtcCertificate()));
  const auto voltage = j["data"]["voltage_V"].get<std::vector<double>>();
  const auto current = j["data"]["current_A"].get<std::vector<double>>();
  const auto y = j["floor"]["dual_A"].get<std::vector<double>>();
  const double rs = j["floor"]["resistance_series"];
  const double vt = j["module_thermal_voltage_V"];
  const double rounding = 1e-16;  // A^2, against y'y of 2.5e-5
  double ones = 0, shunt = 0, bound = 0;
  for (std::size_t k = 0; k < y.size(); ++k) {
    ones += y[k];
    shunt -= y[k] * (voltage[k] + rs * current[k]);
    bound += current[k] * y[k] - 0.5 * y[k] * y[k];
  }
  EXPECT_LE(ones, rounding);
  EXPECT_LE(shunt, rounding);
  double highest = -1;
  for (double n = 1; n <= 2; n += 1e-4) {
    double diode = 0, length = 0;
    for (std::size_t k = 0; k < y.size(); ++k) {
      const double column = std::expm1((voltage[k] + rs * current[k]) / (n * vt));
      diode -= y[k] * column;
      length += column * column;
    }
    highest = std::max(highest, diode / std::sqrt(length));
  }
  EXPECT_LE(highest, rounding);
  EXPECT_GT(highest, -1e-9) << "touches zero at the diodes of the floor";
  const double rmse = j["floor"]["rmse_A"];
  EXPECT_NEAR(bound / (0.5 * static_cast<double>(y.size()) * rmse * rmse), 1, 1e-12);
}

}  // namespace
}  // namespace lyrefit

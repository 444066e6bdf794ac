#pragma once

#include <cstdint>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/law/device.h"

namespace LYREFIT_PUBLIC lyrefit {

// Which models are certified, and within which bounds.
struct CertifyOptions {
  double n_lower = 1;  // per cell
  double n_upper = 2;
  double rs_lower_ohm = 0;
  double rs_upper_ohm = kInfinity;
  std::vector<Model> models = {Model::kSingleDiode, Model::kDoubleDiode, Model::kTripleDiode};
  ConstantSet constants = ConstantSet::kCodata;
  double tolerance = 1e-10;     // relative gap of the RMSE that ends the proof
  std::int64_t effort = 50000;  // convex problems solved for one floor or model before giving up
};

inline constexpr OptionRow<CertifyOptions> kCertifyOptionTable[] = {
    OptionRow<CertifyOptions>("Proof"),
    {"models", "LIST", "models to certify beside the floor",
     EnumListOption<&CertifyOptions::models>(), OptionTrait::kNoEcho},
    {"constants", "NAME", "values of k and q", EnumOption<&CertifyOptions::constants>(),
     OptionTrait::kNoEcho},
    {"n-lower", "", "smallest ideality factor", &CertifyOptions::n_lower, 0.05, 100},
    {"n-upper", "", "largest ideality factor", &CertifyOptions::n_upper, 0.05, 100},
    {"rs-lower", "ohm", "smallest series resistance", &CertifyOptions::rs_lower_ohm, 0, 1e12},
    {"rs-upper", "ohm", "largest series resistance", &CertifyOptions::rs_upper_ohm, 0, kInfinity},
    {"tolerance", "", "relative gap of the RMSE that ends the proof", &CertifyOptions::tolerance,
     1e-12, 0.1},
    {"effort", "", "convex problems solved for one floor or model before giving up",
     &CertifyOptions::effort, 10, 1e9},
};

}  // namespace lyrefit

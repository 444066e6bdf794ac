// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/model/device.h"

namespace LYREFIT_PUBLIC lyrefit {

// Ranges of the parameters of one diode.
struct DiodeRanges {
  double n_lower = 1;  // per cell
  double n_upper = 2;  // upper end of that range
  double is_lower_A = 0;
  double is_upper_A = kInfinity;
};

// Options of Certify(): the models to certify and the ranges of their parameters. The floor is that
// of any number of diodes with any sum of Is, so the ranges of Is apply to the models only.
struct CertifyOptions {
  double n_lower = 1;  // per cell
  double n_upper = 2;
  double rs_lower_ohm = 0;
  double rs_upper_ohm = kInfinity;
  double iph_lower_A = 0;
  double iph_upper_A = kInfinity;
  double is_lower_A = 0;  // of each diode
  double is_upper_A = kInfinity;
  double rsh_lower_ohm = 0;  // 0: any conductance
  double rsh_upper_ohm = kInfinity;
  std::string bounds;  // name of these ranges in reports; empty: no name
  // Ranges of n and Is of each diode, at least as many as the largest model has; empty: the ranges
  // above for every diode. The floor uses one range of n that includes those of all diodes and the
  // one above.
  std::vector<DiodeRanges> diodes;
  Objective objective = Objective::kMeasuredCurrent;
  std::vector<Model> models = {Model::kSingleDiode, Model::kDoubleDiode, Model::kTripleDiode};
  ConstantSet constants = ConstantSet::kCodata;
  double tolerance = 1e-10;     // relative gap of the RMSE that ends the proof
  bool rigorous = false;        // bounds and RMSEs hold in spite of rounding, see Certify()
  std::int64_t effort = 50000;  // convex problems solved for one floor or model before giving up
};

inline constexpr OptionRow<CertifyOptions> kCertifyOptionTable[] = {
    OptionRow<CertifyOptions>("Proof"),
    {"objective", "NAME", "which residual is squared", EnumOption<&CertifyOptions::objective>(),
     OptionTrait::kNoEcho},
    {"models", "LIST", "models to certify beside the floor",
     EnumListOption<&CertifyOptions::models>(), OptionTrait::kNoEcho},
    {"constants", "NAME", "values of k and q", EnumOption<&CertifyOptions::constants>(),
     OptionTrait::kNoEcho},
    {"bounds", "NAME|FILE", "the box that is proved",
     OptionText<CertifyOptions>{nullptr,
                                [](const CertifyOptions& options) -> std::vector<std::string> {
                                  return {options.bounds};
                                }},
     OptionTrait::kNoFlag},
    {"n-lower", "", "smallest ideality factor", &CertifyOptions::n_lower, 0.01, 100},
    {"n-upper", "", "largest ideality factor", &CertifyOptions::n_upper, 0.05, 100},
    {"rs-lower", "ohm", "smallest series resistance", &CertifyOptions::rs_lower_ohm, 0, 1e12},
    {"rs-upper", "ohm", "largest series resistance", &CertifyOptions::rs_upper_ohm, 0, kInfinity},
    {"iph-lower", "A", "smallest photocurrent", &CertifyOptions::iph_lower_A, 0, 1e12},
    {"iph-upper", "A", "largest photocurrent", &CertifyOptions::iph_upper_A, 0, kInfinity},
    {"is-lower", "A", "smallest saturation current of each diode", &CertifyOptions::is_lower_A, 0,
     1e12},
    {"is-upper", "A", "largest saturation current of each diode", &CertifyOptions::is_upper_A,
     1e-300, kInfinity},
    {"rsh-lower", "ohm", "smallest shunt resistance", &CertifyOptions::rsh_lower_ohm, 0, 1e15},
    {"rsh-upper", "ohm", "largest shunt resistance", &CertifyOptions::rsh_upper_ohm, 1e-9,
     kInfinity},
    {"tolerance", "", "relative gap of the RMSE that ends the proof", &CertifyOptions::tolerance,
     1e-12, 0.1},
    {"rigorous", "", "bounds that hold in spite of rounding, by interval arithmetic",
     &CertifyOptions::rigorous},
    {"effort", "", "convex problems solved for one floor or model before giving up",
     &CertifyOptions::effort, 10, 1e9},
};

}  // namespace lyrefit

// Experimental: may change in a minor version (data/stable).
#pragma once

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Where lyrefit is published (cmake/address.cmake); empty where it is not.
struct Addresses {
  const char* base;      // the page of the project
  const char* source;    // to be cloned
  const char* site;      // manual, gallery and references
  const char* releases;  // wheels and packages
  const char* tracker;   // questions and mistakes
};

// The addresses of this build.
const Addresses& PublishedAt();

}  // namespace lyrefit

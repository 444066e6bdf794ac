#pragma once

#include <vector>

#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/report/document.h"

namespace lyrefit {

// diagnosis_evidence_document.cc: how far a diagnosis is to be trusted.
std::vector<Section> DiagnosisEvidenceSections(const Diagnosis& diagnosis);

}  // namespace lyrefit

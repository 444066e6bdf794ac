#pragma once

#include <string>

#include "lyrefit/diagnose/diagnosis.h"

// The sections of the text report on a diagnosis; each ends with a newline or is empty where there
// is nothing to say.
namespace lyrefit {

// "step of the irradiance (irradiance_step)"
std::string EffectLabel(const Diagnosis& diagnosis, const std::string& id);

// With a full stop.
std::string FullSentence(std::string text);

// diagnosis_answer_text.cc: what came out.
std::string DiagnosisVerdictSection(const Diagnosis& diagnosis);
std::string DiagnosisCauseSections(const Diagnosis& diagnosis);
std::string DiagnosisBelowSection(const Diagnosis& diagnosis);
std::string DiagnosisGainSection(const Diagnosis& diagnosis);
std::string DiagnosisShiftSection(const Diagnosis& diagnosis);

// diagnosis_plan_text.cc: what to measure next.
std::string DiagnosisPlanSection(const Diagnosis& diagnosis);

// diagnosis_evidence_text.cc: how far to trust it.
std::string DiagnosisEvidenceSection(const Diagnosis& diagnosis);
std::string DiagnosisTrialSection(const Diagnosis& diagnosis);
std::string DiagnosisUntriedSection(const Diagnosis& diagnosis);
std::string DiagnosisLimitSection(const Diagnosis& diagnosis);

}  // namespace lyrefit

#pragma once

#include <vector>

#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/report/document.h"
#include "lyrefit/report/figure.h"

// Functions shared by the documents and pictures of a diagnosis.
namespace lyrefit {

// diagnosis_document.cc: each cause with its place, size, power, alternatives and what to do.
std::vector<Section> CauseSections(const Diagnosis& diagnosis);

// diagnosis_plot.cc: adds the bands and titles of causes to a panel over voltage with known ends.
void MarkCauses(const Diagnosis& diagnosis, Panel* panel);

// diagnosis_evidence_document.cc: the reliability of a diagnosis.
std::vector<Section> DiagnosisEvidenceSections(const Diagnosis& diagnosis);
// The picture for pages, with a caption and a table of its numbers. A figure without panels if there
// is nothing to draw.
block::Figure FigureBlock(const Diagnosis& diagnosis);

}  // namespace lyrefit

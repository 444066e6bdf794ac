// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/certify/certify.h"
#include "lyrefit/report/document.h"
#include "lyrefit/report/figure.h"

// A certificate as a document, as text, JSON, CSV and a picture. The conventions are those of
// report/documents.h, json.h, csv.h and plots.h.
namespace LYREFIT_PUBLIC lyrefit {

// A certificate: the problem, the floor and its diodes, the proof, and each model's distance from
// the floor.
Document CertificateDocument(const Certificate& certificate);
std::string CertificateText(const Certificate& certificate);
std::string BriefCertificate(const Certificate& certificate);

// A certificate with the data to verify the floor at its Rs without lyrefit. With
//   v[k] = voltage_V[k] + resistance_series current_A[k],      y = floor.dual_A,
// no component of the model has a positive product with y: sum y <= 0, -sum y v <= 0, and -sum y
// (exp(v / nNsVth) - 1) <= 0 for nNsVth = n module_thermal_voltage_V and every n in the range. Then
// sum current_A y - sum y^2 / 2 <= N RMSE^2 / 2 for every mixture, with equality to rounding for
// the floor.
std::string CertificateJson(const Certificate& certificate);

// The floor, then one row for each model.
std::string CertificateCsv(const Certificate& certificate);

// The proof of the floor: the cosine between the dual vector and a diode's column over n, which is
// zero at the diodes of the floor and positive nowhere.
Figure CertificateFigure(const Certificate& certificate);
Expected<void> PlotCertificate(const Certificate& certificate, const std::string& path);

}  // namespace lyrefit

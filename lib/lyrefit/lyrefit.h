#pragma once

// Public header of lyrefit: reads, fits, simulates, certifies and diagnoses I-V curves, and writes
// the results.
//
//   #include <iostream>
//   #include "lyrefit/lyrefit.h"
//
//   int main() {
//     const auto curve = lyrefit::ReadCurve("data/rtc_france");
//     if (!curve) return std::cerr << curve.error().ToString() << '\n', 1;
//     const auto report = lyrefit::Fit(*curve);
//     if (!report) return std::cerr << report.error().ToString() << '\n', 1;
//     std::cout << lyrefit::FullReport(*report);
//   }
//
// No function here throws or prints. A mistake in a file or an option returns an Error with one
// sentence; an unsuccessful search or polish is reported in the result. FitOptions lists the
// options of a fit, FitReport its results. FitAuto selects one, two or three diodes. FitFamily fits
// one device to curves under different irradiance and temperature, FitTwoJunctions a tandem to
// curves under different spectra. Certify proves lower bounds of a
// curve's RMSE. FitDataSheet finds a device from a data sheet alone, and the family of all devices
// through the sheet's three points. Diagnose finds the deviations of a measurement from the model
// and their causes. TranslateCurve translates a curve to standard or other conditions, with its
// uncertainty. DescribeCell describes the measurements of a laboratory cell, FindTrend what
// changed in a device over time. CiteReport
// writes BibTeX of what a report used. FitDocument, FamilyDocument and similar functions return reports as data for
// DrawText, DrawMarkdown and DrawHtml.
//
// What of this is promised within a major version, and what is experimental, is listed in
// data/stable/promised.txt; an experimental header says so in its first line.
//
// Further public headers: model/device.h has the diode equation as a template, for numbers with
// derivatives, model/diode_residual.h its residual and the solved current for a problem of Ceres of
// one's own, model/kernel.h a whole curve at once. model/pvlib_parameters.h exports a device to pvlib.
// read/read_module.h reads modules of pvlib, PVsyst and SAM, simulate/simulate_module.h
// simulates one, read/write_pan.h writes one for PVsyst.
// family/fit_individually.h fits every curve of a set separately. certify/floor.h fits a
// curve and proves the floor of its RMSE. diagnose/reference.h compares a sweep with reference
// sweeps of its module. study.h, of the separate library lyrefit::study, compares searches and
// checks publications.

#include "lyrefit/certify/certificate_documents.h"
#include "lyrefit/certify/certify.h"
#include "lyrefit/cite/cite.h"
#include "lyrefit/devices/data_sheet.h"
#include "lyrefit/devices/describe_cell.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/devices/fit_two_junctions.h"
#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/estimate/fit/simulate.h"
#include "lyrefit/family/family_documents.h"
#include "lyrefit/family/fit_family.h"
#include "lyrefit/read/read_cell.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/read_curve_set.h"
#include "lyrefit/read/write_curve.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/report/plots.h"
#include "lyrefit/settings/bounds_file.h"
#include "lyrefit/settings/error_file.h"
#include "lyrefit/simulate/simulate_from.h"
#include "lyrefit/translate/translate.h"
#include "lyrefit/translate/translation_documents.h"
#include "lyrefit/trend/read_trend.h"
#include "lyrefit/trend/trend.h"
#include "lyrefit/trend/trend_documents.h"

#pragma once

namespace lyrefit {

// What decides which cause is named, beside the priors of causes (priors.h), the usual sizes of
// effects (EffectParameter::usual), the floors (DiagnoseOptions) and the limits of healthy devices
// (device_findings.cc). Of each: its unit, on what it rests, and a test of what it does.

// Departure of a device from the right law. Its usual size is that of `UsualErrors`; this is the
// scatter of its logarithm. JudgeTest.ADepartureOfTheDeviceMakesSmallCausesLessProbable.
inline constexpr double kDepartureWidth = 0.35;
// Causes are described to a part of their size only, which adds to the departure, with a scatter of
// its logarithm: chosen on the labelled real sweeps. RealCurvesTest.
inline constexpr double kDepartureOfCauses = 0.1;
inline constexpr double kDepartureOfCausesWidth = 0.6;
// The same from reading to reading, at the kinks of a curve: a standard deviation in parts of the
// size of the causes. JudgeTest.LargeCausesMayMissTheKinks.
inline constexpr double kRoughPartOfCauses = 0.05;
// The least departure by something unknown, in Isc: less is what devices without a fault have.
// LogEvidenceTest.AnUnknownDepartureExplainsWhatTheLawDoesNot.
inline constexpr double kUnknownDeparture = 1.5e-3;

// Part of the differences in evidence between causes that counts, with a departure and without: as
// `fault_study calibration` shows stated and true shares to agree. What a law misses is smooth, and
// the likelihood counts it as if every reading had its own.
// JudgeTest.DifferencesBetweenCausesCountInPart.
inline constexpr double kEvidencePartOfDevices = 0.3;
inline constexpr double kEvidencePartOfLaws = 0.6;
// With a departure, the part of a difference that counts beyond what the misfits show, and how many
// independent pieces the departure of a device has in a sweep: laws that miss the readings alike are
// told apart by their details, which are those of real devices in part only. Chosen on half of
// curves of two-dimensional cells. JudgeTest.DifferencesBetweenCausesCountInPart.
inline constexpr double kEvidencePartOfDetails = 0.1;
inline constexpr double kPiecesOfSweep = 6;

// Priors of the device's parameters, orders of magnitude: ideality and its width in ln, of cells
// (heavy tails: thin films) and of modules; Rs Isc/Voc, Voc/(Rsh Isc), and the current of a second
// diode at Voc in Isc. Every law has them, so that they decide only where causes take their place.
// RealCurvesTest.
inline constexpr double kUsualIdeality = 1.15;
inline constexpr double kIdealityWidthOfCells = 0.2;
inline constexpr double kIdealityWidthOfModules = 0.25;
inline constexpr double kUsualSeriesDrop = 0.03;
inline constexpr double kUsualLeak = 0.05;
inline constexpr double kUsualSecondDiode = 0.05;

// Least change of the current by one more cause, in parts of that by unlike cells or light that
// moves in the same sweep. SelectCausesTest.WhatIsSmallBesideUnlikeCellsIsNoCause.
inline constexpr double kLeastPartOfAnother = 1.0 / 3;

// Usual light that the dimmest of cells that differ one by one misses: two standard deviations of
// 2.5 %. Slight differences between substrings are shared with such cells by the densities of their
// size. JudgeTest.SlightDifferencesOfLightMayBeCellsThatDiffer.
inline constexpr double kUsualDimmest = 0.05;

// Which effects are fitted at all, by the F statistic of their signature: what is less than this
// cannot be more probable than none, and what has less than this part of the best statistic seldom
// becomes the best. They save time; Seek (faults) fails if they are too large.
inline constexpr double kLeastStatistic = 4;
inline constexpr double kHopelessPart = 0.1;

// A cause is replaced by one that is more probable by this, in ln, so that ties do not alternate,
// and so often at most. An alternative is kept from this part of the cause's probability on.
inline constexpr double kClearly = 0.2;
inline constexpr int kMostReplacements = 3;
inline constexpr double kNotable = 0.05;

// Part of the floor of the current below which a power of one sweep rests on nothing visible
// (ExceedsFloors.OfOneSweepOnlyWhereItShows), and part of both floors from which an effect is
// mentioned as present (FieldDiagnosis.WhatIsTooSmallToActOnStandsApart).
inline constexpr double kShownPart = 0.4;
inline constexpr double kMentionedPart = 0.1;

// Standard errors of a power to gain beside those of the fit: cells of a module differ, in parts of
// the power without the cause, and causes are described to a part of their size, in parts of the
// gain. Chosen by the share of intervals that hold the truth in `fault_study field`.
// FieldDiagnosis.SaysTheLightOfASubstringAndThePowerToWin.
inline constexpr double kCellsDiffer = 0.002;
inline constexpr double kCausesDiffer = 0.03;
// The same in strings of modules: how many cells are darker shows in the place of a step only, and
// each of them has a light of its own. Chosen on half of strings of two-dimensional cells.
// FieldDiagnosis.TheGainOfAStringIsLessCertain.
inline constexpr double kCausesDifferInStrings = 0.08;

// Probabilities of a white remainder below which something certainly remains, and below which it is
// a finding by itself. FieldDiagnosis.WhatNoCauseExplainsIsNotSaidToBeReference.
inline constexpr double kRemains = 1e-3;
inline constexpr double kNeverNoise = 1e-6;

}  // namespace lyrefit

#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lyrefit/study/audit.h"
#include "temp_folder.h"

namespace lyrefit {

inline constexpr char kAuditHeader[] =
    "source,device,model,algorithm,rmse_A,Iph_A,Rs_ohm,Rsh_ohm,Is1_uA,n1,Is2_uA,n2,temperature_C,"
    "cells,constants,bounds\n";

// Rounded optima of measured-current RMSE in ampere with CODATA constants.
// Photowatt-PWP201, 36 cells at 45 C: 2.425075e-3
inline constexpr char kPwp[] = "1.0305143,1.20127101,981.98228,3.48226294,1.35119128,,";
// STM6-40/36, 36 cells at 51 C: 1.729814e-3
inline constexpr char kStm[] = "1.66390478,0.15385577,573.41859,1.73865690,1.52030452,,";

class AuditTest : public ::testing::Test {
 protected:
  AuditReport AuditRowsText(const std::string& rows, AuditOptions options = {}) {
    options.curve_folders.push_back(LYREFIT_DATA_DIR);
    const auto report = Audit(folder_.Write("deep/rows.csv", kAuditHeader + rows), options);
    EXPECT_TRUE(report) << report.error().ToString();
    return report.value_or(AuditReport{});
  }

  // The finding for one row.
  AuditFinding Find(const std::string& device, const std::string& claim,
                    const std::string& parameters, const std::string& conditions = ",,,",
                    const AuditOptions& options = {}, const char* model = "sd") {
    const AuditReport report = AuditRowsText(
        "T," + device + "," + model + ",x," + claim + "," + parameters + "," + conditions + "\n",
        options);
    EXPECT_THAT(report.bad_rows, ::testing::IsEmpty()) << report.bad_rows[0].ToString();
    EXPECT_THAT(report.findings, ::testing::SizeIs(1));
    return report.findings.empty() ? AuditFinding{} : report.findings[0];
  }

  TempFolder folder_;
};

// The changes in the only explanation of a finding.
inline std::vector<std::string> ChangesOf(const AuditFinding& finding) {
  EXPECT_EQ(finding.verdict, AuditVerdict::kReproducesChanged) << finding.sentence;
  EXPECT_THAT(finding.explanations, ::testing::SizeIs(1)) << finding.sentence;
  return finding.explanations.empty() ? std::vector<std::string>{}
                                      : finding.explanations[0].reading.changes;
}

}  // namespace lyrefit

#include "lyrefit/study/report/documents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "sample_audit.h"

namespace lyrefit {
namespace {

using ::testing::StartsWith;

TEST(AuditCsv, IsOneLineARow) {
  std::istringstream lines(AuditCsv(SampleAudit()));
  std::string line;
  std::getline(lines, line);
  EXPECT_THAT(line, StartsWith("source,device,model,algorithm,claimed_A,"));
  std::getline(lines, line);
  EXPECT_THAT(line, StartsWith("Table 1,cell,sd,good,0.00098602,0.0009860219,0.0007754,1e-07,"
                               "reproduces,literature,,,,"));
  std::getline(lines, line);
  EXPECT_THAT(line,
              StartsWith("Table 1,cell,sd,\"a, b\",0.00098602,0.0009860219,0.0007754,1e-07,"
                         "reproduces if changed,literature,with Is1 in A instead of uA and at 75 C "
                         "in place of 33 C,0.000986021,Rs 0.0363 below 0.2,"));
  std::getline(lines, line);
  EXPECT_THAT(line, StartsWith("Table 2,"));
  EXPECT_FALSE(std::getline(lines, line));
}

}  // namespace
}  // namespace lyrefit

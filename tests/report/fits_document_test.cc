#include <gtest/gtest.h>

#include "golden.h"
#include "lyrefit/report/documents.h"
#include "sample_fits.h"

namespace lyrefit {
namespace {

TEST(FitsDocument, SaysWhatTheGoldenFileHas) {
  Golden golden("fits");
  golden.AddLong("three files, one of them broken", DrawText(FitsDocument(SampleFits())));
  golden.Add("broken files alone", DrawText(FitsDocument({{"a.csv", Fail("empty")}})));
  golden.Check();
}

}  // namespace
}  // namespace lyrefit
